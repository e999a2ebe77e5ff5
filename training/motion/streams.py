"""The paper's asymmetric representation (3.1): features of the leader, and the reactor as three streams."""

from __future__ import annotations

import torch
from torch import Tensor

from training.config import FPS
from training.motion.heading import into_frame, out_of_frame
from training.motion.skeleton import JOINTS, LOWER, UPPER

UPPER_WIDTH, LOWER_WIDTH, PLACEMENT_WIDTH = 3 * len(UPPER), 3 * len(LOWER), 3
STREAM_WIDTHS: tuple[int, int, int] = (UPPER_WIDTH, LOWER_WIDTH, PLACEMENT_WIDTH)
LEADER_FEATURES = 3 * (len(JOINTS) - 1) + 1 + 3 + 1  # pose, root height, root velocity, turn rate

# Joint order in which upper and lower streams concatenate (after the root), and the way back to SMPL order.
_ORDER = (0, *UPPER, *LOWER)
_INVERSE = tuple(_ORDER.index(j) for j in range(len(JOINTS)))


def to_streams(leader: Tensor, reactor: Tensor, heading: Tensor) -> tuple[Tensor, Tensor, Tensor]:
    """Split the reactor into upper body (T, 39), lower body (T, 24) and placement (T, 3), in the leader's
    frame.

    Upper and lower are relative to the reactor's root; placement is the root's displacement from the
    leader's root on the floor and the reactor's own height above the floor, so that a jumping leader does
    not lift the reactor.
    """
    frames = reactor.shape[0]
    root = reactor[:, :1]
    local = into_frame(reactor - root, heading)
    upper = local[:, list(UPPER)].reshape(frames, -1)
    lower = local[:, list(LOWER)].reshape(frames, -1)
    displacement = into_frame(root - leader[:, :1], heading)[:, 0]
    placement = torch.stack([displacement[:, 0], root[:, 0, 1], displacement[:, 2]], dim=-1)
    return upper, lower, placement


def from_streams(upper: Tensor, lower: Tensor, placement: Tensor, leader: Tensor, heading: Tensor) -> Tensor:
    """Inverse of `to_streams`: reactor joints (T, 22, 3) in the world.

    leader: (T, N, 3), of which only the root, the first joint, matters.
    """
    ordered = torch.cat([torch.zeros_like(upper[:, :3]), upper, lower], dim=-1).unflatten(
        -1, (len(JOINTS), 3)
    )
    local = ordered.index_select(1, torch.tensor(_INVERSE, device=upper.device))
    floor = torch.stack([placement[:, 0], torch.zeros_like(placement[:, 0]), placement[:, 2]], dim=-1)
    shift = out_of_frame(floor[:, None], heading)
    ground = torch.stack([leader[:, 0, 0], torch.zeros_like(leader[:, 0, 0]), leader[:, 0, 2]], dim=-1)
    height = torch.stack(
        [torch.zeros_like(placement[:, 1]), placement[:, 1], torch.zeros_like(placement[:, 1])], dim=-1
    )
    return out_of_frame(local, heading) + shift + ground[:, None] + height[:, None]


def leader_features(leader: Tensor, heading: Tensor) -> Tensor:
    """The leader's features (T, 68) for the condition encoder, all in the leader's smoothed frame.

    Pose relative to the root (63), root height (1), root velocity in m/s (3), turn rate of the frame in
    rad/s (1).
    """
    root = leader[:, :1]
    pose = into_frame(leader - root, heading)[:, 1:].flatten(1)
    step = root[1:] - root[:-1]
    velocity = into_frame(torch.cat([step[:1], step]) * FPS, heading)[:, 0]
    turn = heading[:-1, 1] * heading[1:, 0] - heading[:-1, 0] * heading[1:, 1]
    turn = torch.cat([turn[:1], turn])[:, None] * FPS
    return torch.cat([pose, root[:, 0, 1:2], velocity, turn], dim=-1)
