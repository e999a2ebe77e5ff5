"""From latents to joints: the clamp, the gains of the layers and the bodies of the roles."""

from __future__ import annotations

import pytest
import torch
from torch import Tensor

from export.tiny import tiny_model
from training.config import STREAMS, STRIDE
from training.data.made import made_dancer
from training.diffusion.decode import decode, decoded_joints
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
REACTOR, LEADER = torch.zeros(1), torch.ones(1)
EVERY = torch.ones(len(STREAMS), 2)


@torch.no_grad()
def test_latents_are_clamped_to_the_range_of_the_quantiser_before_they_are_decoded(
    model: Model, leader: Tensor
) -> None:
    beyond = latents_of(model, 20.0)
    lowest, highest = model.denoiser.lowest, model.denoiser.highest
    inside = beyond.clamp(lowest, highest)
    assert not torch.allclose(beyond, inside)
    made = model.decode(beyond, leader, EVERY, REACTOR)
    assert torch.equal(made, model.decode(inside, leader, EVERY, REACTOR))
    bones = model.denoiser.bodies[0].norm(dim=-1)
    unclamped = decode(model.hfsq, model.frame, model.diffusion, beyond, leader, EVERY, bones)
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
    expected = decode(*args, model.hfsq.normalise(raw), leader, EVERY, BONES)
    made = decode(*args, latents, leader, gains, BONES)
    assert (made - expected).abs().max() < 2e-5
    assert (made - decode(*args, latents, leader, EVERY, BONES)).abs().max() > 1e-3


@torch.no_grad()
def test_each_role_dances_on_bones_of_its_own_body(model: Model, leader: Tensor) -> None:
    latents = latents_of(model)
    lengths: list[Tensor] = []
    for role, body in zip((REACTOR, LEADER), model.denoiser.bodies, strict=True):
        lengths.append(bone_lengths(model.decode(latents, leader, EVERY, role)[None])[0])
        assert torch.allclose(lengths[-1], body.norm(dim=-1).expand_as(lengths[-1]), atol=1e-4)
    assert (lengths[1] / lengths[0]).mean() > 1.05
    joints = decoded_joints(model.hfsq, model.frame, latents, leader, EVERY)
    assert bone_lengths(joints[None])[0, :, 1:].std(0).min() > 1e-4, "as decoded, bones change their lengths"


@torch.no_grad()
def test_a_jerk_of_the_leader_does_not_pass_to_the_reactor(model: Model, leader: Tensor) -> None:
    """One frame of a capture that is 5 cm off: raw, that would be an acceleration of 90 m/s^2 of both."""
    latents = latents_of(model)
    jerky = leader.clone()
    jerky[80] += torch.tensor([0.04, 0.0, 0.03])
    made, after = (
        decoded_joints(model.hfsq, model.frame, latents, one, EVERY)[:, 0] for one in (leader, jerky)
    )
    apart = (after - made).norm(dim=-1)
    assert 1e-3 < apart.max() < 0.011
    assert apart[[72, 88]].max() < 1e-6
    # A leader who stands elsewhere has the reactor there.
    elsewhere = decoded_joints(
        model.hfsq, model.frame, latents, leader + torch.tensor([1.0, 0.0, -2.0]), EVERY
    )
    assert torch.allclose(elsewhere[:, 0] - made, torch.tensor([1.0, 0.0, -2.0]), atol=1e-5)
