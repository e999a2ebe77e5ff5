"""A body that dances the steps: 22 joints, bones of constant length."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import gaussian_filter1d, minimum_filter1d
from scipy.spatial.transform import Rotation

from export.leaders.feet import Foot, foot_motion, support, weight_on_left
from export.leaders.steps import SIGN, Dance, Side
from training.config import FPS
from training.motion.floor import TOE_REST
from training.motion.skeleton import JOINTS

# An adult of 1.72 m in the T-pose facing z: offset of each joint from its parent, metres, left side.
OFFSETS: dict[str, tuple[float, float, float]] = {
    "pelvis": (0, 0, 0),
    "hip": (0.085, -0.09, 0.01),
    "spine1": (0, 0.115, 0.01),
    "knee": (0, -0.415, 0),
    "spine2": (0, 0.115, 0),
    "ankle": (0, -0.41, 0),
    "spine3": (0, 0.06, 0),
    "foot": (0, -0.045, 0.12),
    "neck": (0, 0.15, 0),
    "collar": (0.075, 0.075, 0.012),
    "head": (0, 0.095, 0.015),
    "shoulder": (0.125, 0.02, 0),
    "elbow": (0.275, 0, 0),
    "wrist": (0.235, 0, 0),
}
THIGH, SHIN = 0.415, 0.41
UPPER_ARM, FOREARM = 0.275, 0.235
ANKLE = TOE_REST - OFFSETS["foot"][1]
"""Height of the ankle of a flat foot, metres."""
STRETCH = 0.985
"""Longest leg, as a share of its bones: nobody dances on locked knees."""
STANDING = 0.972
"""The leg in standing, as a share of its bones."""

# How the trunk goes with the weight, degrees at full weight on one foot: as salsa is danced, the hip over the standing
# foot goes out, up and back, while the shoulders stay level and turn the other way.
HIP_ROLL, HIP_YAW, CHEST_ROLL, CHEST_YAW = 7.5, 8.0, -2.5, -8.0
HIP_OUT = 0.042
SETTLE_SECONDS = 0.07
"""The hip arrives this much later than the weight."""
BOUNCE = 0.011
CARRY = 0.45
"""Share by which the body is over the standing foot; 0 would be the middle of both."""


def unit(v: np.ndarray) -> np.ndarray:
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-9)


def bend(root: np.ndarray, target: np.ndarray, pole: np.ndarray, upper: float, lower: float) -> np.ndarray:
    """(T, 3) the middle joint of two bones from root to target (T, 3), on the side of `pole` (T, 3)."""
    line = target - root
    span = np.clip(np.linalg.norm(line, axis=-1), 1e-6, 0.9995 * (upper + lower))
    along = (span**2 + upper**2 - lower**2) / (2 * span)
    aside = np.sqrt(np.maximum(upper**2 - along**2, 0))
    axis = unit(line)
    square = unit(pole - axis * np.sum(pole * axis, axis=-1, keepdims=True))
    return root + axis * along[:, None] + square * aside[:, None]


def turned(heading: np.ndarray, roll: np.ndarray, pitch: np.ndarray) -> Rotation:
    """Turns about the vertical, then the sideways and the forward bend in the body's own axes; radians."""
    return Rotation.from_euler("YXZ", np.stack([heading, pitch, roll], axis=1))


def ankles(foot: Foot, heel: np.ndarray) -> np.ndarray:
    """(T, 3) of the ankle, with the heel raised by radians (T,) about the ball of the foot."""
    _, drop, length = OFFSETS["foot"]
    back = Rotation.from_euler("YX", np.stack([foot.heading, heel], axis=1))
    return foot.ball + [0, TOE_REST, 0] + back.apply([0, -drop, -length])


