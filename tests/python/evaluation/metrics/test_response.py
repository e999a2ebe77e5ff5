"""Responses to conditions, of motions that change by known amounts."""

from __future__ import annotations

import numpy as np
import pytest

from tests.python.support.bodies import swinging_body
from training.evaluation.metrics.response import (
    beat_phase,
    between_seeds,
    half_beat_later,
    relative_change,
    shift_test,
)


def music_with(beats: np.ndarray, frames: int) -> np.ndarray:
    features = np.zeros((frames, 54))
    features[beats, 53] = 1.0
    features[:, 0] = np.arange(frames)
    return features


def slowing_at(phase: float, frames: int, period: int) -> np.ndarray:
    """A body whose speed is least `phase` of a period after every multiple of the period."""
    speed = 1.0 - np.cos(2 * np.pi * (np.arange(frames - 1) / period - phase))
    path = np.concatenate([[0.0], np.cumsum(speed)])
    return path[:, None, None] * np.ones((1, 22, 1)) * np.array([0.01, 0.0, 0.0])


def test_relative_change():
    leader, base = np.zeros((600, 22, 3)), swinging_body(600, 1)
    assert relative_change(leader, base, base) == 0.0
    movement = np.sqrt(((base - base.mean(axis=0)) ** 2).sum(axis=(1, 2)).mean())
    moved = base + np.array([0.05, 0.0, 0.0])
    assert relative_change(leader, base, moved) == pytest.approx(0.05 * np.sqrt(22) / movement)
    mean = base.mean(axis=0)
    other = 2 * mean - np.roll(base, 10, axis=0)  # a quarter period: as far as an unrelated dance
    assert relative_change(leader, base, 2 * mean - other) == pytest.approx(np.sqrt(2), rel=1e-3)
    # A couple that walks together does not count the way as movement.
    walk = np.linspace(0, 5, 600)[:, None, None] * np.array([1.0, 0.0, 0.0])
    assert relative_change(leader + walk, base + walk, moved + walk) == pytest.approx(
        relative_change(leader, base, moved)
    )


def test_seeds_apart():
    base = swinging_body(50, 2)
    place = base + np.array([0.03, 0.0, 0.04])
    pose = base.copy()
    pose[:, 3] += np.array([0.022, 0.0, 0.0])
    result = between_seeds([base, place, pose])
    assert result["place_mm"] == pytest.approx((50 + 0 + 50) / 3)
    assert result["pose_mm"] == pytest.approx((0 + 1 + 1) / 3)
    with pytest.raises(ValueError, match="two motions"):
        between_seeds([base])


def test_half_a_beat_later():
    music = music_with(np.arange(5, 300, 20), 300)
    later = half_beat_later(music)
    assert list(np.flatnonzero(later[:, 53])) == list(range(15, 300, 20))
    assert later[10:, 0] == pytest.approx(music[:-10, 0])
    with pytest.raises(ValueError, match="two beats"):
        half_beat_later(music_with(np.array([4]), 100))


@pytest.mark.parametrize("phase", [0.0, 0.25, 0.5])
def test_beat_phase(phase: float):
    music = music_with(np.arange(0, 1200, 40), 1200)
    measured = beat_phase(music, slowing_at(phase, 1200, 40))
    assert measured == pytest.approx(np.exp(2j * np.pi * phase), abs=0.02)
    assert beat_phase(music_with(np.array([3]), 1200), slowing_at(phase, 1200, 40)) == 0j


def test_motion_that_follows_the_beat_is_told_from_motion_that_does_not():
    random = np.random.default_rng(5)
    noise = random.normal(scale=0.3, size=(4, 16))
    base = 0.5 * np.exp(0.4j) + noise[0] + 1j * noise[1]
    following = shift_test(base, -0.5 * np.exp(0.4j) + noise[2] + 1j * noise[3])
    assert following["p"] < 0.01
    assert following["following"] > 0.8
    unchanging = shift_test(base, 0.5 * np.exp(0.4j) + noise[2] + 1j * noise[3])
    assert unchanging["p"] > 0.05
    assert unchanging["following"] < -0.8
    known = shift_test([1 + 0j, 1j], [-1 + 0j, -1 + 0j])
    assert [known["following"], known["difference"]] == pytest.approx([0.5**0.5, 2.5**0.5])
    # Few seeds cannot be significant: 2 of the 2^3 exchanges are as extreme as what was seen.
    assert shift_test([1 + 0j] * 3, [-1 + 0j] * 3)["p"] == pytest.approx(0.25, abs=0.02)
    with pytest.raises(ValueError, match="pairs"):
        shift_test([], [])


def test_motion_before_the_first_and_after_the_last_beat_is_not_heard():
    beats, motion = np.arange(400, 801, 40), slowing_at(0.25, 1200, 40)
    assert beat_phase(music_with(beats, 1200), motion) == pytest.approx(1j, abs=0.02)
    late = motion.copy()
    late[:380] = slowing_at(0.75, 380, 40)  # elsewhere in the beat before the music begins
    late[380:] += late[379] - late[380]
    assert beat_phase(music_with(beats, 1200), late) == pytest.approx(1j, abs=0.1)


def test_no_p_value_is_below_what_so_many_exchanges_can_show():
    sure = shift_test([1 + 0j] * 40, [-1 + 0j] * 40, resamples=99)
    assert sure["p"] == pytest.approx(1 / 100)
