"""The direction a body faces, and vectors as that body sees them."""

from __future__ import annotations

import numpy as np
import torch

from training.motion.leader_frame import into_frame, out_of_frame
from training.motion.skeleton import JOINTS

_HIPS = (JOINTS.index("left_hip"), JOINTS.index("right_hip"))
_SHOULDERS = (JOINTS.index("left_shoulder"), JOINTS.index("right_shoulder"))


def heading(motion: np.ndarray) -> np.ndarray:
    """Horizontal unit vector (T, 2) in (x, z) that the body faces, from the lines of hips and shoulders.

    With y up and right-handed axes, right to left crossed with up points forward.
    """
    across = (motion[:, _HIPS[0]] - motion[:, _HIPS[1]]) + (
        motion[:, _SHOULDERS[0]] - motion[:, _SHOULDERS[1]]
    )
    forward = np.stack([-across[:, 2], across[:, 0]], axis=-1)  # (x, z) of across x up
    return forward / np.maximum(np.linalg.norm(forward, axis=-1, keepdims=True), 1e-9)


def turn_in(vectors: np.ndarray, heading: np.ndarray) -> np.ndarray:
    """World vectors (T, N, 3) as seen from a body that faces heading (T, 2): +z is forward, +x its left."""
    return into_frame(torch.from_numpy(vectors), torch.from_numpy(heading)).numpy()


def turn_out(vectors: np.ndarray, heading: np.ndarray) -> np.ndarray:
    """Inverse of `turn_in`."""
    return out_of_frame(torch.from_numpy(vectors), torch.from_numpy(heading)).numpy()
