"""Foot skating: how much planted feet slide, and how often feet are planted at all."""

from __future__ import annotations

import numpy as np

from training.motion.foot_contact import contacts

SLIDE_SPEED = 0.2  # m/s, a planted foot that is faster skates


def foot_skating(motion: np.ndarray, fps: float = 30.0) -> dict[str, float]:
    """skate_share of contact samples that slide faster than 0.2 m/s, mean slide in contact (m/s),
    contact_share.

    Without any contact there is nothing to slide: both slides are NaN, and contact_share says why.
    """
    planted, speed = contacts(motion, fps)
    sliding = speed[planted]
    return {
        "skate_share": float((sliding > SLIDE_SPEED).mean()) if len(sliding) else float("nan"),
        "slide_speed": float(sliding.mean()) if len(sliding) else float("nan"),
        "contact_share": float(planted.mean()),
    }
