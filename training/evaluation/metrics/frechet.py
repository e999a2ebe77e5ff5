"""Frechet distance of two sets of feature vectors (FID, Heusel et al. 2017) and diversity within one (Div), with
bootstrap intervals, as in the paper's tables.

Both sets are first normalised by the truth's mean and standard deviation. A whole test set makes few
vectors; clips of equal length make more (`clips`). The covariance of fewer clips than features is singular,
and a FID of few clips is biased upwards, so compare only values from the same number of clips and read them
with their interval.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgWarning, sqrtm

from training.evaluation.metrics.modes import Mode


@dataclass(frozen=True)
class Interval:
    """A value with the limits between which 95 % of the bootstrap resamples fall."""

    value: float
    low: float
    high: float


def clips(motion: np.ndarray, length: int, hop: int) -> list[np.ndarray]:
    """All stretches of `length` frames that start every `hop` frames and lie wholly inside the motion."""
    return [motion[i : i + length] for i in range(0, len(motion) - length + 1, hop)]


def normalise(truth: np.ndarray, *others: np.ndarray, mode: Mode = "corrected") -> list[np.ndarray]:
    """The truth's features (N, D), then every other set, minus the truth's mean, over its std (ddof 0) +
    1e-10.

    A feature that is the same in all true clips has no scale. `paper` mode divides it by 1e-10, so that the FID is
    about 1e17 if it differs in one generated clip; `corrected` mode leaves it out.
    """
    mean, std = truth.mean(axis=0), truth.std(axis=0)
    varies = std > 1e-9 if mode == "corrected" else np.ones(len(std), dtype=bool)
    return [((features - mean) / (std + 1e-10))[:, varies] for features in (truth, *others)]


def frechet(a: np.ndarray, b: np.ndarray, mode: Mode = "corrected") -> float:
    """Frechet distance between Gaussians fitted to (N, D) and (M, D), covariances with ddof 1.

    |mu_a - mu_b|^2 + tr(Sa + Sb - 2 sqrtm(Sa Sb)) (Dowson and Landau 1982). `paper` mode takes the matrix root
    of the product, which rounding can make negative in sum when the covariances are singular. `corrected` mode
    uses that the root's trace is the nuclear norm of A B^T for centred data Sa = A^T A: exact at any rank, and
    never negative. Raises ValueError with fewer than two vectors in a set.
    """
    if min(len(a), len(b)) < 2:
        raise ValueError("a Frechet distance needs at least two vectors in each set")
    left = (a - a.mean(axis=0)) / np.sqrt(len(a) - 1)
    right = (b - b.mean(axis=0)) / np.sqrt(len(b) - 1)
    means = ((a.mean(axis=0) - b.mean(axis=0)) ** 2).sum()
    traces = (left**2).sum() + (right**2).sum()
    if mode == "corrected":
        root = np.linalg.svd(left @ right.T, compute_uv=False).sum()
        return float(max(means + traces - 2 * root, 0.0))
    first, second = left.T @ left, right.T @ right
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", LinAlgWarning)  # singular, as said above
        product = np.asarray(sqrtm(first @ second))
    if not np.isfinite(product).all():
        nudge = np.eye(len(first)) * 1e-5
        product = np.asarray(sqrtm((first + nudge) @ (second + nudge)))
    return float(means + traces - 2 * np.trace(product).real)


def diversity(features: np.ndarray) -> float:
    """Mean L2 distance over all pairs of different rows of (N, D). Raises ValueError with fewer than two rows."""
    count = len(features)
    if count < 2:
        raise ValueError("diversity needs at least two vectors")
    return float(_distances(features)[np.triu_indices(count, 1)].mean())


def _distances(features: np.ndarray) -> np.ndarray:
    """L2 distances (N, N) between the rows of (N, D)."""
    square = (features**2).sum(axis=1)
    return np.sqrt(np.maximum(square[:, None] + square[None] - 2 * features @ features.T, 0.0))


def fid(truth: np.ndarray, generated: np.ndarray, mode: Mode = "corrected", resamples: int = 200) -> Interval:
    """FID of generated (M, D) against true features (N, D), with a bootstrap over the clips of both.

    Rows of the two sets at the same index are the same stretch of dance when M = N and are then drawn
    together. Drawing with replacement repeats clips and so lowers the rank: the interval tells the spread,
    and lies above the value.
    """
    first, second = normalise(truth, generated, mode=mode)
    value = frechet(first, second, mode)
    random = np.random.default_rng(0)
    draws = []
    for _ in range(resamples):
        rows = random.integers(len(first), size=len(first))
        other = rows if len(first) == len(second) else random.integers(len(second), size=len(second))
        draws.append(frechet(first[rows], second[other], "corrected"))
    low, high = np.percentile(draws, [2.5, 97.5]) if draws else (value, value)
    return Interval(value, float(low), float(high))


def fid_of_others(truth: np.ndarray, others: np.ndarray) -> Interval:
    """FID between features (N, D) of true clips and as many of other true dances, drawn from (M, D): the median over
    100 draws, and the limits of 95 % of them. What a perfect copy has is 0, what other dances of the same dancers
    have is this.
    """
    first, second = normalise(truth, others)
    random = np.random.default_rng(0)
    count = min(len(first), len(second))
    values = [frechet(first, second[random.choice(len(second), count, replace=False)]) for _ in range(100)]
    low, middle, high = np.percentile(values, [2.5, 50, 97.5])
    return Interval(float(middle), float(low), float(high))


def div(truth: np.ndarray, generated: np.ndarray, mode: Mode = "corrected", resamples: int = 200) -> Interval:
    """Diversity of generated (M, D) in the truth's normalisation, with a bootstrap over clips.

    Pairs of one clip with itself, which a resample has by chance, are left out of it.
    """
    features = normalise(truth, generated, mode=mode)[1]
    distances = _distances(features)
    random = np.random.default_rng(0)
    draws = []
    for _ in range(resamples):
        rows = random.integers(len(features), size=len(features))
        different = rows[:, None] != rows[None]
        draws.append(distances[np.ix_(rows, rows)][different].mean() if different.any() else 0.0)
    value = diversity(features)
    low, high = np.percentile(draws, [2.5, 97.5]) if draws else (value, value)
    return Interval(value, float(low), float(high))
