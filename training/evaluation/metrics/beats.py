"""Beats of a motion, and how well they align with the music's (beat align score, BAS, as in Bailando, Siyao et al.
2022: the music's beats are the reference; Li et al. 2021 take the motion's) or with the partner's (beat echo degree,
BED, Duolando, Siyao et al. 2024), as the paper's tables take them.

A motion beat is a local minimum of speed. Both scores are the mean over reference beats of
exp(-d^2 / (2 * 3^2)), d the frames to the nearest motion beat. More motion beats raise a score, so the number
of beats and the chance level, the mean score over all circular shifts of the motion beats, belong beside it.
"""

from __future__ import annotations

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.signal import argrelmin

from training.music.recipe import MUSIC_FEATURES

SMOOTHING = 5.0  # frames, standard deviation of the filter on the speed
TOLERANCE = 3.0  # frames, standard deviation of the score
BEAT_COLUMN = MUSIC_FEATURES - 1  # 1 at a beat


def motion_beats(motion: np.ndarray) -> np.ndarray:
    """Frames at which the smoothed mean joint speed of (T, J, 3) has a strict local minimum, (K,) int."""
    speed = np.linalg.norm(np.diff(motion.astype(np.float64), axis=0), axis=-1).mean(axis=-1)
    return argrelmin(gaussian_filter1d(speed, SMOOTHING))[0]


def music_beats(features: np.ndarray) -> np.ndarray:
    """Frames of the beats in music features (T, 54), (K,) int."""
    return np.flatnonzero(features[:, BEAT_COLUMN] > 0.5)


def beat_scores(reference: np.ndarray, beats: np.ndarray) -> np.ndarray:
    """Score of every reference beat (K,) against the frames of beats (M,), (K,) in [0, 1]; zeros without any beat."""
    if len(beats) == 0:
        return np.zeros(len(reference))
    distance = np.abs(reference[:, None] - beats[None]).min(axis=1)
    return np.exp(-(distance**2) / (2 * TOLERANCE**2))


def beat_alignment(reference: np.ndarray, beats: np.ndarray) -> float:
    """Mean of `beat_scores`: BAS with music beats as reference, BED with the leader's; NaN without a reference beat."""
    return float(beat_scores(reference, beats).mean()) if len(reference) else float("nan")


def chance_alignment(reference: np.ndarray, beats: np.ndarray, frames: int) -> float:
    """Mean of `beat_alignment` over all circular shifts of the beats within a clip of `frames`."""
    if len(reference) == 0 or len(beats) == 0:
        return beat_alignment(reference, beats)
    shifts = [beat_alignment(reference, (beats + shift) % frames) for shift in range(1, frames)]
    return float(np.mean(shifts))


def bed(leader: np.ndarray, reactor: np.ndarray) -> dict[str, float]:
    """Beat echo degree of two motions (T, J, 3): forward (the leader's beats are the reference), backward (the
    reactor's), the chance level of both, and the number of beats of either.
    """
    first, second = motion_beats(leader), motion_beats(reactor)
    frames = len(leader)
    return {
        "forward": beat_alignment(first, second),
        "backward": beat_alignment(second, first),
        "forward_chance": chance_alignment(first, second, frames),
        "backward_chance": chance_alignment(second, first, frames),
        "leader_beats": float(len(first)),
        "reactor_beats": float(len(second)),
    }


def bas(music: np.ndarray, reactor: np.ndarray) -> dict[str, float]:
    """Beat alignment score of a reactor (T, J, 3) to music beats (K,) frames: value, chance level, and the limits
    low and high of the 95 % bootstrap interval over the beats. All NaN without a music beat.
    """
    beats = motion_beats(reactor)
    scores = beat_scores(music, beats)
    if len(scores) == 0:
        return {"value": float("nan"), "chance": float("nan"), "low": float("nan"), "high": float("nan")}
    resamples = np.random.default_rng(0).integers(len(scores), size=(1000, len(scores)))
    means = scores[resamples].mean(axis=1)
    low, high = np.percentile(means, [2.5, 97.5])
    chance = chance_alignment(music, beats, len(reactor))
    return {"value": float(scores.mean()), "chance": chance, "low": float(low), "high": float(high)}
