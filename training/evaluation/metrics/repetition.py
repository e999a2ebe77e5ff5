"""Whether a long dance repeats itself: windows whose movement comes again at another time of the same dance.

All dances repeat, so the share has to be compared with that of the true dance of the same length.
"""

from __future__ import annotations

import numpy as np

from training.motion.heading import heading, turn_in
from training.motion.skeleton import JOINTS

WINDOW_FRAMES, HOP_FRAMES = 60, 10  # windows of 2 s, one every third of a second
MIN_GAP_FRAMES = 120  # least distance between the starts of two windows that are compared
MIN_FRAMES = WINDOW_FRAMES + MIN_GAP_FRAMES + 1  # of a dance with two windows to compare
# A window nearer than this to another one is a near-duplicate; in the true salsa no two are nearer than about 65.
DUPLICATE_MM = 60.0


def own_poses(motion: np.ndarray) -> np.ndarray:
    """Bodies of (T, 22, 3) seen from their own root and heading, (T, 66) metres."""
    body = (motion - motion[:, :1]).astype(np.float64)
    return turn_in(body, heading(motion).astype(np.float64)).reshape(len(motion), -1)


def nearest_repeats(motion: np.ndarray) -> np.ndarray:
    """For every window of a motion (T, 22, 3) its distance to the most similar other window, (K,) mm: root mean
    square over frames and joints; the other starts at least 4 s earlier or later, at any frame.

    Raises ValueError for a motion shorter than `MIN_FRAMES`.
    """
    poses = own_poses(motion)
    starts = len(poses) - WINDOW_FRAMES + 1
    if len(poses) < MIN_FRAMES:
        raise ValueError(f"repetition needs at least {MIN_FRAMES} frames, got {len(poses)}")
    square = (poses**2).sum(axis=1)
    gap = square[:, None] + square - 2 * poses @ poses.T
    result = []
    for i in range(0, starts, HOP_FRAMES):
        # Mean along the diagonals of the strip of rows of this window: window i against every window j.
        rows = gap[i : i + WINDOW_FRAMES]
        distance = (
            sum((rows[k, k : k + starts] for k in range(WINDOW_FRAMES)), np.zeros(starts)) / WINDOW_FRAMES
        )
        distance[max(i - MIN_GAP_FRAMES + 1, 0) : i + MIN_GAP_FRAMES] = np.inf
        if np.isfinite(distance).any():
            result.append(np.sqrt(max(float(distance.min()), 0.0) / len(JOINTS)) * 1000)
    return np.array(result)


def repetition(motion: np.ndarray) -> dict[str, float]:
    """repeat_share: share of windows with a near-duplicate at least 4 s away; repeat_mm: median distance to the
    nearest.
    """
    nearest = nearest_repeats(motion)
    return {"repeat_share": float((nearest < DUPLICATE_MM).mean()), "repeat_mm": float(np.median(nearest))}
