"""Augmentations: what they change and what they must keep."""

from __future__ import annotations

import numpy as np
import pytest

from tests.python.support.duets import made_duet
from training.data.augment import (
    mirror,
    scale_leader,
    swap_roles,
    tempo_warp,
    warp_factor,
    warp_motion,
    warped_length,
)
from training.data.duet import Duet
from training.motion.skeleton import JOINTS, PARENTS, body_height


@pytest.fixture
def duet() -> Duet:
    return made_duet(121, seed=5)


def bone_lengths(motion: np.ndarray) -> np.ndarray:
    """(T, 21) lengths of all bones."""
    return np.linalg.norm(motion[:, 1:] - motion[:, list(PARENTS[1:])], axis=-1)


def test_mirror_twice_is_the_identity(duet: Duet) -> None:
    twice = mirror(mirror(duet))
    np.testing.assert_array_equal(twice.leader, duet.leader)
    np.testing.assert_array_equal(twice.reactor, duet.reactor)


def test_mirror_exchanges_sides_and_keeps_distances(duet: Duet) -> None:
    seen = mirror(duet)
    left, right = JOINTS.index("left_wrist"), JOINTS.index("right_wrist")
    np.testing.assert_array_equal(seen.leader[:, left], duet.leader[:, right] * [-1, 1, 1])
    gap = np.linalg.norm(duet.leader[:, right] - duet.reactor[:, left], axis=-1)
    np.testing.assert_allclose(np.linalg.norm(seen.leader[:, left] - seen.reactor[:, right], axis=-1), gap)


def test_swap_roles(duet: Duet) -> None:
    swapped = swap_roles(duet)
    assert swapped.leader is duet.reactor
    assert swapped.reactor is duet.leader


@pytest.mark.parametrize("factor", [0.8, 0.93, 1.1, 1.25])
def test_tempo_warp_keeps_ends_and_path(duet: Duet, factor: float) -> None:
    warped = tempo_warp(duet, factor)
    assert len(warped) == warped_length(len(duet), factor)
    assert warp_factor(len(duet), factor) == pytest.approx(factor, rel=0.01)
    assert warped.leader.dtype == np.float32
    for before, after in ((duet.leader, warped.leader), (duet.reactor, warped.reactor)):
        np.testing.assert_allclose(after[[0, -1]], before[[0, -1]], atol=1e-6)
        # Bones keep their lengths although joints are interpolated one by one.
        np.testing.assert_allclose(bone_lengths(after).mean(0), bone_lengths(before).mean(0), atol=2e-4)
        speed = np.linalg.norm(np.diff(after[:, 0], axis=0), axis=-1).mean()
        assert speed == pytest.approx(
            factor * np.linalg.norm(np.diff(before[:, 0], axis=0), axis=-1).mean(), rel=0.02
        )


def test_tempo_warp_is_exact_on_a_parabola() -> None:
    time = np.arange(30.0)
    motion = np.repeat((time**2 - 3 * time)[:, None, None], 22, axis=1).repeat(3, axis=2).astype(np.float32)
    at = np.linspace(0, 29, warped_length(30, 0.7))
    np.testing.assert_allclose(warp_motion(motion, 0.7)[:, 0, 0], at**2 - 3 * at, rtol=1e-4, atol=1e-3)


def test_a_warp_factor_of_zero_is_an_error() -> None:
    with pytest.raises(ValueError, match="0 times as fast"):
        warped_length(10, 0)


def test_scaled_leader_is_taller_at_the_same_place(duet: Duet) -> None:
    scaled = scale_leader(duet, 1.1)
    assert body_height(scaled.leader) == pytest.approx(1.1 * body_height(duet.leader), rel=1e-5)
    np.testing.assert_allclose(scaled.leader[:, 0, [0, 2]], duet.leader[:, 0, [0, 2]], atol=1e-6)
    np.testing.assert_allclose(scaled.leader[:, :, 1], 1.1 * duet.leader[:, :, 1], rtol=1e-5)
    assert scaled.reactor is duet.reactor
