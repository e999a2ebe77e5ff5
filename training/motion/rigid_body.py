"""Gives decoded joints bones of constant length and keeps the lower toe at its height above the floor."""

from __future__ import annotations

import torch
from torch import Tensor

from training.motion.skeleton import PARENTS, TOES
from training.motion.smoothing import gaussian_mean

LOWEST_TOE = 0.02  # metres above the floor; a planted toe rests at about 0.03 (see floor.py)
SIGMA_FRAMES = 2  # of the Gaussian that smooths how far the body is raised


def _bones_above() -> Tensor:
    """(22, 22): 1 where the bone that ends in the column's joint lies between the pelvis and the row's."""
    table = torch.zeros(len(PARENTS), len(PARENTS))
    for joint in range(1, len(PARENTS)):
        above = joint
        while above > 0:
            table[joint, above] = 1
            above = PARENTS[above]
    return table


_BONES_ABOVE = _bones_above()


def constant_bones(motion: Tensor) -> Tensor:
    """The same directions on bones that keep their mean length. motion: (N, T, 22, 3) metres.

    Where a decoder is unsure of a direction it shortens the bone.
    """
    parents = motion.index_select(
        -2, torch.tensor([max(parent, 0) for parent in PARENTS], device=motion.device)
    )
    bones = motion - parents
    lengths = bones.square().sum(-1, keepdim=True).clamp_min(1e-10).sqrt()
    bones = bones / lengths * lengths.mean(-3, keepdim=True)
    return motion[..., :1, :] + _BONES_ABOVE.to(motion) @ bones


def keep_toe_height(motion: Tensor, before: Tensor, floor: bool = True) -> Tensor:
    """`motion` raised or lowered until its lower toe is as high as it was `before`; both (N, T, 22, 3) metres.

    Legs that have been given their length push the feet through the floor. The whole body is raised, smoothly over
    time, since the lower toe changes from one foot to the other. With a `floor` at y = 0 the toe is kept above
    `LOWEST_TOE`.
    """
    toes = torch.tensor(TOES, device=motion.device)
    lower, wanted = (m.index_select(-2, toes)[..., 1].amin(-1) for m in (motion, before))
    if floor:
        wanted = wanted.clamp_min(LOWEST_TOE)
    rise = gaussian_mean(wanted - lower, SIGMA_FRAMES, 3 * SIGMA_FRAMES)
    return motion + torch.stack([torch.zeros_like(rise), rise, torch.zeros_like(rise)], dim=-1)[..., None, :]


def rigid_body(motion: Tensor, floor: bool = True) -> Tensor:
    """Joints (N, T, 22, 3) metres with bones of constant length and the lower toe at its height before; with `floor`,
    at least `LOWEST_TOE` above y = 0.
    """
    return keep_toe_height(constant_bones(motion), motion, floor)
