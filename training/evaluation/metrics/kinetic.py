"""Kinetic features of one dancer (FID_k): how much each joint moves, horizontally, vertically and in
acceleration.

After Onuma et al. 2008 (FMDistance: a fast and effective distance function for motion capture data) as used by the
AIST++, Duolando and ReactDance evaluations; rewritten from fairmotion (THIRD_PARTY.md has its licence).
"""

from __future__ import annotations

import numpy as np

from training.config import FPS
from training.evaluation.metrics.modes import Mode, feature_pose

RADIUS_FRAMES = 2  # on each side, over which velocities and accelerations are averaged


def _window_mean(values: np.ndarray, frames: int) -> np.ndarray:
    """Mean over i-2..i+2 of values that exist at frames 1..len, for i = 1..frames-1."""
    total = np.concatenate([np.zeros_like(values[:1]), np.cumsum(values, axis=0)])
    i = np.arange(1, frames)
    low = np.clip(i - RADIUS_FRAMES - 1, 0, len(values))
    high = np.clip(i + RADIUS_FRAMES, 0, len(values))
    count = np.maximum(high - low, 1)
    return (total[high] - total[low]) / count[:, None, None]


def kinetic_features(motion: np.ndarray, mode: Mode) -> np.ndarray:
    """(T, 22, 3) metres, at least 4 frames, to (72,): 24 joints x (horizontal energy, vertical energy,
    acceleration).

    With D the time of a frame and window means over the terms that exist:
    horizontal: mean_i ||mean_k v[i+k]_xz||^2, vertical: the same of y, acceleration: mean_i ||mean_k (v2 -
    v1) / D||. In `paper` mode D = 1/60 and v1 = p[i+k] - p[i+k-1] / D, the published slip, which makes the
    last term measure mostly the distance from the start. In `corrected` mode D = 1/30 and v1 is the
    velocity.
    """
    pose = feature_pose(motion, mode)
    frames = len(pose)
    if frames < 4:
        raise ValueError(f"kinetic features need at least 4 frames, got {frames}")
    time = 1 / 60 if mode == "paper" else 1 / FPS
    velocity = np.diff(pose, axis=0) / time  # at frames 1..T-1
    mean_velocity = _window_mean(velocity, frames)
    horizontal = (mean_velocity[..., [0, 2]] ** 2).sum(axis=-1).mean(axis=0)
    vertical = (mean_velocity[..., 1] ** 2).mean(axis=0)
    before = pose[1:-1] - pose[:-2] / time if mode == "paper" else velocity[:-1]
    acceleration = _window_mean((velocity[1:] - before) / time, frames)  # at frames 1..T-2
    expenditure = np.linalg.norm(acceleration, axis=-1).mean(axis=0)
    return np.stack([horizontal, vertical, expenditure], axis=-1).reshape(-1)
