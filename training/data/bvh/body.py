"""Retargets the motion of a BVH file to the 22 joints: those that it has, and estimates of the others.

The rules and their numbers are those of the page (web/motion/retarget/retarget.ts and axes-and-units.ts).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from training.data.bvh.file import BvhFile, world_motion
from training.data.bvh.names import find_joints, spine_nodes
from training.data.duet import FPS
from training.motion.skeleton import JOINTS

# Positions of pelvis and spine along the back, from the middle of the hips (0) to the neck (1), as in the SMPL body.
# Programs place these joints differently; body height and the models expect them here.
_TRUNK = {"pelvis": 0.18, "spine1": 0.4, "spine2": 0.61, "spine3": 0.72}
_NECK_SHARE = 0.4
_COLLAR_SHARE = 0.4
# Multiples of the trunk's length: from the neck to a missing head; from the ankle to a missing toe.
_HEAD_LENGTH = 0.17
_TOE_FORWARD, _TOE_DOWN = 0.17, 0.07
_MIN_FOOT_LENGTH = 0.04  # multiple of the body's size; a shorter foot is no foot

_UNITS = {
    "metres": 1.0,
    # The unit of MakeHuman.
    "decimetres": 0.1,
    "centimetres": 0.01,
    "inches": 0.0254,
    "millimetres": 0.001,
    # The CMU library's own skeletons: 1 / 0.45 inch.
    "CMU units": 0.0254 / 0.45,
}
# Leg plus trunk plus neck of an adult, and the middle and the ends of the accepted range, metres.
_ADULT_SIZE, _MIDDLE_SIZE = 1.45, 1.18
_MIN_SIZE, _MAX_SIZE = 0.7, 2.0
# The unit of files that the page wrote, and the same range for them.
PAGE_UNIT = _UNITS["centimetres"]
_OWN_MIN_SIZE, _OWN_MAX_SIZE = 0.2, 2.6

# By the axis of the file that points up: the rotation (3, 3) from the file's axes to y up.
_UPS: dict[str, np.ndarray] = {
    "y": np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1]]),
    "z": np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]]),
    "-z": np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]),
    "-y": np.array([[1, 0, 0], [0, -1, 0], [0, 0, -1]]),
    "x": np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]),
    "-x": np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]),
}

_SIDES = ("left", "right")


@dataclass(frozen=True, eq=False)
class Body:
    """A dancer at 30 fps in the file's unit and axes.

    joints: positions (T, 3) of those that the file has. spine: positions (T, 3) of the nodes between hips and neck,
    upwards. has_smpl_trunk: no joint of the trunk is estimated. ankle_rotation: (T, 3, 3) in the world, by side.
    """

    joints: dict[str, np.ndarray]
    spine: list[np.ndarray]
    has_smpl_trunk: bool
    ankle_rotation: dict[str, np.ndarray]

    def neck_and_head(self) -> tuple[np.ndarray, np.ndarray]:
        """(T, 3) each; the one that the file lacks is estimated from the other."""
        if "neck" not in self.joints:
            shoulders = (self.joints["left_shoulder"] + self.joints["right_shoulder"]) / 2
            head = self.joints["head"]
            return shoulders + _NECK_SHARE * (head - shoulders), head
        neck = self.joints["neck"]
        return neck, self.joints.get("head", neck + _HEAD_LENGTH * (neck - self.hips()))

    def hips(self) -> np.ndarray:
        """(T, 3) middle of the hips."""
        return (self.joints["left_hip"] + self.joints["right_hip"]) / 2

    def size(self) -> float:
        """Leg plus trunk plus neck, the median over time, in the file's unit."""
        neck, head = self.neck_and_head()
        total = _distance(self.hips(), neck) + _distance(neck, head)
        for side in _SIDES:
            hip, knee, ankle = (self.joints[f"{side}_{name}"] for name in ("hip", "knee", "ankle"))
            total = total + (_distance(hip, knee) + _distance(knee, ankle)) / 2
        return float(np.median(total))

    def upright(self) -> np.ndarray:
        """(3,) mean vector from the ankles to the head."""
        ankles = (self.joints["left_ankle"] + self.joints["right_ankle"]) / 2
        return (self.neck_and_head()[1] - ankles).mean(axis=0)


