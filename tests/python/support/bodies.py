"""Made bodies and motions of which the measures are known."""

from __future__ import annotations

import numpy as np

from training.motion.heading import heading
from training.motion.skeleton import JOINTS

TRAINING_BODIES = {role: np.ones((22, 3)) for role in ("leader", "reactor")}
"""Of a card whose model is given no leaders."""


def rest_pose() -> np.ndarray:
    """A T-pose (22, 3) standing on y = 0, left at +x, facing +z."""
    half = {
        "pelvis": (0, 0.95, 0), "left_hip": (0.09, 0.9, 0), "left_knee": (0.09, 0.5, 0),
        "left_ankle": (0.09, 0.08, 0), "left_foot": (0.09, 0.02, 0.13), "spine1": (0, 1.05, 0),
        "spine2": (0, 1.18, 0), "spine3": (0, 1.25, 0), "neck": (0, 1.45, 0), "head": (0, 1.55, 0),
        "left_collar": (0.07, 1.4, 0), "left_shoulder": (0.18, 1.42, 0), "left_elbow": (0.45, 1.42, 0),
        "left_wrist": (0.7, 1.42, 0),
    }  # fmt: skip
    pose = np.zeros((22, 3))
    for index, name in enumerate(JOINTS):
        x, y, z = half[name.replace("right", "left")]
        pose[index] = (-x if name.startswith("right") else x, y, z)
    return pose


def standing(frames: int) -> np.ndarray:
    """The T-pose, standing still, (frames, 22, 3) metres."""
    return np.repeat(rest_pose()[None], frames, axis=0)


def random_body(frames: int = 61) -> np.ndarray:
    """A body of random joints that does not move, (frames, 22, 3) metres; the left side is at +x, so it faces +z."""
    body = np.random.default_rng(0).normal(scale=0.3, size=(22, 3))
    for left, right, half in ((1, 2, 0.1), (16, 17, 0.2)):
        body[left], body[right] = (half, 1.0, 0.0), (-half, 1.0, 0.0)
    return np.repeat(body[None], frames, axis=0)


def turned(motion: np.ndarray, degrees: float) -> np.ndarray:
    """Turned to the left about the vertical axis through the origin."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return motion @ np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]).T


def random_walk(frames: int = 24, seed: int = 0) -> np.ndarray:
    """A body of random joints, each of which walks at random, (frames, 22, 3) metres."""
    random = np.random.default_rng(seed)
    return random.normal(scale=0.4, size=(1, 22, 3)) + np.cumsum(
        random.normal(scale=0.02, size=(frames, 22, 3)), 0
    )


def swinging_body(frames: int, seed: int) -> np.ndarray:
    """A body of random joints that swing by 10 cm with a period of 40 frames, (frames, 22, 3) metres."""
    random = np.random.default_rng(seed)
    phase = random.uniform(0, 2 * np.pi, (1, 22, 3))
    steps = 0.1 * np.sin(2 * np.pi * np.arange(frames)[:, None, None] / 40 + phase)
    return random.normal(scale=0.3, size=(1, 22, 3)) + np.array([0.0, 1.0, 0.0]) + steps


def angle_ahead(leader: np.ndarray, reactor: np.ndarray) -> np.ndarray:
    """Angle between the leader's heading and the way to the reactor's root, (T,) degrees in [0, 180]; 0 is ahead."""
    direction = (reactor[:, 0] - leader[:, 0])[:, [0, 2]]
    direction = direction / np.maximum(np.linalg.norm(direction, axis=-1, keepdims=True), 1e-9)
    return np.degrees(np.arccos(np.clip((heading(leader) * direction).sum(axis=-1), -1.0, 1.0)))
