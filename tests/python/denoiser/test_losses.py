"""Losses of stage 2, on motions whose loss is known."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from training.config import DenoiserLossConfig
from training.data.made import made_dancer
from training.denoiser.losses import (
    contact_loss,
    energy_loss,
    motion_loss,
    noise_weights,
    orientation_loss,
    simple_loss,
)
from training.motion.heading import hip_heading
from training.motion.skeleton import FEET


def turned(motion: torch.Tensor, angle: float) -> torch.Tensor:
    c, s = np.cos(angle), np.sin(angle)
    return motion @ torch.tensor([[c, 0, s], [0, 1, 0], [-s, 0, c]], dtype=torch.float32).T


def dancer(seed: int = 0, frames: int = 20) -> torch.Tensor:
    return torch.from_numpy(made_dancer(frames, seed))[None]


@pytest.mark.parametrize("angle", [0.0, np.pi / 2, np.pi, -np.pi])
def test_orientation_loss_is_finite_and_differentiable_face_to_face(angle: float) -> None:
    """Partners at 180 degrees are the normal hold."""
    leader = dancer()
    predicted = turned(leader, angle).requires_grad_(True)
    loss = orientation_loss(leader, turned(leader, angle + 0.3), predicted).mean()
    (gradient,) = torch.autograd.grad(loss, predicted)
    assert loss.isfinite()
    assert gradient.isfinite().all()
    assert gradient.abs().max() > 0
    # Unit vectors 0.3 rad apart: 2 - 2 cos 0.3.
    assert float(loss.detach()) == pytest.approx(2 - 2 * np.cos(0.3), abs=1e-3)


def test_orientation_loss_is_finite_without_a_heading() -> None:
    leader = torch.zeros(1, 4, 22, 3, requires_grad=True)
    loss = orientation_loss(leader, leader.detach(), leader).mean()
    (gradient,) = torch.autograd.grad(loss, leader)
    assert loss.isfinite()
    assert gradient.isfinite().all()
    assert hip_heading(torch.zeros(22, 3)).isfinite().all()


def test_orientation_is_relative_to_the_leader() -> None:
    leader, truth, made = dancer(0), dancer(1), dancer(2)
    before = orientation_loss(leader, truth, made)
    assert torch.allclose(
        before, orientation_loss(turned(leader, 1.0), turned(truth, 1.0), turned(made, 1.0)), atol=1e-4
    )
    assert orientation_loss(leader, truth, truth).abs().max() < 1e-6


def test_contact_loss_is_the_speed_of_planted_feet_alone() -> None:
    truth = torch.zeros(1, 10, 22, 3)
    truth[:, :, 10] = torch.arange(10.0)[:, None] * 0.05  # the left toe moves, the other feet stand
    slide = truth.clone()
    slide[:, :, 11, 0] += torch.arange(10.0) * 0.02  # 2 cm a frame under the planted right toe
    assert float(contact_loss(truth, truth)) == pytest.approx(0, abs=1e-2)
    assert float(contact_loss(truth, slide)) == pytest.approx(2 / 3, abs=1e-2), "one of three planted feet"
    swing = truth.clone()
    swing[:, :, 10, 0] += torch.arange(10.0) * 0.02
    assert float(contact_loss(truth, swing)) == pytest.approx(0, abs=1e-2)


@pytest.mark.parametrize(("step", "planted"), [(0.008, True), (0.012, False)])
def test_a_foot_is_planted_below_a_centimetre_a_frame(step: float, planted: bool) -> None:
    truth = torch.zeros(1, 10, 22, 3)
    for foot in FEET:
        truth[:, :, foot, 0] = torch.arange(10.0) * step
    still = torch.zeros_like(truth)
    assert float(contact_loss(truth, truth)) == pytest.approx(100 * step if planted else 0, abs=1e-2)
    assert float(contact_loss(truth, still)) == pytest.approx(0, abs=1e-2)


def test_each_weight_scales_its_own_layer() -> None:
    """Eq. 6's lambda."""
    truth = torch.zeros(2, 5, 2, 4)
    predicted = truth.clone()
    predicted[:, :, 0], predicted[:, :, 1] = 1.0, 3.0
    valid = torch.ones(2, 5)
    assert float(simple_loss(truth, predicted, valid, (1.0, 0.0), torch.ones(2))[0]) == pytest.approx(1)
    assert float(simple_loss(truth, predicted, valid, (0.0, 1.0), torch.ones(2))[0]) == pytest.approx(9)
    total, layers = simple_loss(truth, predicted, valid, (2.0, 0.5), torch.ones(2))
    assert float(total) == pytest.approx(2 + 4.5)
    assert layers.tolist() == [1.0, 9.0]


def test_padded_tokens_have_no_loss() -> None:
    truth = torch.zeros(1, 6, 2, 4)
    predicted = truth.clone()
    predicted[:, 3:] = 100
    valid = torch.tensor([[1.0, 1, 1, 0, 0, 0]])
    assert float(simple_loss(truth, predicted, valid, (1.0, 1.0), torch.ones(1))[0]) == 0


def test_losses_of_motion_are_proportional_to_alpha_bar() -> None:
    """At alpha bar 0 they are 0."""
    leader, truth, made = dancer(0), dancer(1), dancer(2)
    config = DenoiserLossConfig()
    full = motion_loss(leader, truth, made, torch.ones(1), config)
    half = motion_loss(leader, truth, made, torch.full((1,), 0.5), config)
    none = motion_loss(leader, truth, made, torch.zeros(1), config)
    for name, value in full.items():
        assert float(value) > 0, name
        assert float(half[name]) == pytest.approx(float(value) / 2, rel=1e-4)
        assert float(none[name]) == 0


def test_energy_loss_depends_on_speed_not_on_place() -> None:
    truth = dancer(1, 60)
    assert float(energy_loss(truth, truth)) == 0
    assert float(energy_loss(truth, truth + 1)) == pytest.approx(0, abs=1e-6)
    assert float(energy_loss(truth, turned(truth, 1.0))) == pytest.approx(0, abs=1e-4)
    # Half the pace in speed, in acceleration and in jerk: three times the square of log 2.
    assert float(energy_loss(9 * truth, 4.5 * truth)) == pytest.approx(3 * np.log(2) ** 2, rel=0.1)


def test_noise_weights_grow_with_the_signal_to_noise_ratio() -> None:
    signal = torch.linspace(0.01, 0.99, 50)
    assert torch.equal(noise_weights(signal, 0.0), torch.ones(50))
    weights = noise_weights(signal, 0.5)
    assert float(weights.mean()) == pytest.approx(1)
    assert (weights.diff() >= 0).all()
    assert float(weights[0]) == pytest.approx(0.5, abs=0.01), "noisy windows keep half of their weight"
    assert weights[-1] == weights[-5], "the ratio is capped"
    truth, valid = torch.zeros(2, 5, 1, 4), torch.ones(2, 5)
    predicted = torch.stack([torch.zeros(5, 1, 4), torch.ones(5, 1, 4)])
    assert float(simple_loss(truth, predicted, valid, (1.0,), torch.tensor([0.5, 1.5]))[0]) == pytest.approx(
        0.75
    )
