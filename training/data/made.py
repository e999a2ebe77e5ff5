"""Dancers made from formulas, for golden tensors, benchmarks and tests."""

from __future__ import annotations

import numpy as np

from training.config import FPS
from training.motion.skeleton import PARENTS

# A standing body with its arms half raised, parent to joint, metres, y up, facing +z; left is +x.
_OFFSETS = np.array(
    [
        [0, 0.95, 0],
        [0.09, -0.05, 0],
        [-0.09, -0.05, 0],
        [0, 0.11, -0.01],
        [0.02, -0.4, 0.01],
        [-0.02, -0.4, 0.01],
        [0, 0.13, 0],
        [0, -0.41, -0.02],
        [0, -0.41, -0.02],
        [0, 0.06, 0.01],
        [0.02, -0.06, 0.13],
        [-0.02, -0.06, 0.13],
        [0, 0.21, -0.01],
        [0.07, 0.12, 0],
        [-0.07, 0.12, 0],
        [0, 0.1, 0.04],
        [0.11, 0.03, 0],
        [-0.11, 0.03, 0],
        [0.2, -0.15, 0.03],
        [-0.2, -0.15, 0.03],
        [0.1, -0.1, 0.18],
        [-0.1, -0.1, 0.18],
    ]
)


def _turn(angle: np.ndarray) -> np.ndarray:
    """Rotations about the vertical: (T,) radians to (T, 3, 3)."""
    c, s, o, i = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    return np.stack([np.stack([c, o, s], -1), np.stack([o, i, o], -1), np.stack([-s, o, c], -1)], -2)


def _bend(angle: np.ndarray) -> np.ndarray:
    """Rotations about the sideways axis: (T,) radians to (T, 3, 3)."""
    c, s, o, i = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    return np.stack([np.stack([i, o, o], -1), np.stack([o, c, -s], -1), np.stack([o, s, c], -1)], -2)


def made_dancer(frames: int, seed: int) -> np.ndarray:
    """A dancer (frames, 22, 3) who steps, turns and travels smoothly; every seed dances differently."""
    random = np.random.default_rng(seed)
    time = np.arange(frames) / FPS
    beat = 2 * np.pi * random.uniform(1.2, 1.6) * time
    yaw = (
        random.uniform(-np.pi, np.pi)
        + 0.8 * np.sin(0.5 * time + random.uniform(0, 6))
        + 0.2 * np.sin(beat / 2)
    )
    world: list[np.ndarray] = []
    turned: list[np.ndarray] = []
    for joint, parent in enumerate(PARENTS):
        local = _bend(random.uniform(0.05, 0.25) * np.sin(beat / 2 + random.uniform(0, 6)))
        if parent < 0:
            root = np.stack(
                [0.5 * np.sin(0.4 * time), 0.95 + 0.02 * np.sin(beat), 0.5 * np.cos(0.3 * time)], axis=-1
            )
            world.append(root)
            turned.append(_turn(yaw))
        else:
            world.append(world[parent] + turned[parent] @ _OFFSETS[joint])
            turned.append(turned[parent] @ local)
    motion = np.stack(world, axis=1)
    motion[..., 1] -= motion[..., 1].min()
    return motion.astype(np.float32)
