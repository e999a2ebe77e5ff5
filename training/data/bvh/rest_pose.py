"""Finds the rest pose that many programs write before the dance.

The rule and its numbers are those of the page's reader (web/motion/bvh/t-pose.ts), so that a file means the same motion
in training and there.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from training.data.bvh.file import BvhFile, world_motion
from training.data.bvh.names import find_joints

# Frames of the file after the first one that it is compared with, and the fewest that can tell anything.
_AFTER, _FEWEST_AFTER = 32, 12
# A jump is this many times more sudden than anything in the frames after it, and at least this part of the body.
_SUDDEN, _LEAST_JUMP = 4.0, 0.05
# How far a bone may be from where a T-pose or the file's rest pose has it.
_AS_T_POSE, _AS_REST = np.cos(np.radians(20)), np.cos(np.radians(12))
# The frames of a solver that starts from the rest pose: hurried, and many times faster than what follows.
_LONGEST_LANDING, _HURRIED, _SLOWER_AFTER = 8, 0.03, 4.0

_SIDES = ("left", "right")
_BONES = [
    (f"{side}_{upper}", f"{side}_{lower}")
    for side in _SIDES
    for upper, lower in (("hip", "knee"), ("knee", "ankle"), ("shoulder", "elbow"), ("elbow", "wrist"))
]


def rest_frames(file: BvhFile) -> int:
    """How many frames at the beginning of a file are no dance: a rest pose, and the jump out of it.

    0 unless that is certain: the first pose must be a T-pose or the file's own rest pose, and the way to the second one
    a jump that no body makes. Raises ValueError when limbs are missing.
    """
    if len(file.values) < _FEWEST_AFTER + 2:
        return 0
    _, found, _ = find_joints(file.nodes)
    places, turns = world_motion(BvhFile(file.nodes, file.values[: _AFTER + 2], fps=1), to_fps=1)
    pose = {name: places[0, node] for name, node in found.items()}
    if not _is_t_pose(pose) and not _is_rest_pose(file, found, pose, turns):
        return 0
    joints = places[:, list(found.values())]
    steps = _mean_way(np.diff(joints, axis=0))
    # How far each frame is from where its two neighbours let one expect it.
    shocks = _mean_way(np.diff(joints, n=2, axis=0) / 2)
    size = _size(pose)
    if steps[0] < _LEAST_JUMP * size or shocks[0] < _SUDDEN * shocks[1:].max():
        return 0
    calm = _SLOWER_AFTER * steps[1 + _LONGEST_LANDING :].max()
    hurried = (steps >= _HURRIED * size) & (steps >= calm)
    hurried[1 + _LONGEST_LANDING :] = False
    return 1 + int(np.argmin(hurried[1:]))


def _mean_way(ways: np.ndarray) -> np.ndarray:
    """Root mean square over the joints of (T, J, 3)."""
    return np.sqrt(np.sum(ways**2, axis=-1).mean(axis=-1))


def _direction(way: np.ndarray) -> np.ndarray:
    return way / max(float(np.linalg.norm(way)), 1e-9)


def _trunk(pose: dict[str, np.ndarray]) -> np.ndarray:
    top = pose["neck"] if "neck" in pose else pose["head"]
    return top - (pose["left_hip"] + pose["right_hip"]) / 2


def _size(pose: dict[str, np.ndarray]) -> float:
    """Leg and trunk in the file's unit."""
    legs = [pose[lower] - pose[upper] for upper, lower in _BONES if upper.endswith(("hip", "knee"))]
    return float(sum(np.linalg.norm(leg) for leg in legs) / 2 + np.linalg.norm(_trunk(pose)))


def _is_t_pose(pose: dict[str, np.ndarray]) -> bool:
    """Arms straight out to the sides and legs straight down, whatever way the body is turned."""
    left, up = _direction(pose["left_hip"] - pose["right_hip"]), _direction(_trunk(pose))

    def as_meant(upper: str, lower: str) -> bool:
        arm = left if upper.startswith("left") else -left
        meant = -up if upper.endswith(("hip", "knee")) else arm
        return float(_direction(pose[lower] - pose[upper]) @ meant) > _AS_T_POSE

    return all(as_meant(upper, lower) for upper, lower in _BONES)


def _is_rest_pose(
    file: BvhFile, found: dict[str, int], pose: dict[str, np.ndarray], turns: list[Rotation]
) -> bool:
    """Every limb as the skeleton has it before any joint is turned, whatever way the hips are turned."""
    rest: list[np.ndarray] = []
    for node in file.nodes:
        rest.append(np.array(node.offset) + (rest[node.parent] if node.parent >= 0 else 0))
    hips = file.nodes[found["left_hip"]].parent
    if hips < 0:
        return False
    home = turns[hips][0].inv()
    return all(
        float(
            _direction(home.apply(pose[lower] - pose[upper]))
            @ _direction(rest[found[lower]] - rest[found[upper]])
        )
        > _AS_REST
        for upper, lower in _BONES
    )
