"""Stage 2's loss as the program puts it together: what the network is asked and should answer, and its weights."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import torch
from torch import Tensor, nn

from tests.python.support.duets import made_duet
from training.config import (
    STRIDE,
    ConditionConfig,
    DenoiserLossConfig,
    DiffusionConfig,
    FrameConfig,
    HfsqConfig,
)
from training.denoiser.clips import Augmentation, Clip, feature_values, make_clip
from training.denoiser.losses import decoded_windows
from training.denoiser.windows import Batch, Windows
from training.hfsq.autoencoder import Autoencoder
from training.train_denoiser import Options, Stage2

BLOCK, MARGIN, WINDOWS = 10, 2, 12
LOSS = DenoiserLossConfig(layers=(1.0,), windows=4)
PLAIN = replace(ConditionConfig(), leader_shift=0, blurred=0.0, drop_music=0.0)


class KnownAnswer(nn.Module):
    """In the network's place: answers with the given latents and keeps what it was asked."""

    def __init__(self, answer: Tensor) -> None:
        super().__init__()
        self.answer = answer
        self.config = SimpleNamespace(condition=ConditionConfig())
        self.asked: dict[str, Tensor] = {}

    def condition(self, features: Tensor, *_: Tensor) -> Tensor:
        """Each token of the memory holds the first feature of its first frame, so that its place is known."""
        return features[:, ::STRIDE, :1]

    def forward(
        self, x: Tensor, time: Tensor, memory: Tensor, valid: Tensor, keep_leader: Tensor, keep_music: Tensor
    ) -> Tensor:
        self.asked = {"x": x, "time": time, "memory": memory, "valid": valid}
        self.asked |= {"keep_leader": keep_leader, "keep_music": keep_music}
        return self.answer


@pytest.fixture(scope="module")
def hfsq() -> Autoencoder:
    """Latents that are the motion itself, with statistics that are not those of normalised latents."""
    torch.manual_seed(0)
    model = Autoencoder(HfsqConfig(quantiser="none", layers=1, scales=(1.0,), masking=None)).eval()
    model.latent_mean.fill_(0.1)
    model.latent_std.fill_(0.5)
    return model.requires_grad_(False)


@pytest.fixture(scope="module")
def clip(hfsq: Autoencoder) -> Clip:
    return make_clip(made_duet(240, 3), [np.ones((240, 54))], 0.0, hfsq, FrameConfig(), blur=6.0)


@pytest.fixture(scope="module")
def batch(clip: Clip) -> Batch:
    return Windows([clip], BLOCK, MARGIN, STRIDE, PLAIN).batch(
        WINDOWS, np.random.default_rng(0), short=0.0, song_ends=0.0
    )


def loss_of(
    hfsq: Autoencoder, batch: Batch, answer: Tensor, loss: DenoiserLossConfig = LOSS
) -> tuple[float, dict[str, float], KnownAnswer]:
    """The loss, its parts and the network of one forward pass with fixed noise."""
    network = KnownAnswer(answer)
    stage = Stage2(network, hfsq, DiffusionConfig(), loss)  # pyright: ignore[reportArgumentType]
    torch.manual_seed(1)
    total, parts = stage(batch)
    return float(total), {name: float(part) for name, part in parts.items()}, network


def near(batch: Batch, rows: slice = slice(None)) -> Tensor:
    """The true latents, wrong by a little in those windows."""
    wrong = batch.latents.clone()
    wrong[rows] += 0.1 * torch.randn(wrong[rows].shape, generator=torch.Generator().manual_seed(2))
    return wrong


def test_latents_of_a_clip_are_normalised_and_decode_to_its_motion(
    hfsq: Autoencoder, clip: Clip, batch: Batch
):
    assert torch.allclose(hfsq.normalise(hfsq.denormalise(clip.latents)), clip.latents, atol=1e-5)
    rows = [1, 3]
    decoded = decoded_windows(hfsq, batch.latents[rows], batch, rows)
    assert (decoded - batch.reactor[rows]).abs().max() < 2e-3


def test_the_true_latents_have_no_loss_and_the_noisy_ones_have(hfsq: Autoencoder, batch: Batch) -> None:
    total, parts, network = loss_of(hfsq, batch, batch.latents)
    assert parts["simple/0"] == 0
    for name in ("kinematic", "energy", "orientation"):
        assert parts[name] < 0.05, "but for the rounding of bones; true feet move a little while they stand"
    noisy, noisy_parts, _ = loss_of(hfsq, batch, network.asked["x"])
    assert noisy_parts["simple/0"] > 0.1
    assert noisy > total + 0.1


