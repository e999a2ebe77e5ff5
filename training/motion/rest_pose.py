"""The rest pose of a dancer's skeleton, as `restOffsets` of web/motion/fit/rest-pose.ts finds it."""

from __future__ import annotations

import numpy as np

from training.motion.skeleton import JOINTS, MIRROR, PARENTS, TOES

STANDING_PERCENTILE = 25
"""Percentile of the toe's heights up to which a foot counts as standing."""
STEEPEST_FOOT = 0.9
"""Largest sine of the angle from ankle to toe, downwards."""

_J = {name: joint for joint, name in enumerate(JOINTS)}


def rest_offsets(motion: np.ndarray) -> np.ndarray:
    """(22, 3) metres from each joint's parent in a T-pose facing +z, arms along x, of a motion (T, 22, 3) metres.

    Bones of pelvis and chest, and the shoulders, keep the shape that the motion shows (medians over time); all others
    point where a T-pose has them. Left and right mirror each other.
    """
    motion = motion.astype(np.float64)
    bones = motion - motion[:, [max(parent, 0) for parent in PARENTS]]
    lengths = np.median(np.linalg.norm(bones, axis=-1), axis=0)
    lengths = (lengths + lengths[list(MIRROR)]) / 2
    directions = np.tile([0.0, 1.0, 0.0], (len(JOINTS), 1))
    pelvis, chest = _trunk_axes(motion)
    for axes, joints in ((pelvis, ("left_hip", "spine1")), (chest, ("left_collar", "left_shoulder"))):
        for joint in (_J[name] for name in joints):
            own, other = (
                np.median(np.einsum("tia,ti->ta", axes, bones[:, j]), axis=0) for j in (joint, MIRROR[joint])
            )
            across, up, forwards = (own[0] - other[0]) / 2, *(own[1:] + other[1:]) / 2
            directions[MIRROR[joint]] = (-across, up, forwards)
            directions[joint] = (across, up, forwards)
    drop = _toe_drop(motion, bones)
    for side, x in (("left", 1.0), ("right", -1.0)):
        directions[[_J[f"{side}_knee"], _J[f"{side}_ankle"]]] = (0, -1, 0)
        directions[[_J[f"{side}_elbow"], _J[f"{side}_wrist"]]] = (x, 0, 0)
        directions[_J[f"{side}_foot"]] = (0, drop, np.sqrt(1 - drop**2))
    offsets = lengths[:, None] * directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    return offsets.astype(np.float32)


def _trunk_axes(motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Axes of pelvis and chest, (T, 3, 3) with x, y and z in the columns: x from hip to hip, or collar to collar, y
    from the hips to the spine, or from the upper spine to the neck.
    """

    def axes(across: np.ndarray, up: np.ndarray) -> np.ndarray:
        x = across / np.linalg.norm(across, axis=-1, keepdims=True)
        y = up - (up * x).sum(-1, keepdims=True) * x
        y /= np.linalg.norm(y, axis=-1, keepdims=True)
        return np.stack([x, y, np.cross(x, y)], axis=-1)

    def joint(name: str) -> np.ndarray:
        return motion[:, _J[name]]

    hips = (joint("left_hip") + joint("right_hip")) / 2
    return (
        axes(joint("left_hip") - joint("right_hip"), joint("spine1") - hips),
        axes(joint("left_collar") - joint("right_collar"), joint("neck") - joint("spine3")),
    )


def _toe_drop(motion: np.ndarray, bones: np.ndarray) -> float:
    """Slope of standing feet from ankle to toe, as the sine of the angle, -0.9 to 0."""
    sines: list[np.ndarray] = []
    for toe in TOES:
        heights = motion[:, toe, 1]
        feet = bones[heights <= np.percentile(heights, STANDING_PERCENTILE), toe]
        sines.append(feet[:, 1] / np.linalg.norm(feet, axis=-1))
    return float(np.median(np.concatenate(sines)).clip(-STEEPEST_FOOT, 0))
