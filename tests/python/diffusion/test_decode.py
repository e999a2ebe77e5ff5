"""From latents to joints: the clamp, the gains of the layers and the lengths of the bones."""

from __future__ import annotations

import pytest
import torch
from torch import Tensor

from export.tiny import tiny_model
from training.config import STREAMS, STRIDE
from training.data.made import made_dancer
from training.diffusion.decode import decode
from training.diffusion.model import Model
from training.motion.rigid_body import bone_lengths
from training.motion.skeleton import JOINTS

LATENTS = 40


@pytest.fixture(scope="module")
def model() -> Model:
    return tiny_model()


@pytest.fixture(scope="module")
def leader() -> Tensor:
    return torch.from_numpy(made_dancer(STRIDE * LATENTS, 1))


def latents_of(model: Model, scale: float = 0.1) -> Tensor:
    torch.manual_seed(0)
    return scale * torch.randn(LATENTS, model.denoiser.layers, model.denoiser.latent_width)


BONES = torch.linspace(0.1, 0.4, len(JOINTS))
EVERY = torch.ones(len(STREAMS), 2)


@torch.no_grad()
def test_latents_are_clamped_to_the_range_of_the_quantiser_before_they_are_decoded(
    model: Model, leader: Tensor
) -> None:
    beyond = latents_of(model, 20.0)
    lowest, highest = model.denoiser.lowest, model.denoiser.highest
    inside = beyond.clamp(lowest, highest)
    assert not torch.allclose(beyond, inside)
    made, _ = model.decode(beyond, leader, EVERY, BONES)
    assert torch.equal(made, model.decode(inside, leader, EVERY, BONES)[0])
    unclamped, _ = decode(model.hfsq, model.frame, model.diffusion, beyond, leader, EVERY, BONES)
    assert not torch.allclose(made, unclamped, atol=1e-2)


@torch.no_grad()
@pytest.mark.parametrize("stream", range(len(STREAMS)))
@pytest.mark.parametrize("gain", [0.0, 0.5, 1.5])
def test_a_gain_multiplies_the_dequantised_layer_of_its_stream(
    model: Model, leader: Tensor, stream: int, gain: float
) -> None:
    """After the clamp: guidance of the fine layer may go beyond the range that its latents keep to."""
    latents, gains = latents_of(model, 1.0), EVERY.clone()
    gains[stream, 1] = gain
    raw = model.hfsq.denormalise(latents)
    raw.unflatten(-1, (len(STREAMS), -1))[:, 1, stream] *= gain
    args = (model.hfsq, model.frame, model.diffusion)
    expected, _ = decode(*args, model.hfsq.normalise(raw), leader, EVERY, BONES)
    made, _ = decode(*args, latents, leader, gains, BONES)
    assert (made - expected).abs().max() < 2e-5
    assert (made - decode(*args, latents, leader, EVERY, BONES)[0]).abs().max() > 1e-3


@torch.no_grad()
def test_bones_have_the_lengths_they_are_given_and_those_before_are_reported(
    model: Model, leader: Tensor
) -> None:
    latents = latents_of(model)
    made, before = model.decode(latents, leader, EVERY, BONES)
    lengths = bone_lengths(made[None])[0]
    assert torch.allclose(lengths[:, 1:], BONES[1:].expand(len(made), -1), atol=1e-4)
    assert before.shape == lengths.shape
    assert before[:, 1:].std(0).min() > 1e-4, "the decoder's own bones change"
    other, again = model.decode(latents, leader, EVERY, 2 * BONES)
    assert torch.equal(before, again)
    assert not torch.allclose(made, other, atol=1e-2)
