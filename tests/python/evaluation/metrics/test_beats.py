"""Beat scores of motions whose beats were put where they are."""

from __future__ import annotations

import numpy as np
import pytest

from training.evaluation.metrics.beats import (
    bas,
    beat_alignment,
    beat_scores,
    bed,
    chance_alignment,
    motion_beats,
    music_beats,
)


def pulsing(frames: int, beats: np.ndarray, period: float = 60) -> np.ndarray:
    """A body that slows down at every one of the beats (equally spaced by `period`)."""
    speed = 1.0 - np.cos(2 * np.pi * (np.arange(frames - 1) - beats[0]) / period)
    path = np.concatenate([[0.0], np.cumsum(speed)])
    return path[:, None, None] * np.ones((1, 22, 1)) * np.array([0.01, 0.0, 0.0])


def test_motion_beats_are_the_minima_of_speed():
    beats = np.arange(30, 571, 60)
    assert list(motion_beats(pulsing(600, beats))) == list(beats)


def test_music_beats_are_column_53():
    features = np.ones((100, 54))
    features[:, 53] = 0.0
    features[[7, 40, 99], 53] = 1.0
    assert list(music_beats(features)) == [7, 40, 99]


@pytest.mark.parametrize("shift", [0, 1, 3, 6])
def test_bed_of_shifted_beats(shift: int):
    beats = np.arange(30, 571, 60)
    echo = bed(pulsing(600, beats), pulsing(600, beats + shift))
    expected = np.exp(-(shift**2) / 18)
    assert echo["forward"] == pytest.approx(expected)
    assert echo["backward"] == pytest.approx(expected)
    assert (echo["leader_beats"], echo["reactor_beats"]) == (len(beats), len(beats))


def test_forward_and_backward_differ_when_one_has_more_beats():
    sparse, dense = np.arange(60, 600, 120), np.arange(30, 600, 30)
    echo = bed(pulsing(600, sparse, 120), pulsing(600, dense, 30))
    assert echo["forward"] == pytest.approx(1.0)
    assert echo["backward"] < 0.4
    # Three standard deviations of the score's Gaussian, over the distance of two beats.
    assert echo["forward_chance"] == pytest.approx(3 * np.sqrt(2 * np.pi) / 30, rel=0.1)
    assert echo["backward_chance"] == pytest.approx(3 * np.sqrt(2 * np.pi) / 120, rel=0.3)
    assert echo["reactor_beats"] > 3 * echo["leader_beats"]


def test_chance_by_counting():
    """One reference and one beat: over all shifts the distance takes every value once."""
    reference, beats, frames = np.array([50]), np.array([100]), 200
    shifted = (100 + np.arange(1, frames)) % frames
    expected = np.exp(-((shifted - 50.0) ** 2) / 18).mean()
    assert chance_alignment(reference, beats, frames) == pytest.approx(expected)
    assert expected == pytest.approx(3 * np.sqrt(2 * np.pi) / 199, rel=1e-3)


def test_no_beats_score_nothing():
    assert list(beat_scores(np.array([3, 9]), np.array([], dtype=int))) == [0.0, 0.0]
    assert np.isnan(beat_alignment(np.array([], dtype=int), np.array([3])))


def test_bas_has_its_value_inside_its_interval():
    beats = np.arange(30, 571, 60)
    motion = pulsing(600, beats)
    exact = bas(beats, motion)
    assert exact["value"] == pytest.approx(1.0)
    assert (exact["low"], exact["high"]) == pytest.approx((1.0, 1.0))
    assert exact["chance"] < 0.2
    mixed = bas(beats + np.array([0, 3] * 5), motion)
    assert mixed["value"] == pytest.approx((1 + np.exp(-0.5)) / 2)
    # 95 % of the means of ten draws lie within two of their standard deviations.
    spread = 1.96 * (1 - np.exp(-0.5)) / 2 / np.sqrt(10)
    assert mixed["high"] - mixed["value"] == pytest.approx(spread, rel=0.2)
    assert mixed["value"] - mixed["low"] == pytest.approx(spread, rel=0.2)
    # Scores of ten values, so that the interval is not one of a few steps.
    varied = bas(beats + np.arange(10), motion)
    scores = np.exp(-(np.arange(10) ** 2) / 18)
    assert varied["high"] - varied["low"] == pytest.approx(2 * 1.96 * scores.std() / np.sqrt(10), rel=0.08)
    assert np.isnan(bas(np.array([], dtype=int), motion)["value"])
