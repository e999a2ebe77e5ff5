"""Gives decoded joints bones of constant length that do not flip, and keeps the lower toe at its height."""

from __future__ import annotations

import torch
from torch import Tensor

from training.motion.skeleton import PARENTS, TOES
from training.motion.smoothing import gaussian_mean

LOWEST_TOE = 0.02  # metres above the floor; a planted toe rests at about 0.03 (see floor.py)
SIGMA_FRAMES = 2  # of the Gaussians that smooth how far the body is raised, and uncertain directions
CERTAIN = 0.8  # share of its length from which a bone's direction is taken as decoded
CERTAINTY_POWER = 4  # how fast the weight of a decoded direction falls below that
DIRECTION_PASSES = 3


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


def _bones(motion: Tensor) -> Tensor:
    """Each joint relative to its parent, (N, T, 22, 3) metres; the root relative to itself."""
    parents = torch.tensor([max(parent, 0) for parent in PARENTS], device=motion.device)
    return motion - motion.index_select(-2, parents)


def bone_lengths(motion: Tensor) -> Tensor:
    """(N, T, 22) metres from each joint to its parent, 0 for the root; motion: (N, T, 22, 3) metres."""
    return _bones(motion).square().sum(-1).clamp_min(1e-10).sqrt()


def steady_bones(motion: Tensor, lengths: Tensor) -> Tensor:
    """The same bones, but the shorter one is than it should be, the more its direction is that of the frames around it.
    motion: (N, T, 22, 3) metres; lengths: (22,) metres that the bones should have.

    Where a decoder is unsure of a direction it shortens the bone. An arm that could be up or down has no length when it
    changes from one to the other, and at constant length it would flip within a frame. Here it turns there instead.
    """
    own = bone_lengths(motion)
    certainty = (own / (CERTAIN * lengths + 1e-6)).clamp(max=1) ** CERTAINTY_POWER
    certainty = certainty.movedim(1, -1)[..., None, :]
    decoded = (_bones(motion) / own[..., None]).movedim(1, -1)  # (N, 22, 3, T)
    directions = decoded
    for _ in range(DIRECTION_PASSES):
        around = gaussian_mean(directions.flatten(0, 2), SIGMA_FRAMES, 3 * SIGMA_FRAMES).reshape(
            decoded.shape
        )
        mixed = certainty * decoded + (1 - certainty) * around
        # Not `normalize`, which becomes an operator whose shape is computed on the graphics card and is read too early.
        directions = mixed / mixed.square().sum(2, keepdim=True).clamp_min(1e-10).sqrt()
    return motion[..., :1, :] + _BONES_ABOVE.to(motion) @ (directions.movedim(-1, 1) * own[..., None])


def constant_bones(motion: Tensor, lengths: Tensor) -> Tensor:
    """The same directions on bones of these lengths (22,) metres, or (N, 1, 22). motion: (N, T, 22, 3) metres."""
    bones = _bones(motion) * (lengths / bone_lengths(motion))[..., None]
    return motion[..., :1, :] + _BONES_ABOVE.to(motion) @ bones


def keep_toe_height(motion: Tensor, before: Tensor, floor: bool) -> Tensor:
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


def rigid_body(motion: Tensor, lengths: Tensor | None = None, floor: bool = True) -> Tensor:
    """Joints (N, T, 22, 3) metres with bones of constant length and the lower toe at its height before; with `floor`,
    at least `LOWEST_TOE` above y = 0. lengths: (22,) metres of the bones; by default their means over each motion.
    """
    if lengths is None:
        lengths = bone_lengths(motion).mean(-2, keepdim=True)
    return keep_toe_height(constant_bones(motion, lengths), motion, floor)
