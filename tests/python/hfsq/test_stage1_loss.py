"""Stage 1's loss: a network with a known answer, and each weight."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import pytest
import torch
from torch import Tensor, nn

from training.config import STREAMS, HfsqConfig, MaskingConfig
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.losses import stage1_loss
from training.motion.streams import STREAM_WIDTHS

CONFIG = HfsqConfig(masking=None, layers=1, scales=(1.0,))
FRAMES, LATENT = 16, 6


class KnownStream(nn.Module):
    """In a stream's place: encodes to given features, quantises to given codes, decodes to a given motion."""

    def __init__(self, answer: Tensor, features: Tensor, codes: Tensor, penalty: float = 0.0) -> None:
        super().__init__()
        self.answer, self.v, self.codes, self.price = answer, features, codes, penalty
        self.decoded_from: list[Tensor] = []
        self.quantiser = self

    def features(self, motion: Tensor) -> Tensor:
        return self.v

    def forward(self, v: Tensor) -> Tensor:
        return self.codes

    def combine(self, codes: Tensor) -> Tensor:
        return codes.sum(2)

    def penalty(self) -> float:
        return self.price

    def decode(self, combined: Tensor) -> Tensor:
        self.decoded_from.append(combined)
        return self.answer


def motions(seed: int = 0) -> tuple[Tensor, Tensor, Tensor]:
    random = torch.Generator().manual_seed(seed)
    upper, lower, place = (
        torch.randn(2, FRAMES, width, generator=random).cumsum(1) for width in STREAM_WIDTHS
    )
    return upper, lower, place


def loss_of(
    config: HfsqConfig = CONFIG,
    wrong: int | None = None,
    apart: float = 0.0,
    penalty: float = 0.0,
    training: bool = False,
    slow: tuple[Tensor, Tensor, Tensor] | None = None,
) -> tuple[Tensor, dict[str, float], list[KnownStream]]:
    """The loss, its parts and the streams. wrong: the stream whose answer is a centimetre off and moves too much;
    apart: of features and codes."""
    given = motions()
    streams = []
    for index, motion in enumerate(given):
        answer = 1.1 * motion + 0.01 if index == wrong else motion
        codes = torch.ones(2, FRAMES // 4, config.layers, LATENT, requires_grad=True)
        features = (codes.detach().sum(2) + apart).requires_grad_()
        streams.append(KnownStream(answer, features, codes, penalty))
    model = cast(Autoencoder, SimpleNamespace(each=streams, training=training))
    total, parts = stage1_loss(model, given, slow or given, config)
    return total, {name: float(part) for name, part in parts.items()}, streams


def test_the_truth_has_no_loss() -> None:
    total, parts, _ = loss_of()
    assert float(total) == 0
    assert set(parts) == {f"{kind}/{s}" for kind in ("kinematic", "energy", "latent") for s in STREAMS}
    assert all(value == 0 for value in parts.values())


@pytest.mark.parametrize("stream", range(3), ids=STREAMS)
def test_every_stream_has_a_kinematic_and_an_energy_loss(stream: int) -> None:
    total, parts, _ = loss_of(wrong=stream)
    kin, energy = parts[f"kinematic/{STREAMS[stream]}"], parts[f"energy/{STREAMS[stream]}"]
    assert kin > 1
    assert energy > 1e-3
    assert float(total) == pytest.approx(kin + CONFIG.weight_energy * energy, rel=1e-5)
    assert all(value == 0 for name, value in parts.items() if not name.endswith(STREAMS[stream]))


@pytest.mark.parametrize("stream", range(3), ids=STREAMS)
def test_each_weight_scales_its_own_part(stream: int) -> None:
    name = STREAMS[stream]
    given = motions()[stream]
    answer = 1.1 * given + 0.01
    for order, weight in enumerate(("weight_position", "weight_velocity", "weight_acceleration")):
        nothing = replace(CONFIG, weight_position=0, weight_velocity=0, weight_acceleration=0)
        _, parts, _ = loss_of(replace(nothing, **{weight: 2.0}), wrong=stream)
        difference = (answer - given).diff(n=order, dim=1) if order else answer - given
        assert parts[f"kinematic/{name}"] == pytest.approx(200 * float(difference.abs().mean()), rel=1e-4)
    usual, parts, _ = loss_of(wrong=stream)
    more, _, _ = loss_of(replace(CONFIG, weight_energy=2 * CONFIG.weight_energy), wrong=stream)
    assert float(more - usual) == pytest.approx(CONFIG.weight_energy * parts[f"energy/{name}"], rel=1e-3)


def test_the_latent_loss_is_equation_5_in_all_streams() -> None:
    """Features 0.5 from the codes: 0.25 (1 + beta) in each of three streams; features are pulled to the codes, and the
    codes, beta times as much, to the features."""
    total, parts, streams = loss_of(apart=0.5)
    assert all(parts[f"latent/{s}"] == pytest.approx(0.25 * (1 + CONFIG.beta)) for s in STREAMS)
    assert float(total) == pytest.approx(3 * CONFIG.weight_latent * 0.25 * (1 + CONFIG.beta), rel=1e-5)
    total.backward()
    for stream in streams:
        features, codes = stream.v.grad, stream.codes.grad
        assert features is not None
        assert codes is not None
        step = CONFIG.weight_latent * 2 * 0.5 / stream.v.numel()
        assert torch.allclose(features, torch.full_like(features, step))
        assert torch.allclose(codes, torch.full_like(codes, -CONFIG.beta * step))


def test_the_quantisers_penalty_is_added() -> None:
    assert float(loss_of(penalty=0.7)[0]) == pytest.approx(3 * 0.7)


def test_masking_is_of_training_alone_and_hides_the_upper_layer() -> None:
    masking = MaskingConfig(residual=1.0, base_noise=0.0, code=0.0)
    config = replace(CONFIG, layers=2, scales=(1.0, 0.25), masking=masking)
    _, _, streams = loss_of(config, training=True)
    assert all(torch.equal(s.decoded_from[0], torch.ones(2, FRAMES // 4, LATENT)) for s in streams)
    _, _, streams = loss_of(config, training=False)
    assert all(torch.equal(s.decoded_from[0], torch.full((2, FRAMES // 4, LATENT), 2.0)) for s in streams)
    slow = motions(1)
    far, _, _ = loss_of(config, training=True, slow=slow)
    assert float(far) > 100, "what hidden windows should decode to is the slow motion"


def test_a_single_layer_has_nothing_to_hide_so_its_target_stays_the_whole_motion() -> None:
    masking = MaskingConfig(residual=1.0, base_noise=0.0, code=0.0)
    total, _, _ = loss_of(replace(CONFIG, masking=masking), training=True, slow=motions(1))
    assert float(total) == 0
