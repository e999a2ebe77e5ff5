"""Responses to conditions, on dances that answer in a known way; and that a row has everything."""

from __future__ import annotations

import numpy as np
import pytest

from training.evaluation.metrics.duet import clip_count, duet_metrics, set_metrics
from training.evaluation.metrics.response import (
    beat_period,
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


def dancing(frames: int, seed: int) -> np.ndarray:
    random = np.random.default_rng(seed)
    phase = random.uniform(0, 2 * np.pi, (1, 22, 3))
    steps = 0.1 * np.sin(2 * np.pi * np.arange(frames)[:, None, None] / 40 + phase)
    return random.normal(scale=0.3, size=(1, 22, 3)) + np.array([0.0, 1.0, 0.0]) + steps


def test_relative_change():
    leader, base = np.zeros((600, 22, 3)), dancing(600, 1)
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
    base = dancing(50, 2)
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
    assert beat_period(music) == 20
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
    # Few seeds cannot be significant: 2 of the 2^3 exchanges are as extreme as what was seen.
    assert shift_test([1 + 0j] * 3, [-1 + 0j] * 3)["p"] == pytest.approx(0.25, abs=0.02)
    with pytest.raises(ValueError, match="pairs"):
        shift_test([], [])


def test_the_truth_measured_against_itself():
    leader, truth = dancing(400, 3), dancing(400, 4)
    row = duet_metrics(leader, truth, truth, music_with(np.arange(0, 400, 20), 400))
    zero = {k: v for k, v in row.items() if k.endswith(("error_mm", "_w1_m", "_w1_deg")) or "energy_db" in k}
    assert len(zero) == 8
    assert all(value == pytest.approx(0.0, abs=1e-9) for value in zero.values())
    ratios = {k: v for k, v in row.items() if k.endswith("_ratio")}
    assert len(ratios) == 4
    assert all(value == pytest.approx(1.0) for value in ratios.values())
    assert {"mpjpe_mm", "pfc", "ipr_capsules", "bas", "bas_chance", "skate_share", "bone_variation"} <= set(
        row
    )


def test_sets_of_clips():
    leader, truth = (
        dancing(600, 3),
        np.cumsum(np.random.default_rng(7).normal(scale=0.01, size=(600, 22, 3)), axis=0),
    )
    assert clip_count([truth, truth]) == 18
    same = set_metrics([(leader, truth)], [(leader, truth)], "corrected", resamples=5)
    assert set(same) == {"fid_k", "fid_g", "fid_cd", "div_k", "div_g", "div_cd"}
    for name in ("k", "g", "cd"):
        assert same[f"fid_{name}"].value == pytest.approx(0.0, abs=1e-6)
        assert same[f"div_{name}"].value > 0
    far = set_metrics([(leader, truth)], [(leader, 1.5 * truth)], "corrected", resamples=5)
    assert far["fid_k"].value > 0.1
    assert far["fid_cd"].value > 0.1