def _distance(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.linalg.norm(a - b, axis=-1)


def read_body(file: BvhFile, fps: float | None) -> Body:
    """The body of a file, resampled to 30 fps. fps: overrides the stated rate. Raises ValueError for missing limbs."""
    found, has_smpl_trunk = find_joints(file.nodes)
    positions, rotations = world_motion(file, FPS, fps)
    joints = {name: positions[:, node] for name, node in found.items()}
    spine = [positions[:, node] for node in spine_nodes(file.nodes, found)]
    ankle_rotation = {side: rotations[found[f"{side}_ankle"]].as_matrix() for side in _SIDES}
    for side in _SIDES:
        ends = [
            k for k, node in enumerate(file.nodes) if node.end_site and node.parent == found[f"{side}_ankle"]
        ]
        if f"{side}_foot" not in joints and ends:
            joints[f"{side}_foot"] = positions[:, ends[0]]
    body = Body(joints, spine, has_smpl_trunk, ankle_rotation)
    for side in _SIDES:
        foot = joints.get(f"{side}_foot")
        # Some skeletons have a second node at the ankle where others have the toes.
        if (
            foot is not None
            and _distance(foot[0], joints[f"{side}_ankle"][0]) <= _MIN_FOOT_LENGTH * body.size()
        ):
            del joints[f"{side}_foot"]
    return body


def find_up(upright: np.ndarray) -> str:
    """Name of the axis that points up, a key of _UPS. upright: (3,) vector from the feet to the head."""
    return max(_UPS, key=lambda name: float(_UPS[name][1] @ upright))


def find_unit(size: float) -> float:
    """Metres per unit of a file: the usual unit in which a body is nearest to the middle of a person's sizes, by ratio.

    size: of the body, in the file's unit. A body that is no person in any of them is scaled to an adult's size. Raises
    ValueError for size 0.
    """
    if not size > 0:
        raise ValueError("the joints all lie in one place: the skeleton has no size")
    metres = min(_UNITS.values(), key=lambda unit: abs(np.log(size * unit / _MIDDLE_SIZE)))
    return metres if _MIN_SIZE <= size * metres <= _MAX_SIZE else _ADULT_SIZE / size


def is_page_size(size: float) -> bool:
    """Whether a body of this size in `PAGE_UNIT` can be one of the page's, whose dancers are 0.5 to 2.5 m high."""
    return _OWN_MIN_SIZE <= size * PAGE_UNIT <= _OWN_MAX_SIZE


def _along(line: list[np.ndarray], share: float) -> np.ndarray:
    """(T, 3) the point at a share (0 to 1) of the length of a polyline through (T, 3) points."""
    steps = np.stack([_distance(a, b) for a, b in pairwise(line)])
    left = share * steps.sum(axis=0)
    point = line[-1].copy()
    done = np.zeros(len(point), dtype=bool)
    for k, step in enumerate(steps):
        here = ~done & (left <= step)
        part = np.divide(left, step, out=np.zeros_like(left), where=step > 0)[:, None]
        point[here] = (line[k] + part * (line[k + 1] - line[k]))[here]
        done |= here
        left = left - step
    return point


def _estimate_toe(body: Body, side: str, axes: np.ndarray, trunk: float) -> np.ndarray:
    """(T, 3) toe joint for a file without: fixed to the ankle, ahead of it and below it in the mean over time.

    axes: (3, 3) rotation from the file's axes to y up. trunk: length from the hips to the neck, in the file's unit.
    """
    left = (body.joints["left_hip"] - body.joints["right_hip"]) @ axes.T
    front = np.cross(left, np.array([0.0, 1.0, 0.0]))
    front /= np.maximum(np.linalg.norm(front, axis=-1, keepdims=True), 1e-12)
    wanted = (_TOE_FORWARD * front + np.array([0, -_TOE_DOWN, 0])) @ axes
    fixed = np.einsum("tji,tj->ti", body.ankle_rotation[side], wanted).sum(axis=0)
    fixed *= trunk * np.hypot(_TOE_FORWARD, _TOE_DOWN) / max(float(np.linalg.norm(fixed)), 1e-12)
    return body.joints[f"{side}_ankle"] + body.ankle_rotation[side] @ fixed


def assemble(body: Body, up: str, metres: float) -> np.ndarray:
    """All 22 joints: (T, 22, 3) float32 in metres, y up. up: of `find_up`; metres: per unit of the file."""
    axes = _UPS[up].astype(np.float64)
    joints = dict(body.joints)
    neck, head = body.neck_and_head()
    joints |= {"neck": neck, "head": head}
    if not body.has_smpl_trunk:
        line = [body.hips(), *body.spine, neck]
        joints |= {name: _along(line, share) for name, share in _TRUNK.items()}
    trunk = float(_distance(neck[0], body.hips()[0]))
    for side in _SIDES:
        if f"{side}_collar" not in joints:
            joints[f"{side}_collar"] = neck + _COLLAR_SHARE * (joints[f"{side}_shoulder"] - neck)
        if f"{side}_foot" not in joints:
            joints[f"{side}_foot"] = _estimate_toe(body, side, axes, trunk)
    stacked = np.stack([joints[name] for name in JOINTS], axis=1)
    return (stacked @ axes.T * metres).astype(np.float32)
