"""The skeleton of the project: 22 joints in SMPL order."""

from __future__ import annotations

import numpy as np

JOINTS: tuple[str, ...] = (
    "pelvis",
    "left_hip",
    "right_hip",
    "spine1",
    "left_knee",
    "right_knee",
    "spine2",
    "left_ankle",
    "right_ankle",
    "spine3",
    "left_foot",
    "right_foot",
    "neck",
    "left_collar",
    "right_collar",
    "head",
    "left_shoulder",
    "right_shoulder",
    "left_elbow",
    "right_elbow",
    "left_wrist",
    "right_wrist",
)
PARENTS: tuple[int, ...] = (-1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19)
LOWER: tuple[int, ...] = (1, 2, 4, 5, 7, 8, 10, 11)
UPPER: tuple[int, ...] = tuple(j for j in range(1, len(JOINTS)) if j not in LOWER)
FEET: tuple[int, ...] = (7, 8, 10, 11)
TOES: tuple[int, int] = (10, 11)
# Index of the joint on the other side of the body; joints of the middle map to themselves.
MIRROR: tuple[int, ...] = tuple(
    JOINTS.index(name.replace("left", "RIGHT").replace("right", "left").replace("RIGHT", "right"))
    for name in JOINTS
)

_SPINE = ((0, 3), (3, 6), (6, 9), (9, 12), (12, 15))
_LEGS = ((1, 4), (4, 7), (2, 5), (5, 8))


def body_height(motion: np.ndarray) -> float:
    """Length of leg plus spine, the measure by which dancers are scaled to one another.

    motion: (T, 22, 3) metres. Returns metres: the median over frames of the mean leg (hip-knee-ankle) plus
    the chain from pelvis to head. Independent of pose, unlike the height of the head above the floor.
    """

    def length(a: int, b: int) -> np.ndarray:
        return np.linalg.norm(motion[:, a] - motion[:, b], axis=-1)

    legs = sum(length(a, b) for a, b in _LEGS) / 2
    spine = sum(length(a, b) for a, b in _SPINE)
    return float(np.median(legs + spine))
