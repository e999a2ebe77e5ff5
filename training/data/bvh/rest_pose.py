"""Finds the rest pose that many programs write before the dance.

The rule and its numbers are those of the page (web/motion/retarget/t-pose.ts).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from training.data.bvh.file import BvhFile, world_motion
from training.data.bvh.names import find_joints

# Frames after the first one with which it is compared, at most and at least.
_COMPARED_FRAMES, _MIN_COMPARED_FRAMES = 32, 12
# A jump's acceleration is this many times the largest one after it, and its length at least this share of the body.
_ACCELERATION_RATIO, _MIN_JUMP = 4.0, 0.05
# Largest angle of a bone to that of a T-pose and of the file's rest pose, as cosines.
_T_POSE_COSINE, _REST_POSE_COSINE = np.cos(np.radians(20)), np.cos(np.radians(12))
# Transition from the rest pose to the dance, as solvers write it: at most so many frames, at least so fast (shares of
# the body per frame), and so many times faster than what follows.
_MAX_TRANSITION_FRAMES, _MIN_TRANSITION_SPEED, _TRANSITION_SPEED_RATIO = 8, 0.03, 4.0

_SIDES = ("left", "right")
_BONES = [
    (f"{side}_{upper}", f"{side}_{lower}")
    for side in _SIDES
    for upper, lower in (("hip", "knee"), ("knee", "ankle"), ("shoulder", "elbow"), ("elbow", "wrist"))
]


def rest_frames(file: BvhFile) -> int:
    """Number of frames at the beginning of a file that are no dance: the rest pose and the transition out of it.

    0 unless that is certain: the first pose must be a T-pose or the file's own rest pose, and the step to the
    second one faster than a body can move. Raises ValueError when limbs are missing.
    """
    if len(file.values) < _MIN_COMPARED_FRAMES + 2:
        return 0
    found, _ = find_joints(file.nodes)
    first = replace(file, values=file.values[: _COMPARED_FRAMES + 2], fps=1)
    positions, rotations = world_motion(first, to_fps=1)
    pose = {name: positions[0, node] for name, node in found.items()}
    if not _is_t_pose(pose) and not _is_rest_pose(file, found, pose, rotations):
        return 0
    joints = positions[:, list(found.values())]
    steps = _root_mean_square(np.diff(joints, axis=0))
    # Distance of each frame from the middle of its two neighbours: half the acceleration.
    accelerations = _root_mean_square(np.diff(joints, n=2, axis=0) / 2)
    size = _size(pose)
    if steps[0] < _MIN_JUMP * size or accelerations[0] < _ACCELERATION_RATIO * accelerations[1:].max():
        return 0
    dancing = _TRANSITION_SPEED_RATIO * steps[1 + _MAX_TRANSITION_FRAMES :].max()
    transition = (steps >= _MIN_TRANSITION_SPEED * size) & (steps >= dancing)
    transition[1 + _MAX_TRANSITION_FRAMES :] = False
    return 1 + int(np.argmin(transition[1:]))


def _root_mean_square(vectors: np.ndarray) -> np.ndarray:
    """(T,) of the lengths of (T, J, 3), over the joints."""
    return np.sqrt(np.sum(vectors**2, axis=-1).mean(axis=-1))


def _direction(vector: np.ndarray) -> np.ndarray:
    return vector / max(float(np.linalg.norm(vector)), 1e-9)


def _trunk(pose: dict[str, np.ndarray]) -> np.ndarray:
    """(3,) from the middle of the hips to the neck, or to the head where there is no neck."""
    top = pose["neck"] if "neck" in pose else pose["head"]
    return top - (pose["left_hip"] + pose["right_hip"]) / 2


def _size(pose: dict[str, np.ndarray]) -> float:
    """Length of a leg plus the trunk, in the file's unit."""
    legs = [pose[lower] - pose[upper] for upper, lower in _BONES if upper.endswith(("hip", "knee"))]
    return float(sum(np.linalg.norm(leg) for leg in legs) / 2 + np.linalg.norm(_trunk(pose)))


def _is_t_pose(pose: dict[str, np.ndarray]) -> bool:
    """Whether the arms are straight out to the sides and the legs straight down, however the body is turned."""
    left, up = _direction(pose["left_hip"] - pose["right_hip"]), _direction(_trunk(pose))

    def as_in_t_pose(upper: str, lower: str) -> bool:
        arm = left if upper.startswith("left") else -left
        expected = -up if upper.endswith(("hip", "knee")) else arm
        return float(_direction(pose[lower] - pose[upper]) @ expected) > _T_POSE_COSINE

    return all(as_in_t_pose(upper, lower) for upper, lower in _BONES)


def _is_rest_pose(
    file: BvhFile, found: dict[str, int], pose: dict[str, np.ndarray], rotations: list[Rotation]
) -> bool:
    """Whether every limb is as in the skeleton without rotations, however the hips are turned."""
    rest: list[np.ndarray] = []
    for node in file.nodes:
        rest.append(np.array(node.offset) + (rest[node.parent] if node.parent >= 0 else 0))
    hips = file.nodes[found["left_hip"]].parent
    if hips < 0:
        return False
    home = rotations[hips][0].inv()
    return all(
        float(
            _direction(home.apply(pose[lower] - pose[upper]))
            @ _direction(rest[found[lower]] - rest[found[upper]])
        )
        > _REST_POSE_COSINE
        for upper, lower in _BONES
    )
