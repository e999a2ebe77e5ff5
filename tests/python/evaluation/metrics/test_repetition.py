"""Repetition of dances that were made to repeat."""

from __future__ import annotations

import numpy as np
import pytest

from training.data.made import made_dancer
from training.evaluation.metrics.repetition import (
    DUPLICATE_MM,
    MIN_GAP_FRAMES,
    WINDOW_FRAMES,
    nearest_repeats,
    own_poses,
    repetition,
)


def wandering(frames: int, seed: int = 0) -> np.ndarray:
    """A body that never comes back to a pose: it grows more crooked all the time."""
    random = np.random.default_rng(seed)
    drift = 0.004 * np.arange(frames)[:, None, None] * random.normal(size=(1, 22, 3))
    drift[:, [1, 2, 16, 17]] = 0.0
    return np.repeat(made_dancer(1, 0).astype(float), frames, axis=0) + drift


def moved(motion: np.ndarray, degrees: float) -> np.ndarray:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return motion @ np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]).T + np.array([2.0, 0.0, 1.0])


def test_poses_do_not_depend_on_the_room():
    motion = made_dancer(50, 1)
    assert own_poses(moved(motion, 77)) == pytest.approx(own_poses(motion), abs=1e-5)


def test_a_dance_that_never_returns_does_not_repeat():
    result = repetition(wandering(600))
    assert result["repeat_share"] == 0.0
    assert result["repeat_mm"] > DUPLICATE_MM
    # The nearest other window is the one that starts just far enough away; its distance is known.
    speed = np.sqrt(
        ((wandering(2)[1] - wandering(2)[0] - (wandering(2)[1, :1] - wandering(2)[0, :1])) ** 2).sum() / 22
    )
    assert result["repeat_mm"] == pytest.approx(MIN_GAP_FRAMES * speed * 1000, rel=0.05)


def test_a_phrase_danced_again_later_is_found():
    dance = wandering(900)
    dance[600:750] = moved(dance[100:250], 140)
    nearest = nearest_repeats(dance)
    again = {10 * k for k in np.flatnonzero(nearest < 1.0)}
    # Windows that lie wholly inside the phrase, here and there; starts come every 10 frames.
    inside = {s for first in (100, 600) for s in range(first, first + 150 - WINDOW_FRAMES + 1, 10)}
    assert again == inside
    assert repetition(dance)["repeat_share"] >= len(inside) / len(nearest)


def test_neighbouring_windows_are_not_repeats():
    """A body that stands still for 3 s, and only then, repeats nothing: all those windows are one moment."""
    dance = wandering(900)
    dance[300:390] = dance[300]
    assert (nearest_repeats(dance) > 1.0).all()
    with pytest.raises(ValueError, match="at least"):
        repetition(dance[: WINDOW_FRAMES + 50])


def test_a_phrase_that_comes_again_nearly_the_same_repeats_up_to_six_centimetres():
    for millimetres, found in ((50, True), (70, False)):
        dance = wandering(900)
        dance[600:750] = dance[100:250]
        # Joints that show no heading, and by how far the mean over all joints is the distance.
        dance[600:750, 15] += np.array([0.0, millimetres / 1000 * np.sqrt(22), 0.0])
        assert (repetition(dance)["repeat_share"] > 0) is found
