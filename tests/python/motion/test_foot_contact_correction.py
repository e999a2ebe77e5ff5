"""Planted feet that slide stop, and everything else stays as it was."""

from __future__ import annotations

import numpy as np
import pytest
import torch
from scipy.optimize import minimize
from torch import Tensor

import training.motion.foot_contact_correction as correction
from tests.python.support.duets import made_duet
from training.config import FPS
from training.motion.foot_contact_correction import RETURN, STIFFNESS, correct_foot_contact
from training.motion.skeleton import FEET

FRAMES = 180
STRENGTH = 0.9


def standing(frames: int = FRAMES) -> Tensor:
    """A body that stands still, feet at their height of rest."""
    pose = torch.from_numpy(made_duet(30, 1).reactor[:1]).clone()
    pose[:, list(FEET), 1] = torch.tensor(correction.REST_HEIGHTS)
    return pose.expand(frames, 22, 3).clone()


def slid(speed: float, seconds: float) -> Tensor:
    """`standing`, moved along x with `speed` m/s for some seconds in the middle."""
    motion = standing()
    half = int(seconds * FPS / 2)
    moved = torch.zeros(FRAMES)
    moved[FRAMES // 2 - half : FRAMES // 2 + half] = speed / FPS
    motion[..., 0] += moved.cumsum(0)[:, None]
    return motion


def foot_speed(motion: Tensor) -> np.ndarray:
    """(T - 1) m/s of the left toe over the floor."""
    toe = motion[:, 10, ::2]
    return ((toe[1:] - toe[:-1]) * FPS).norm(dim=-1).numpy()


def test_a_planted_foot_that_slides_a_little_stops() -> None:
    motion = slid(0.3, 0.2)
    middle = slice(FRAMES // 2 - 3, FRAMES // 2 + 1)
    assert foot_speed(motion)[middle].mean() == pytest.approx(0.3, rel=1e-3)
    assert foot_speed(correct_foot_contact(motion, STRENGTH))[middle].mean() < 0.05


def test_a_foot_that_is_dragged_fast_keeps_moving() -> None:
    motion = slid(3.0, 0.5)
    middle = slice(FRAMES // 2 - 5, FRAMES // 2 + 5)
    assert foot_speed(correct_foot_contact(motion, STRENGTH))[middle].mean() > 0.8 * 3.0


def test_a_body_in_the_air_or_at_rest_is_left_alone() -> None:
    high = slid(0.3, 0.5) + torch.tensor([0.0, 0.3, 0.0])
    assert torch.allclose(correct_foot_contact(high, STRENGTH), high, atol=2e-3)
    assert torch.allclose(correct_foot_contact(standing(), STRENGTH), standing(), atol=1e-6)


def test_a_rising_foot_is_not_in_contact() -> None:
    motion = slid(0.3, 0.5)
    motion[..., 1] += (torch.arange(FRAMES) % 2 * 0.02)[:, None]  # 0.6 m/s up and down, low all the time
    assert torch.allclose(correct_foot_contact(motion, STRENGTH), motion, atol=2e-3)


def test_of_two_planted_feet_the_slower_one_counts_for_more() -> None:
    motion = standing()
    motion[:, [8, 11], 0] += (torch.arange(FRAMES) * 0.5 / FPS)[:, None]
    velocity, planted = correction._planted_velocity(motion)
    assert planted.min() > 0.9
    assert velocity[0].abs().max() < 0.05


def test_only_the_place_on_the_floor_changes_and_the_whole_body_moves() -> None:
    motion = torch.from_numpy(made_duet(150, 5).reactor)
    shift = correct_foot_contact(motion, STRENGTH) - motion
    assert shift[..., ::2].abs().max() > 0.005
    assert shift[..., 1].abs().max() == 0
    assert torch.allclose(shift, shift[:, :1].expand_as(shift), atol=1e-5)


def test_the_correction_of_a_turned_motion_is_turned() -> None:
    motion = torch.from_numpy(made_duet(150, 5).reactor)
    c, s = np.cos(0.7), np.sin(0.7)
    turn = torch.tensor([[c, 0, s], [0, 1, 0], [-s, 0, c]], dtype=torch.float32)
    away = torch.tensor([2.0, 0.0, -1.0])
    assert torch.allclose(
        correct_foot_contact(motion @ turn + away, STRENGTH),
        correct_foot_contact(motion, STRENGTH) @ turn + away,
        atol=1e-3,
    )


def test_without_strength_nothing_moves() -> None:
    motion = torch.from_numpy(made_duet(20, 5).reactor)
    assert torch.equal(correct_foot_contact(motion, 0.0), motion)


@pytest.mark.parametrize("frames", [2, 4, 40])
def test_short_dances_keep_their_length(frames: int) -> None:
    motion = torch.from_numpy(made_duet(frames, 5).reactor)
    assert correct_foot_contact(motion, STRENGTH).shape == motion.shape


def test_the_correction_is_the_minimum_of_its_objective(monkeypatch: pytest.MonkeyPatch) -> None:
    """Against a general optimiser, which knows nothing of convolutions and starts where the method ends."""
    motion = torch.from_numpy(made_duet(FRAMES, 5).reactor).double()
    velocity, planted = (x.numpy() for x in correction._planted_velocity(motion))

    def cost(way: np.ndarray) -> float:
        e = way.reshape(2, FRAMES)
        left = np.sqrt(((velocity + np.diff(e) * FPS) ** 2).sum(0) + 1e-10)
        bend = np.diff(e, 2) * FPS**2
        return (
            STRENGTH * (planted * left).sum()
            + (e**2).sum() / (2 * RETURN**2)
            + STIFFNESS / 2 * (bend**2).sum()
        )

    def way_of(rounds: int) -> np.ndarray:
        monkeypatch.setattr(correction, "ITERATIONS", rounds)
        return (correct_foot_contact(motion, STRENGTH) - motion)[:, 0, ::2].T.numpy().ravel()

    still, few, many = cost(np.zeros(2 * FRAMES)), cost(way_of(correction.ITERATIONS)), cost(way_of(400))
    least = minimize(cost, way_of(400), method="L-BFGS-B", options={"maxiter": 30, "maxfun": 20_000}).fun
    assert many - least < 0.01 * (still - least)
    assert few - least < 0.05 * (still - least)
