"""Foot skating, and the physical foot contact score (PFC).

When a foot is in contact is said by `training.motion.foot_contact`, as for the correction of sliding feet.
"""

from __future__ import annotations

import numpy as np

from training.config import FPS
from training.motion.foot_contact import contacts

SLIDE_SPEED = 0.2  # m/s, a foot in contact that is faster skates
UP, HORIZONTAL = 1, [0, 2]


def foot_skating(motion: np.ndarray) -> dict[str, float]:
    """Of a motion (T, 22, 3) metres, over the samples of both ankles and feet: contact_share, those in contact;
    skate_share, of these those that move faster than 0.2 m/s; slide_speed, the mean speed of these, m/s.

    Without any contact skate_share and slide_speed are NaN.
    """
    planted, speed = contacts(motion)
    sliding = speed[planted]
    return {
        "skate_share": float((sliding > SLIDE_SPEED).mean()) if len(sliding) else float("nan"),
        "slide_speed": float(sliding.mean()) if len(sliding) else float("nan"),
        "contact_share": float(planted.mean()),
    }


def physical_foot_contact(motion: np.ndarray) -> float:
    """PFC (EDGE, Tseng et al. 2023) of (T, 22, 3) metres, y up, 30 fps; lower is better, and it depends on T.

    1e4 * mean(min(v7, v10) * min(v8, v11) * a): v the horizontal metres per frame of ankle and foot of each
    side, a the root's acceleration without its falling part, divided by its largest value in the clip. It is
    large where the root accelerates without a foot to push from.
    """
    root = np.diff(motion[:, 0].astype(np.float64), n=2, axis=0) / (1 / FPS) ** 2
    root[:, UP] = np.maximum(root[:, UP], 0.0)
    acceleration = np.linalg.norm(root, axis=-1)
    largest = acceleration.max()
    if largest == 0:
        return 0.0
    feet = motion[:, [7, 10, 8, 11]].astype(np.float64)
    speed = np.linalg.norm(np.diff(feet, axis=0)[1:][..., HORIZONTAL], axis=-1)
    left, right = speed[:, :2].min(axis=1), speed[:, 2:].min(axis=1)
    return float((left * right * acceleration / largest).mean() * 1e4)
