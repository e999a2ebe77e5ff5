"""The direction a body faces on the floor, and vectors as a body with that heading sees them.

A heading is a unit vector (x, z). With y up and right-handed axes, right to left crossed with up points forward.
"""

from __future__ import annotations

import numpy as np
import torch
from torch import Tensor

from training.motion.skeleton import JOINTS

_HIPS = (JOINTS.index("left_hip"), JOINTS.index("right_hip"))
_SHOULDERS = (JOINTS.index("left_shoulder"), JOINTS.index("right_shoulder"))


def _forward(across: Tensor) -> Tensor:
    """Headings (..., 2) of lines (..., 3) from the body's right to its left, finite where these are vertical."""
    forward = torch.stack([-across[..., 2], across[..., 0]], dim=-1)  # across x up
    # Not a sum with a small number: the ONNX exporter takes that for zero and leaves it out.
    return forward / forward.square().sum(-1, keepdim=True).clamp_min(1e-8).sqrt()


def hip_heading(motion: Tensor) -> Tensor:
    """Headings (..., 2) of the hips of (..., 22, 3): what the model's frame of reference and losses go by."""
    return _forward(motion[..., _HIPS[0], :] - motion[..., _HIPS[1], :])


def heading(motion: np.ndarray) -> np.ndarray:
    """Headings (T, 2) of bodies (T, 22, 3) from the lines of hips and shoulders together, for measures: it is steadier
    than the hips alone.
    """
    hips = motion[:, _HIPS[0]] - motion[:, _HIPS[1]]
    shoulders = motion[:, _SHOULDERS[0]] - motion[:, _SHOULDERS[1]]
    return _forward(torch.from_numpy(hips + shoulders)).numpy()


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


def turn_in(vectors: np.ndarray, heading: np.ndarray) -> np.ndarray:
    """World vectors (T, N, 3) as seen from a body that faces heading (T, 2): +z is forward, +x its left."""
    return into_frame(torch.from_numpy(vectors), torch.from_numpy(heading)).numpy()


def turn_out(vectors: np.ndarray, heading: np.ndarray) -> np.ndarray:
    """Inverse of `turn_in`."""
    return out_of_frame(torch.from_numpy(vectors), torch.from_numpy(heading)).numpy()
