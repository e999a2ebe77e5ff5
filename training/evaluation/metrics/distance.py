"""How the two dancers stand to each other: distances of roots, hands and other joints, facing.

Motions are (T, 22, 3) in metres, y up. Distributions over frames are compared by the Wasserstein distance,
which has the unit of what is compared.
"""

from __future__ import annotations

import numpy as np
from scipy.stats import wasserstein_distance

from training.config import FPS
from training.motion.heading import heading
from training.motion.skeleton import JOINTS

_WRISTS = (JOINTS.index("left_wrist"), JOINTS.index("right_wrist"))
# Hands that hold each other: greatest distance of the wrists, and greatest speed of one against the other.
_HELD_DISTANCE, _HELD_SPEED = 0.4, 0.4  # metres, metres a second
# Root, ankles, feet, head, shoulders and wrists, as in the Duolando evaluation (Siyao et al. 2024).
CROSS_JOINTS: tuple[int, ...] = (0, 7, 8, 10, 11, 15, 16, 17, 20, 21)


def root_distance(leader: np.ndarray, reactor: np.ndarray) -> np.ndarray:
    """Distance between the roots in every frame, (T,) metres."""
    return np.linalg.norm(reactor[:, 0] - leader[:, 0], axis=-1)


def hand_distance(leader: np.ndarray, reactor: np.ndarray) -> np.ndarray:
    """Smallest of the four distances between a wrist of one and a wrist of the other, (T,) metres."""
    gap = leader[:, _WRISTS, None] - reactor[:, None, _WRISTS]
    return np.linalg.norm(gap, axis=-1).min(axis=(1, 2))


def hands_held(leader: np.ndarray, reactor: np.ndarray) -> float:
    """Share of frames in which a wrist of one is near a wrist of the other and goes the same way, as those of hands
    that hold each other.
    """
    way = reactor[:, None, _WRISTS] - leader[:, _WRISTS, None]  # (T, 2, 2, 3)
    near = np.linalg.norm(way, axis=-1) < _HELD_DISTANCE
    together = np.linalg.norm(np.gradient(way, axis=0), axis=-1) * FPS < _HELD_SPEED
    return float((near & together).any(axis=(1, 2)).mean())


def facing(leader: np.ndarray, reactor: np.ndarray) -> np.ndarray:
    """Angle between the two headings, (T,) degrees in [0, 180]: 180 is face to face or back to back, 0 is the same
    direction.
    """
    cosine = (heading(leader) * heading(reactor)).sum(axis=-1)
    return np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))


def cross_distances(leader: np.ndarray, reactor: np.ndarray) -> np.ndarray:
    """Features of the pair for FID_cd: the mean over time of the distance from each of ten joints of the reactor to
    each of ten of the leader, (100,) metres, reactor joint by leader joint.
    """
    joints = list(CROSS_JOINTS)
    gap = reactor[:, joints, None] - leader[:, None, joints]
    return np.linalg.norm(gap.astype(np.float64), axis=-1).mean(axis=0).reshape(-1)


def wasserstein(truth: np.ndarray, generated: np.ndarray) -> float:
    """Wasserstein-1 distance between two samples of a scalar, in the scalar's unit."""
    return float(wasserstein_distance(truth, generated))
