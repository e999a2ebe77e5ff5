"""How far a generated reactor is from the true one (pose, velocity, place beside the leader), and whether bones keep
their length.

Every motion is (T, J, 3) in metres at 30 fps with joint 0 the root. MPJPE and MPJVE (the paper's) compare joints
relative to the root, so they do not depend on where the reactor stands; the relative-root error does. Motions of
different lengths raise ValueError.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.evaluation.metrics.distance import root_distance
from training.motion.skeleton import PARENTS

# Edges of the bins of true distance between the roots, metres: in hold, at arm's length, just apart, farther away.
DISTANCE_EDGES: tuple[float, ...] = (0.0, 0.4, 0.8, 1.2, float("inf"))


def _same_length(*motions: np.ndarray) -> None:
    lengths = {len(m) for m in motions}
    if len(lengths) != 1:
        raise ValueError(f"motions must have the same number of frames, got {sorted(lengths)}")


def root_relative(motion: np.ndarray) -> np.ndarray:
    """Positions of (T, J, 3) seen from the root of the same frame."""
    return motion - motion[:, :1]


def mpjpe(truth: np.ndarray, generated: np.ndarray) -> float:
    """Mean per-joint position error, root-relative in every frame, all joints, in mm."""
    _same_length(truth, generated)
    return float(np.linalg.norm(root_relative(generated) - root_relative(truth), axis=-1).mean() * 1000)


def mpjve(truth: np.ndarray, generated: np.ndarray) -> float:
    """Mean per-joint velocity error, root-relative, in mm per frame (not per second)."""
    _same_length(truth, generated)
    difference = np.diff(root_relative(generated), axis=0) - np.diff(root_relative(truth), axis=0)
    return float(np.linalg.norm(difference, axis=-1).mean() * 1000)


def root_error_per_frame(leader: np.ndarray, truth: np.ndarray, generated: np.ndarray) -> np.ndarray:
    """Distance in metres between the true and the generated root as seen from the leader's root, (T,)."""
    _same_length(leader, truth, generated)
    return np.linalg.norm((generated[:, 0] - leader[:, 0]) - (truth[:, 0] - leader[:, 0]), axis=-1)


def root_error(leader: np.ndarray, truth: np.ndarray, generated: np.ndarray) -> float:
    """Relative-root error: mean over frames of ||(rootR - rootL) - (rootR - rootL)_true||, in mm."""
    return float(root_error_per_frame(leader, truth, generated).mean() * 1000)


def root_error_by_distance(leader: np.ndarray, truth: np.ndarray, generated: np.ndarray) -> dict[str, float]:
    """Relative-root error in mm for each bin of the true distance between the roots; NaN for a bin without a frame.

    A model that always keeps one distance has an error that grows away from it.
    """
    error = root_error_per_frame(leader, truth, generated) * 1000
    distance = root_distance(leader, truth)
    result: dict[str, float] = {}
    for low, high in pairwise(DISTANCE_EDGES):
        inside = (distance >= low) & (distance < high)
        name = f">{low:g} m" if np.isinf(high) else f"{low:g}-{high:g} m"
        result[name] = float(error[inside].mean()) if inside.any() else float("nan")
    return result


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
