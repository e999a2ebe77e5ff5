"""Boundary jitter of motions that jump where they were made to."""

from __future__ import annotations

import numpy as np
import pytest

from training.evaluation.metrics.seams import (
    boundaries,
    paper_jitter,
    seam_ratio,
    seam_sample,
    velocity_change,
)


def smooth(frames: int, seed: int = 0) -> np.ndarray:
    phase = np.random.default_rng(seed).uniform(0, 2 * np.pi, (1, 22, 3))
    return 0.1 * np.sin(2 * np.pi * np.arange(frames)[:, None, None] / 30 + phase)


def test_velocity_change_of_a_parabola():
    motion = np.arange(20.0)[:, None, None] ** 2 * np.array([0.003, 0.0, 0.004]) / 2 * np.ones((1, 22, 1))
    change = velocity_change(motion)
    assert np.isnan(change[[0, -1]]).all()
    assert change[1:-1] == pytest.approx(np.full(18, 5.0))


def test_a_jump_at_the_boundary_is_a_seam_and_between_two_it_is_not():
    truth = smooth(1000)
    seams = boundaries(1000, 240)
    assert list(seams) == [240, 480, 720, 960]
    assert list(boundaries(500, 120)) == [120, 240, 360, 480]
    same = seam_ratio([seam_sample(truth, truth, seams)])
    assert same == pytest.approx({"seams": 4, "ratio": 1.0, "own": 1.0})
    jump = truth.copy()
    jump[240:, :, 1] += 0.05  # between frames 239 and 240
    assert seam_ratio([seam_sample(truth, jump, seams)])["ratio"] > 2
    between = truth.copy()
    # Changes frames 242 and 243; the window of the seam at 240 ends with frame 241.
    between[243:, :, 1] += 0.05
    assert seam_ratio([seam_sample(truth, between, seams)])["ratio"] == pytest.approx(1.0)


def test_seams_of_many_motions_add_up_by_frames():
    truth = smooth(500)
    still = np.zeros_like(truth)
    samples = [
        seam_sample(truth, truth, boundaries(500, 240)),
        seam_sample(truth, still, boundaries(500, 240)),
    ]
    result = seam_ratio(samples)
    assert result["seams"] == 4
    assert result["ratio"] == pytest.approx(0.5)
    assert result["own"] == pytest.approx(1.0)
    slow = seam_ratio([seam_sample(truth, 0.5 * truth, boundaries(500, 240))])
    assert (slow["ratio"], slow["own"]) == pytest.approx((0.5, 1.0))


def test_paper_jitter_sees_thirty_frames():
    motion = np.zeros((600, 22, 3))
    motion[271:, :, 0] = 0.06  # changes frames 270 and 271, 30.5 frames and more from a boundary at 240
    assert paper_jitter(motion, np.array([240])) == 0.0
    motion[270, :, 0] = 0.06  # changes frames 269 and 270: of the 60 frames 210..269, one changes by 60 mm
    assert paper_jitter(motion, np.array([240])) == pytest.approx(60 / 60)


def test_the_interior_is_eight_frames_away_from_the_seams():
    sample = seam_sample(smooth(500), smooth(500), boundaries(500, 240))
    assert sample.frames == 2 * 4
    assert sample.inside_frames == 498 - 2 * 16
