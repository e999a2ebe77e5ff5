"""The two ways the benchmark's features can be computed, and the pose they are computed from.

`paper` repeats the published evaluation code with its errors: it hard-codes y as up while its data is z-up, and
takes a frame to last 1/60 s (kinetic) or 1/120 s (geometric) although there are 30 in a second. `corrected`
has the real up axis and the real frame rate. Numbers of the two are never comparable, so every table names
its mode.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

Mode = Literal["paper", "corrected"]
MODES: tuple[Mode, ...] = ("paper", "corrected")


def z_up(motion: np.ndarray) -> np.ndarray:
    """(..., 3) with y up, turned to have z up (a quarter turn about x, handedness kept)."""
    return np.stack([motion[..., 0], -motion[..., 2], motion[..., 1]], axis=-1)


def feature_pose(motion: np.ndarray, mode: Mode) -> np.ndarray:
    """What the kinetic and geometric features see of a (T, 22, 3) motion in metres, y up: (T, 24, 3).

    Joints 22 and 23 stand for the hands. This body has none, so they repeat the wrists. The root of frame 0
    is subtracted from all frames; `paper` mode has the axes of the benchmark's z-up world.
    Raises ValueError for another shape.
    """
    if motion.shape[1:] != (22, 3):
        raise ValueError(f"expected a motion of shape (frames, 22, 3), got {motion.shape}")
    pose = np.concatenate([motion, motion[:, 20:22]], axis=1).astype(np.float64)
    pose -= pose[:1, :1]
    return z_up(pose) if mode == "paper" else pose
