"""Foot contact: the definition that the measures and the foot-contact correction share.

It does not ask for horizontal speed, since feet that slide are to be found and corrected. The contact loss of stage 2
asks for something else, feet that stand still, and has a threshold of its own (docs/paper.md).
"""

from __future__ import annotations

import numpy as np

from training.config import FPS
from training.motion.skeleton import FEET

PERCENTILE = 5.0  # of a foot joint's own heights: where it rests
HEIGHT = 0.03  # metres above that
VERTICAL_SPEED = 0.1  # m/s, a planted foot is slower


def contacts(motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Contact (T-1, 4) bool and horizontal speed (T-1, 4) m/s of both ankles and feet of (T, 22, 3), y up.

    Measured against each joint's own 5th percentile of height, so neither the floor nor the foot's
    thickness matters.
    """
    feet = motion[:, list(FEET)].astype(np.float64)
    velocity = np.diff(feet, axis=0) * FPS
    low = feet[:-1, :, 1] < np.percentile(feet[:, :, 1], PERCENTILE, axis=0) + HEIGHT
    planted = low & (np.abs(velocity[..., 1]) < VERTICAL_SPEED)
    return planted, np.linalg.norm(velocity[..., [0, 2]], axis=-1)
