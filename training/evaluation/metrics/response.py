"""How much a generated dance changes when a condition does, how different seeds are, and whether motion follows the
beat of the music.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from training.evaluation.metrics.beats import motion_beats, music_beats


def relative_change(leader: np.ndarray, base: np.ndarray, changed: np.ndarray) -> float:
    """RMS difference of two reactors beside the same leader over the RMS movement of the first; all (T, 22,
    3).

    Movement is the difference from its mean over time, relative to the leader's root. 0: the condition has no
    effect; two unrelated dances have about 1.4.
    """
    first = base - leader[:, :1]
    difference = changed - base
    movement = first - first.mean(axis=0)
    return float(np.sqrt((difference**2).sum() / (movement**2).sum()))


def between_seeds(motions: Sequence[np.ndarray]) -> dict[str, float]:
    """How different several reactors (T, 22, 3) to one leader are: mean over pairs, of poses relative to
    the root (pose_mm) and of roots (place_mm).

    Raises ValueError for fewer than two motions.
    """
    pose, place = [], []
    for i, first in enumerate(motions):
        for second in motions[i + 1 :]:
            gap = (first - first[:, :1]) - (second - second[:, :1])
            pose.append(np.linalg.norm(gap, axis=-1).mean())
            place.append(np.linalg.norm(first[:, 0] - second[:, 0], axis=-1).mean())
    if not pose:
        raise ValueError("differences between seeds need at least two motions")
    return {"pose_mm": float(np.mean(pose) * 1000), "place_mm": float(np.mean(place) * 1000)}


def half_beat_later(music: np.ndarray) -> np.ndarray:
    """Music features (T, 54), half the median beat later; the frames beyond the end come first.

    Raises ValueError with fewer than two beats.
    """
    beats = music_beats(music)
    if len(beats) < 2:
        raise ValueError("music with fewer than two beats cannot be shifted by half a beat")
    return np.roll(music, round(np.median(np.diff(beats)) / 2), axis=0)


def beat_phase(music: np.ndarray, motion: np.ndarray) -> complex:
    """Where in the beat the motion beats fall: mean of exp(2 pi i phase), phase 0 on a beat and 0.5 between
    two.

    Its absolute value says how steadily they fall there (1 always, 0 anywhere). Motion beats before the first and
    after the last music beat are left out.
    """
    beats, minima = music_beats(music), motion_beats(motion)
    minima = minima[(minima >= beats[0]) & (minima < beats[-1])] if len(beats) > 1 else minima[:0]
    if len(minima) == 0:
        return 0j
    before = np.searchsorted(beats, minima, side="right") - 1
    phase = (minima - beats[before]) / (beats[before + 1] - beats[before])
    return complex(np.exp(2j * np.pi * phase).mean())


def shift_test(
    base: Sequence[complex], shifted: Sequence[complex], resamples: int = 10000
) -> dict[str, float]:
    """Do motion beats follow the music when it moves by half a beat? Paired permutation test over seeds.

    base, shifted: `beat_phase` of each seed against the unshifted music. Where motion follows the music, the
    phase moves by half a beat and base - shifted is large in one direction; where the music has no effect, the
    two of a pair can be exchanged. p is the share of exchanges with a mean difference at least as large;
    `following` is minus the cosine between the mean phases: 1 follows, -1 stays. Raises ValueError without
    pairs.
    """
    first, second = np.array(base), np.array(shifted)
    if len(first) != len(second) or len(first) == 0:
        raise ValueError("the shift test needs pairs of phases")
    difference = first - second
    observed = abs(difference.mean())
    signs = np.random.default_rng(0).choice([-1.0, 1.0], size=(resamples, len(difference)))
    chance = np.abs((signs * difference).mean(axis=1))
    p = (1 + (chance >= observed - 1e-12).sum()) / (1 + resamples)
    mean_a, mean_b = first.mean(), second.mean()
    size = abs(mean_a) * abs(mean_b)
    following = -float((mean_a * mean_b.conjugate()).real / size) if size > 0 else 0.0
    return {"p": float(p), "difference": float(observed), "following": following}
