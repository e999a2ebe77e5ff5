"""The 22-joint body that every part of the project speaks of (SMPL order, metres, y up)."""

from __future__ import annotations

import numpy as np
import torch
from torch import Tensor

from training.motion.smoothing import gaussian_mean

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
LOWEST_TOE = 0.02  # metres above the floor; a planted toe rests at about 0.03 (training/motion/floor.py)
GIVING_WAY = 2  # frames, sigma of the pelvis following the feet

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


def _descent() -> Tensor:
    """(22, 22): 1 where the bone that ends in the column's joint lies between the pelvis and the row's."""
    table = torch.zeros(len(PARENTS), len(PARENTS))
    for joint in range(1, len(PARENTS)):
        above = joint
        while above > 0:
            table[joint, above] = 1
            above = PARENTS[above]
    return table


_DESCENT = _descent()


def constant_bones(motion: Tensor) -> Tensor:
    """The same directions on bones that keep their mean length. motion: (N, T, 22, 3) metres.

    A decoder that is unsure of a direction shortens the bone; a body cannot.
    """
    parents = motion.index_select(
        -2, torch.tensor([max(parent, 0) for parent in PARENTS], device=motion.device)
    )
    bones = motion - parents
    lengths = bones.square().sum(-1, keepdim=True).clamp_min(1e-10).sqrt()
    bones = bones / lengths * lengths.mean(-3, keepdim=True)
    return motion[..., :1, :] + _DESCENT.to(motion) @ bones


def keep_footing(motion: Tensor, before: Tensor, floor: bool = True) -> Tensor:
    """`motion` raised or lowered until its lower toe is as high as it was `before`; both (N, T, 22, 3) metres.

    Legs that have been given their length push the feet through the floor. The pelvis gives way, smoothly:
    a lower toe that changes from one foot to the other must not jolt the body. With a `floor` at y = 0 the toe is
    kept from sinking below `LOWEST_TOE`.
    """
    toes = torch.tensor(TOES, device=motion.device)
    lower, wanted = (m.index_select(-2, toes)[..., 1].amin(-1) for m in (motion, before))
    if floor:
        wanted = wanted.clamp_min(LOWEST_TOE)
    rise = gaussian_mean(wanted - lower, GIVING_WAY, 3 * GIVING_WAY)
    return motion + torch.stack([torch.zeros_like(rise), rise, torch.zeros_like(rise)], dim=-1)[..., None, :]


def as_body(motion: Tensor, floor: bool = True) -> Tensor:
    """Decoded joints (N, T, 22, 3) as a body that can exist: bones of constant length, feet where they were, and not
    sunk into a `floor` at y = 0.
    """
    return keep_footing(constant_bones(motion), motion, floor)
