"""Two bodies that stand still, for pictures."""

from __future__ import annotations

import numpy as np

from training.motion.skeleton import JOINTS


def couple(frames: int = 300) -> tuple[np.ndarray, np.ndarray]:
    """Two upright bodies (feet on the floor) that face each other 0.8 m apart along z."""
    body = np.zeros((22, 3))
    body[:, 1] = np.linspace(0.05, 1.6, 22)
    for index, name in enumerate(JOINTS):
        body[index, 0] = {"left": 0.2, "right": -0.2}.get(name.split("_")[0], 0.0)
    leader = np.repeat(body[None], frames, axis=0)
    return leader, leader * np.array([-1.0, 1.0, -1.0]) + np.array([0.0, 0.0, 0.8])
