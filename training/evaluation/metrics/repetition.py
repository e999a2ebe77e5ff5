"""Whether a long dance repeats itself: windows whose movement comes again at another time of the same dance.

Dance repeats by nature, so the share has to be compared with the truth's over the same length.
"""

from __future__ import annotations

import numpy as np

from training.motion.heading import heading, turn_in

WINDOW, HOP = 60, 10  # frames: 2 s of movement, looked at every third of a second
APART = 120  # frames between the starts of two windows that count as different moments
SHORTEST = WINDOW + APART + 1  # frames of a dance with at least two different moments
# Below it a window is a near-duplicate: no two moments of the true salsa are closer than about 65.
NEAR_MM = 60.0


def own_poses(motion: np.ndarray) -> np.ndarray:
    """Bodies of (T, 22, 3) seen from their own root and heading, (T, 66) metres."""
    body = (motion - motion[:, :1]).astype(np.float64)
    return turn_in(body, heading(motion).astype(np.float64)).reshape(len(motion), -1)


def nearest_repeats(motion: np.ndarray) -> np.ndarray:
    """For every window of a motion (T, 22, 3) its distance to the most similar other window, (K,) mm: root mean
    square over frames and joints; the other starts at least 4 s earlier or later, at any frame.

    Raises ValueError for a motion shorter than `SHORTEST`.
    """
    poses = own_poses(motion)
    starts = len(poses) - WINDOW + 1
    if len(poses) < SHORTEST:
        raise ValueError(f"repetition needs at least {SHORTEST} frames, got {len(poses)}")
    square = (poses**2).sum(axis=1)
    gap = square[:, None] + square - 2 * poses @ poses.T
    result = []
    for i in range(0, starts, HOP):
        # Mean along the diagonals of the strip of rows of this window: window i against every window j.
        rows = gap[i : i + WINDOW]
        distance = sum((rows[k, k : k + starts] for k in range(WINDOW)), np.zeros(starts)) / WINDOW
        distance[max(i - APART + 1, 0) : i + APART] = np.inf
        if np.isfinite(distance).any():
            result.append(np.sqrt(max(float(distance.min()), 0.0) / 22) * 1000)
    return np.array(result)


def repetition(motion: np.ndarray) -> dict[str, float]:
    """repeat_share: share of windows with a near-duplicate at least 4 s away; repeat_mm: median distance to the
    nearest.
    """
    nearest = nearest_repeats(motion)
    return {"repeat_share": float((nearest < NEAR_MM).mean()), "repeat_mm": float(np.median(nearest))}