def test_the_network_sees_noise_of_the_time_it_is_told(hfsq: Autoencoder, batch: Batch) -> None:
    """x = sqrt(alpha bar) x0 + sqrt(1 - alpha bar) noise, the noise of variance 1."""
    _, _, network = loss_of(hfsq, batch, batch.latents)
    stage = Stage2(network, hfsq, DiffusionConfig(), LOSS)  # pyright: ignore[reportArgumentType]
    time = network.asked["time"]
    assert (time.diff() > 0).all(), "stratified and sorted"
    signal = stage.alpha_bar[(time * stage.steps).round().long()][:, None, None, None]
    noise = (network.asked["x"] - signal.sqrt() * batch.latents) / (1 - signal).sqrt()
    assert noise[2:].std() == pytest.approx(1, abs=0.05)
    assert abs(float(noise[2:].mean())) < 0.05


def test_memory_is_cut_to_the_frames_of_the_latents(hfsq: Autoencoder, batch: Batch) -> None:
    _, _, network = loss_of(hfsq, batch, batch.latents)
    expected = batch.features[:, STRIDE * MARGIN : STRIDE * (MARGIN + BLOCK) : STRIDE, :1]
    assert torch.equal(network.asked["memory"], expected)
    assert torch.equal(network.asked["valid"], batch.valid)


def test_conditions_are_dropped_by_layer_and_by_window(hfsq: Autoencoder, batch: Batch) -> None:
    """Two layers of many windows: neither all alike, nor the leader's alike with the music's."""
    many = Batch(*(value.repeat(40, *[1] * (value.dim() - 1)) for value in batch))
    many = many._replace(latents=many.latents.repeat(1, 1, 2, 1))
    loss = replace(LOSS, windows=0)
    _, _, network = loss_of(hfsq, many, many.latents, loss)
    leader, music = network.asked["keep_leader"], network.asked["keep_music"]
    assert leader.shape == music.shape == (len(many.latents), 2)
    for keep in (leader, music):
        assert 0.5 < keep.mean() < 0.9
        assert (keep[:, 0] != keep[:, 1]).any()
    assert (leader != music).any()
    assert (leader <= music).all(), "the music is kept wherever the leader is"


@pytest.mark.parametrize("weight", ["kinematic", "contact", "energy", "orientation"])
def test_each_weight_of_motion_scales_its_own_part(hfsq: Autoencoder, batch: Batch, weight: str) -> None:
    usual, parts, _ = loss_of(hfsq, batch, near(batch))
    more, more_parts, _ = loss_of(
        hfsq, batch, near(batch), replace(LOSS, **{weight: 2 * getattr(LOSS, weight)})
    )
    assert parts[weight] > 1e-4
    assert more_parts == pytest.approx(parts | {weight: 2 * parts[weight]}, rel=1e-5)
    assert more - usual == pytest.approx(parts[weight], rel=1e-2)


def test_the_loss_is_the_sum_of_its_parts(hfsq: Autoencoder, batch: Batch) -> None:
    """Without weights by the signal-to-noise ratio Eq. 6 is the plain error times the layer's weight."""
    loss = replace(LOSS, snr=0.0, layers=(3.0,))
    total, parts, _ = loss_of(hfsq, batch, near(batch), loss)
    motion = sum(parts[name] for name in ("kinematic", "contact", "energy", "orientation"))
    assert total == pytest.approx(3 * parts["simple/0"] + motion, rel=1e-4)
    assert {f.name for f in fields(DenoiserLossConfig)} >= {"kinematic", "contact", "energy", "orientation"}


def test_only_the_cleanest_windows_are_compared_as_motion(hfsq: Autoencoder, batch: Batch) -> None:
    _, clean, _ = loss_of(hfsq, batch, batch.latents)
    _, noisiest_wrong, _ = loss_of(hfsq, batch, near(batch, slice(LOSS.windows, None)))
    _, cleanest_wrong, _ = loss_of(hfsq, batch, near(batch, slice(0, LOSS.windows)))
    for name in ("kinematic", "energy"):
        assert noisiest_wrong[name] == clean[name]
        assert cleanest_wrong[name] > clean[name] + 1e-4


