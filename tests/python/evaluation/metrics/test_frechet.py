"""Frechet distances and diversity in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from training.evaluation.metrics.frechet import clips, div, diversity, fid, fid_of_others, frechet, normalise


def gaussian(mean: np.ndarray, std: np.ndarray, seed: int, count: int = 500) -> np.ndarray:
    """Samples whose mean and covariance (ddof 1) are exactly mean and diag(std^2)."""
    raw = np.random.default_rng(seed).normal(size=(count, len(mean)))
    raw -= raw.mean(axis=0)
    white = raw @ np.linalg.inv(np.linalg.cholesky(np.cov(raw.T))).T
    return white * std + mean


@pytest.mark.parametrize("mode", ["paper", "corrected"])
def test_frechet_of_two_gaussians(mode):
    mean_a, mean_b = np.array([0.0, 1.0, 2.0]), np.array([3.0, 1.0, -2.0])
    std_a, std_b = np.array([1.0, 2.0, 0.5]), np.array([2.0, 2.0, 1.5])
    a, b = gaussian(mean_a, std_a, 1), gaussian(mean_b, std_b, 2)
    expected = ((mean_a - mean_b) ** 2).sum() + ((std_a - std_b) ** 2).sum()
    assert frechet(a, b, mode) == pytest.approx(expected)
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    assert frechet(a @ turn, b @ turn, mode) == pytest.approx(expected)


def test_frechet_of_fewer_samples_than_dimensions():
    """Where the covariances are singular the corrected root stays exact: orthogonal subspaces share
    nothing.
    """
    random = np.random.default_rng(4)
    a, b = np.zeros((6, 20)), np.zeros((6, 20))
    a[:, :5], b[:, 10:15] = random.normal(size=(2, 6, 5))
    means = ((a.mean(axis=0) - b.mean(axis=0)) ** 2).sum()
    expected = means + a.var(axis=0, ddof=1).sum() + b.var(axis=0, ddof=1).sum()
    assert frechet(a, b) == pytest.approx(expected)
    assert frechet(a, a) == pytest.approx(0.0, abs=1e-9)
    assert frechet(a, a + 0.5) == pytest.approx(20 * 0.25)
    with pytest.raises(ValueError, match="at least two"):
        frechet(a[:1], b)


def test_normalisation_is_the_truths():
    truth, other = gaussian(np.array([5.0, -2.0]), np.array([3.0, 0.1]), 5), np.array([[8.0, -1.9]])
    first, second = normalise(truth, other)
    assert first.mean(axis=0) == pytest.approx([0.0, 0.0], abs=1e-9)
    assert first.std(axis=0) == pytest.approx([1.0, 1.0])
    assert second[0] == pytest.approx(np.array([1.0, 1.0]) * np.sqrt(500 / 499))


def test_a_feature_that_the_truth_never_shows_has_no_scale():
    truth = np.random.default_rng(1).normal(size=(30, 3))
    truth[:, 1] = 0.0
    other = truth.copy()
    other[0, 1] = 0.01
    assert fid(truth, other, "corrected", resamples=0).value == pytest.approx(0.0, abs=1e-9)
    assert fid(truth, other, "paper", resamples=0).value > 1e10
    assert [len(part[0]) for part in (normalise(truth)[0], normalise(truth, mode="paper")[0])] == [2, 3]


def test_diversity_of_a_triangle():
    corners = np.array([[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]])
    assert diversity(corners) == pytest.approx((3 + 4 + 5) / 3)
    scaled = div(corners, corners)
    assert scaled.value == pytest.approx(diversity(normalise(corners)[0]))
    assert scaled.low <= scaled.value <= scaled.high
    many = np.random.default_rng(2).normal(size=(40, 3))
    interval = div(many, many)
    assert interval.low < interval.value < interval.high


def test_fid_and_its_interval():
    random = np.random.default_rng(6)
    truth = random.normal(size=(60, 4))
    near, far = truth + random.normal(scale=0.1, size=(60, 4)), truth + 2.0
    close, away = fid(truth, near), fid(truth, far)
    assert close.value < 0.1
    assert away.value == pytest.approx(16.0 / 1.0, rel=0.3)
    assert close.high < away.low
    assert away.low <= away.value <= away.high


def test_clips_have_equal_length():
    pieces = clips(np.arange(10), 4, 3)
    assert [list(piece) for piece in pieces] == [[0, 1, 2, 3], [3, 4, 5, 6], [6, 7, 8, 9]]


def test_the_same_clips_are_drawn_together():
    """So a set against itself has no distance in any draw, while one against other clips of its kind has."""
    truth, other = (np.random.default_rng(seed).normal(size=(40, 3)) for seed in (8, 9))
    assert fid(truth, truth).high == pytest.approx(0.0, abs=1e-9)
    assert fid(truth, other).low > 0.01


def test_fid_of_others_is_that_of_as_many_clips_drawn_without_repeats():
    random = np.random.default_rng(10)
    truth, others = random.normal(size=(30, 3)), random.normal(size=(120, 3))
    spread = fid_of_others(truth, others)
    # By more than the rounding of another order.
    assert spread.low + 0.01 < spread.value < spread.high - 0.01
    assert spread.low > 0 and spread.high < fid_of_others(truth, others + 2.0).low
    # As many as there are: every draw is all of them, in whatever order.
    same = fid_of_others(truth, truth)
    assert (same.low, same.high) == pytest.approx((0.0, 0.0), abs=1e-9)
    few = fid_of_others(truth, others[:20])
    assert few.low == pytest.approx(few.high) and few.value == pytest.approx(fid(truth, others[:20]).value)