def joints_of(dance: Dance, tempo_bpm: float, first: float, frames: int, seed: int) -> np.ndarray:
    """(T, 22, 3) metres at 30 fps, y up, the floor at 0.

    first: seconds of count 0. seed: of the small unevenness that no person is without.
    """
    seconds = np.arange(frames) / FPS
    counts = (seconds - first) * tempo_bpm / 60
    wander = _wander(frames, seed)
    heading = gaussian_filter1d(dance.headings.at(counts)[:, 0], 0.07 * FPS)
    feet: dict[Side, Foot] = {side: foot_motion(dance, side, counts, heading) for side in SIGN}
    weight = weight_on_left(dance, counts)
    lean, twist, shimmy = (
        np.radians(track.at(counts)[:, 0]) for track in (dance.lean, dance.twist, dance.shimmy)
    )
    settled = np.interp(seconds - SETTLE_SECONDS, seconds, 2 * gaussian_filter1d(weight, 1.5) - 1)
    hips = turned(
        heading + np.radians(HIP_YAW) * settled + 0.02 * wander[0],
        np.radians(HIP_ROLL) * settled,
        np.full(frames, np.radians(4.0)) + 0.4 * lean,
    )
    shake = shimmy * np.sin(4 * np.pi * counts)
    chest = turned(
        heading + np.radians(CHEST_YAW) * settled + twist + shake + 0.03 * wander[1],
        np.radians(CHEST_ROLL) * settled + 0.015 * wander[2],
        np.radians(3.0) + lean,
    )
    joints: dict[str, np.ndarray] = {}
    joints["pelvis"], heels = _pelvis(dance, counts, feet, hips, settled)
    _trunk(joints, hips, chest, heading, wander)
    for side in SIGN:
        _leg(joints, side, feet[side], heels[side], hips)
        _arm(joints, side, dance.hands[side].at(counts), chest, settled, wander)
    return np.stack([joints[name] for name in JOINTS], axis=1).astype(np.float32)


def _wander(frames: int, seed: int) -> np.ndarray:
    """(9, T) slow noise of variance 1."""
    noise = gaussian_filter1d(np.random.default_rng(seed).standard_normal((9, frames + 400)), 12)[:, 200:-200]
    return noise / noise.std(axis=1, keepdims=True)


def _pelvis(
    dance: Dance, counts: np.ndarray, feet: dict[Side, Foot], hips: Rotation, settled: np.ndarray
) -> tuple[np.ndarray, dict[Side, np.ndarray]]:
    """The pelvis (T, 3), as high as the legs reach, and how far each heel is raised (T,), radians."""
    middle = (feet["left"].ball + feet["right"].ball)[:, [0, 2]] / 2
    level = CARRY * support(dance, counts) + (1 - CARRY) * middle
    level = gaussian_filter1d(level, 0.07 * FPS, axis=0)
    # Over the middle of the feet, not over their balls.
    behind = np.stack([np.sin(feet["left"].heading), np.cos(feet["left"].heading)], axis=1)
    behind += np.stack([np.sin(feet["right"].heading), np.cos(feet["right"].heading)], axis=1)
    level -= 0.045 * unit(behind)
    left = hips.apply([1.0, 0, 0])[:, [0, 2]]
    level += HIP_OUT * settled[:, None] * left
    hop = dance.hop.at(counts)[:, 0]
    leg = THIGH + SHIN
    height = ANKLE + STANDING * leg - OFFSETS["hip"][1] - dance.crouch.at(counts)[:, 0] + hop
    height = height - BOUNCE * np.cos(2 * np.pi * counts)
    heels: dict[Side, np.ndarray] = {side: feet[side].heel for side in SIGN}

    def reach(side: Side) -> np.ndarray:
        """The highest pelvis for a leg."""
        x, y, z = OFFSETS["hip"]
        hip = hips.apply([SIGN[side] * x, y, z])
        ankle = ankles(feet[side], heels[side])
        away = level + hip[:, [0, 2]] - ankle[:, [0, 2]]
        return (
            ankle[:, 1]
            + np.sqrt(np.maximum((STRETCH * leg) ** 2 - np.sum(away**2, axis=1), 0.05))
            - hip[:, 1]
        )

    # The heel of the foot that is farther behind rises rather than that the body sinks.
    for _ in range(40):
        for side in SIGN:
            short = height - 0.01 - reach(side)
            heels[side] = np.clip(heels[side] + np.clip(short, 0, 0.02) * 3, 0, np.radians(55))
    heels = {side: gaussian_filter1d(heel, 1.5) for side, heel in heels.items()}
    lowest = minimum_filter1d(np.minimum(height, np.minimum(reach("left"), reach("right"))), 7)
    y = gaussian_filter1d(lowest, 1.7)
    return np.stack([level[:, 0], y, level[:, 1]], axis=1), heels