def test_windows_that_are_cut_short_are_not_compared_as_motion(hfsq: Autoencoder, batch: Batch) -> None:
    valid = batch.valid.clone()
    valid[: LOSS.windows, -1] = 0
    _, parts, _ = loss_of(hfsq, batch._replace(valid=valid), near(batch))
    assert set(parts) == {"simple/0"}


def test_motion_counts_by_its_share_of_signal(hfsq: Autoencoder, batch: Batch) -> None:
    """The same error in the cleanest window costs more than in the noisiest of those that are decoded."""
    loss = replace(LOSS, windows=WINDOWS)
    same = batch._replace(
        **{n: v[:1].repeat(WINDOWS, *[1] * (v.dim() - 1)) for n, v in batch._asdict().items()}
    )
    base = loss_of(hfsq, same, same.latents, loss)[1]["kinematic"]
    first, last = (
        loss_of(hfsq, same, near(same, slice(row, row + 1)), loss)[1]["kinematic"] - base
        for row in (0, WINDOWS - 1)
    )
    assert first > 20 * last > 0


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"batch": 4}, "a batch of 4 windows has no 8 to decode"),
        ({"solo_copies": 2}, "--solo-copies is of the dances of --solo"),
        ({"solo_prefixes": ("indian",)}, "--solo-prefixes chooses among the dances of --solo"),
        ({"diffusion": DiffusionConfig(last_time=1.5)}, "the last time has to be between"),
        ({"val": ()}, "name one or more with --val"),
        ({"pieces": 5}, "--pieces is the number of songs from --songs"),
        ({"stride": 6}, "a stride of 6 frames is not a multiple of 4"),
        ({"loss": DenoiserLossConfig(layers=(1.0,))}, "need as many --loss.layers"),
        ({"minutes": 0.0}, "--minutes 0 is not at least"),
        ({"steps": 0}, "--steps 0 is not at least 1"),
        ({"log_every": 0}, "--log-every 0 is not at least 1"),
        ({"ema_decay": 2.0}, "--ema-decay 2 is not between 0 and 1"),
    ],
)
def test_options_that_are_wrong_or_would_be_ignored_are_refused(changes: dict, sentence: str) -> None:
    given = {"data": Path("duets.npz"), "out": Path("out"), "val": ("one",)} | changes
    with pytest.raises(ValueError, match=sentence):
        Options(**given)


@pytest.mark.parametrize(
    ("config", "changes", "sentence"),
    [
        (DiffusionConfig, {"steps": 2000}, "--steps 2000 is not between 1 and 1000"),
        (
            DiffusionConfig,
            {"extrapolation": (0.0, 99.0, 0.0)},
            "--extrapolation 99 is not between -10 and 10",
        ),
        (DiffusionConfig, {"mean_seeds": 0}, "--mean-seeds 0 is not between 1 and 64"),
        (ConditionConfig, {"drop_layer": 2.0}, "--drop-layer 2 is not between 0 and 1"),
        (ConditionConfig, {"leader": False, "music": False}, "leave nothing to react to"),
        (DenoiserLossConfig, {"snr": 3.0}, "--snr 3 is not between 0 and 1"),
        (Augmentation, {"copies": 0}, "--copies 0 is not at least 1"),
        (Augmentation, {"scales": (1.2, 0.8)}, "--scales are the least and the greatest"),
    ],
)
def test_values_outside_their_limits_are_refused(config: type, changes: dict, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        config(**changes)


def test_a_weight_for_every_residual_layer(hfsq: Autoencoder, batch: Batch) -> None:
    with pytest.raises(ValueError, match=r"stage 1 has 1 residual layers, so --loss\.layers needs"):
        loss_of(hfsq, batch, batch.latents, replace(LOSS, layers=(1.0, 0.5)))


def test_a_training_without_music_is_refused(clip: Clip) -> None:
    with pytest.raises(ValueError, match="no music beside it"):
        feature_values([replace(clip, music=[])])


@pytest.mark.parametrize("stride", [1, 2, 6, 0])
def test_a_stride_that_latent_frames_cannot_follow_is_refused(clip: Clip, stride: int) -> None:
    with pytest.raises(ValueError, match=f"stride of {stride} frames"):
        Windows([clip], BLOCK, MARGIN, stride, PLAIN)


def test_the_stride_is_the_distance_of_training_windows(clip: Clip) -> None:
    starts = [s for _, s in Windows([clip], BLOCK, MARGIN, 16, PLAIN).starts]
    assert starts == list(range(0, len(clip) - BLOCK + 1, 4))
