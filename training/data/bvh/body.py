"""Makes the 22 joints of the motion in a BVH file: those that it has, and the others by rule.

The rules and their numbers are those of the page's reader (web/motion), so that a file means the same dancer in
training and there.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from training.data.bvh.file import BvhFile, world_motion
from training.data.bvh.names import back_nodes, find_joints
from training.data.duet import FPS
from training.motion.skeleton import JOINTS

# Where pelvis and spine lie between the middle of the hips (0) and the neck (1), along the back: the proportions of
# the SMPL body. Programs put these joints anywhere; body height and the models expect them here.
_TRUNK = {"pelvis": 0.18, "spine1": 0.4, "spine2": 0.61, "spine3": 0.72}
_NECK_SHARE = 0.4
_COLLAR_SHARE = 0.4
# Parts of the trunk: from neck to a missing head; a missing foot forward and down; a joint doubled at the ankle.
_HEAD_LENGTH = 0.17
_TOE_FORWARD, _TOE_DOWN = 0.17, 0.07
_SHORTEST_FOOT = 0.04

_UNITS = {
    "metres": 1.0,
    "centimetres": 0.01,
    "inches": 0.0254,
    "millimetres": 0.001,
    # The CMU library's own skeletons: 1 / 0.45 inch.
    "CMU units": 0.0254 / 0.45,
}
# Leg plus trunk plus neck of a grown person, metres.
_PERSON = 1.45

# Rows of the rotation that makes an axis point up.
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
    """A dancer at 30 fps in the file's unit and axes. joints: (T, 3) each; ankle_turn: (T, 3, 3) world rotations."""

    convention: str
    joints: dict[str, np.ndarray]
    back: list[np.ndarray]
    own_trunk: bool
    ankle_turn: dict[str, np.ndarray]

    def neck_and_head(self) -> tuple[np.ndarray, np.ndarray]:
        """(T, 3) each; one of them may be missing in the file."""
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
    """Names the joints of a file and moves them at 30 fps. Raises ValueError when limbs are missing."""
    convention, found, own_trunk = find_joints(file.nodes)
    places, turns = world_motion(file, FPS, fps)
    joints = {name: places[:, node] for name, node in found.items()}
    back = [places[:, node] for node in back_nodes(file.nodes, found)]
    ankle_turn = {side: turns[found[f"{side}_ankle"]].as_matrix() for side in _SIDES}
    for side in _SIDES:
        ends = [
            k for k, node in enumerate(file.nodes) if node.end_site and node.parent == found[f"{side}_ankle"]
        ]
        if f"{side}_foot" not in joints and ends:
            joints[f"{side}_foot"] = places[:, ends[0]]
    body = Body(convention, joints, back, own_trunk, ankle_turn)
    for side in _SIDES:
        foot = joints.get(f"{side}_foot")
        # A node that lies on the ankle is no toe.
        if (
            foot is not None
            and _distance(foot[0], joints[f"{side}_ankle"][0]) <= _SHORTEST_FOOT * body.size()
        ):
            del joints[f"{side}_foot"]
    return body


def find_up(upright: np.ndarray) -> str:
    """Name of the axis that points up, from the vector of the feet to the head: y or z, rarely another."""
    return max(_UPS, key=lambda name: float(_UPS[name][1] @ upright))


def find_unit(size: float) -> float:
    """Metres per unit of a file: the usual unit in which the body is nearest to a person's size.

    A body that is a person in none of them is brought to a person's size.
    """
    if not size > 0:
        raise ValueError("the joints all lie in one place: the skeleton has no size")
    metres = min(_UNITS.values(), key=lambda unit: abs(np.log(size * unit / _PERSON)))
    return metres if 0.75 <= size * metres <= 2.2 else _PERSON / size


def _along(line: list[np.ndarray], share: float) -> np.ndarray:
    """(T, 3) the point at a share of the length of a line of (T, 3) points."""
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


def _made_toe(body: Body, side: str, turn: np.ndarray, trunk: float) -> np.ndarray:
    """(T, 3) toes for a file without: ahead of and below the ankle on the average, so that they turn with it."""
    left = (body.joints["left_hip"] - body.joints["right_hip"]) @ turn.T
    front = np.cross(left, np.array([0.0, 1.0, 0.0]))
    front /= np.maximum(np.linalg.norm(front, axis=-1, keepdims=True), 1e-12)
    wanted = (_TOE_FORWARD * front + np.array([0, -_TOE_DOWN, 0])) @ turn
    seen = np.einsum("tji,tj->ti", body.ankle_turn[side], wanted).sum(axis=0)
    seen *= trunk * np.hypot(_TOE_FORWARD, _TOE_DOWN) / max(float(np.linalg.norm(seen)), 1e-12)
    return body.joints[f"{side}_ankle"] + body.ankle_turn[side] @ seen


def assemble(body: Body, up: str, metres: float) -> np.ndarray:
    """All 22 joints: (T, 22, 3) float32 in metres, y up. up: the axis of the file that points up."""
    turn = _UPS[up].astype(np.float64)
    joints = dict(body.joints)
    neck, head = body.neck_and_head()
    joints |= {"neck": neck, "head": head}
    if not body.own_trunk:
        line = [body.hips(), *body.back, neck]
        joints |= {name: _along(line, share) for name, share in _TRUNK.items()}
    trunk = float(_distance(neck[0], body.hips()[0]))
    for side in _SIDES:
        if f"{side}_collar" not in joints:
            joints[f"{side}_collar"] = neck + _COLLAR_SHARE * (joints[f"{side}_shoulder"] - neck)
        if f"{side}_foot" not in joints:
            joints[f"{side}_foot"] = _made_toe(body, side, turn, trunk)
    stacked = np.stack([joints[name] for name in JOINTS], axis=1)
    return (stacked @ turn.T * metres).astype(np.float32)