def _trunk(
    joints: dict[str, np.ndarray], hips: Rotation, chest: Rotation, heading: np.ndarray, wander: np.ndarray
) -> None:
    """Spine, neck and head; the spine shares out what the chest is turned against the hips."""
    between = (hips.inv() * chest).as_rotvec()
    below = hips
    joint = "pelvis"
    for name, share in (("spine1", 0.0), ("spine2", 0.35), ("spine3", 0.7), ("neck", 1.0)):
        below = hips * Rotation.from_rotvec(share * between)
        joints[name] = joints[joint] + below.apply(OFFSETS[name])
        joint = name
    # Who turns looks where the turn goes.
    ahead = np.clip(0.12 * np.gradient(heading) * FPS, -0.6, 0.6)
    look = turned(
        gaussian_filter1d(heading + ahead, 2) + 0.06 * wander[3], np.zeros_like(heading), 0.04 * wander[4]
    )
    joints["head"] = joints["neck"] + look.apply(OFFSETS["head"])


def _leg(joints: dict[str, np.ndarray], side: Side, foot: Foot, heel: np.ndarray, hips: Rotation) -> None:
    x, y, z = OFFSETS["hip"]
    hip = joints["pelvis"] + hips.apply([SIGN[side] * x, y, z])
    ankle = ankles(foot, heel)
    # Hip to ankle is at most the length of the bones.
    line = ankle - hip
    length = np.linalg.norm(line, axis=1, keepdims=True)
    ankle = hip + line * np.minimum(1, 0.999 * (THIGH + SHIN) / length)
    toes = np.stack([np.sin(foot.heading), np.zeros_like(heel), np.cos(foot.heading)], axis=1)
    pole = unit(toes + 0.6 * hips.apply([0, 0, 1.0]))
    joints[f"{side}_hip"], joints[f"{side}_ankle"] = hip, ankle
    joints[f"{side}_knee"] = bend(hip, ankle, pole, THIGH, SHIN)
    joints[f"{side}_foot"] = foot.ball + [0, TOE_REST, 0]


def _arm(
    joints: dict[str, np.ndarray],
    side: Side,
    hand: np.ndarray,
    chest: Rotation,
    settled: np.ndarray,
    wander: np.ndarray,
) -> None:
    sign = SIGN[side]
    out = np.array([sign, 1.0, 1.0])
    collar = joints["spine3"] + chest.apply(out * OFFSETS["collar"])
    # The shoulder rises with a raised hand.
    raised = np.clip(hand[:, 1], -0.1, 0.4)[:, None] * [0.0, 0.12, 0.0]
    shoulder_offset = out * OFFSETS["shoulder"] + raised
    length = np.linalg.norm(OFFSETS["shoulder"])
    shoulder = collar + chest.apply(unit(shoulder_offset) * length)
    # Hands go against the weight, as in walking.
    swing = np.stack([np.zeros_like(settled), 0.015 * np.abs(settled), -0.035 * sign * settled], axis=1)
    drift = 0.012 * wander[5:8].T if side == "left" else 0.012 * wander[[6, 7, 8]].T
    local = (hand + swing + drift) * out
    wrist = shoulder + chest.apply(local)
    line = wrist - shoulder
    far = np.linalg.norm(line, axis=1, keepdims=True)
    wrist = shoulder + line * np.minimum(1, 0.985 * (UPPER_ARM + FOREARM) / np.maximum(far, 1e-6))
    # Elbows hang, a little outwards and back; beside a hand over the head they point to the side.
    high = np.clip(hand[:, 1] / 0.3, 0, 1)[:, None]
    pole = chest.apply((1 - high) * out * [0.32, -1.0, -0.3] + high * out * [1.0, -0.35, 0.25])
    joints[f"{side}_collar"], joints[f"{side}_shoulder"], joints[f"{side}_wrist"] = collar, shoulder, wrist
    joints[f"{side}_elbow"] = bend(shoulder, wrist, pole, UPPER_ARM, FOREARM)
