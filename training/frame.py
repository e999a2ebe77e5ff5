"""The frame of reference that leader features and reactor streams share: the leader's smoothed heading.

Everything is a function of the whole clip, so it does not depend on where windows or blocks begin. Rotating
or moving the couple in the world changes nothing inside the frame.
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor

from training.config import FrameConfig

LEFT_HIP, RIGHT_HIP = 1, 2


def smoothed_heading(leader: Tensor, config: FrameConfig) -> Tensor:
    """Unit heading of the leader in the floor plane.

    leader: (T, 22, 3) metres, y up. Returns (T, 2): x and z of the direction the hips face, smoothed with a
    Gaussian. Ends are padded with zeros, which weighs the frames that exist: only the direction of the sum
    matters.
    """
    across = leader[:, LEFT_HIP] - leader[:, RIGHT_HIP]
    facing = torch.stack([-across[:, 2], across[:, 0]], dim=0)  # across x up
    facing = facing / (facing.square().sum(0, keepdim=True) + 1e-8).sqrt()
    offsets = torch.arange(-config.radius, config.radius + 1, dtype=leader.dtype, device=leader.device)
    kernel = torch.exp(-0.5 * (offsets / config.sigma) ** 2)
    kernel = (kernel / kernel.sum())[None, None]
    smooth = F.conv1d(facing[:, None], kernel, padding=config.radius)[:, 0]
    return (smooth / (smooth.square().sum(0, keepdim=True) + 1e-8).sqrt()).T


def into_frame(vectors: Tensor, heading: Tensor) -> Tensor:
    """Turn world vectors (T, N, 3) so that the heading (T, 2) becomes +z."""
    hx, hz = heading[:, None, 0], heading[:, None, 1]
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    return torch.stack([x * hz - z * hx, y, x * hx + z * hz], dim=-1)


def out_of_frame(vectors: Tensor, heading: Tensor) -> Tensor:
    """Inverse of `into_frame`."""
    hx, hz = heading[:, None, 0], heading[:, None, 1]
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    return torch.stack([x * hz + z * hx, y, z * hz - x * hx], dim=-1)
