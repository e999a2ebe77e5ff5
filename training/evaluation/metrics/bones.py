"""Whether a body keeps its shape: variation of the bone lengths of raw joint positions."""

from __future__ import annotations

import numpy as np

from training.motion.skeleton import PARENTS


def bone_lengths(motion: np.ndarray) -> np.ndarray:
    """Lengths of the 21 bones of (T, 22, 3) in every frame, (T, 21) metres."""
    parents = list(PARENTS[1:])
    return np.linalg.norm(motion[:, 1:] - motion[:, parents], axis=-1)


def bone_variation(motion: np.ndarray) -> float:
    """Mean over bones of the standard deviation over time divided by the mean length; 0 is a rigid
    skeleton.
    """
    lengths = bone_lengths(motion.astype(np.float64))
    return float((lengths.std(axis=0) / lengths.mean(axis=0)).mean())
