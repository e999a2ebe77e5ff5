"""How the two dancers stand to each other: distance of the roots, nearest hands, facing.

Motions are (T, 22, 3) in metres, y up. Distributions over frames are compared by the Wasserstein distance,
which stays in the unit of what is compared.
"""

from __future__ import annotations

import numpy as np
from scipy.stats import wasserstein_distance

from training.motion.heading import heading
from training.motion.skeleton import JOINTS

_WRISTS = (JOINTS.index("left_wrist"), JOINTS.index("right_wrist"))


def root_distance(leader: np.ndarray, reactor: np.ndarray) -> np.ndarray:
    """Distance between the roots in every frame, (T,) metres."""
    return np.linalg.norm(reactor[:, 0] - leader[:, 0], axis=-1)


def hand_distance(leader: np.ndarray, reactor: np.ndarray) -> np.ndarray:
    """Smallest of the four distances between a wrist of one and a wrist of the other, (T,) metres."""
    gap = leader[:, _WRISTS, None] - reactor[:, None, _WRISTS]
    return np.linalg.norm(gap, axis=-1).min(axis=(1, 2))


def facing(leader: np.ndarray, reactor: np.ndarray) -> np.ndarray:
    """Angle between the two headings, (T,) degrees in [0, 180]: 180 is face to face or back to back, 0 is
    abreast.
    """
    cosine = (heading(leader) * heading(reactor)).sum(axis=-1)
    return np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))


def bearing(leader: np.ndarray, reactor: np.ndarray) -> np.ndarray:
    """Angle between the leader's heading and the way to the reactor, (T,) degrees in [0, 180]: 0 is in front.

    Together with `facing` it tells face to face (0 and 180) from back to back (180 and 180).
    """
    way = (reactor[:, 0] - leader[:, 0])[:, [0, 2]]
    way = way / np.maximum(np.linalg.norm(way, axis=-1, keepdims=True), 1e-9)
    return np.degrees(np.arccos(np.clip((heading(leader) * way).sum(axis=-1), -1.0, 1.0)))


def wasserstein(truth: np.ndarray, generated: np.ndarray) -> float:
    """Wasserstein-1 distance between two samples of a scalar, in the scalar's unit."""
    return float(wasserstein_distance(truth, generated))
