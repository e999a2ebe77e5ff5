"""Pairs made from solo dances, so that a model is trained on leaders of other dances.

The reactor of a pair is the soloist's mirror image in an upright plane ahead of the soloist, so that the two do not
overlap.
"""

from __future__ import annotations

import numpy as np
import torch
from scipy.ndimage import gaussian_filter1d

from training.config import FrameConfig
from training.data.duet import Duet, Solo
from training.motion.leader_frame import smoothed_heading
from training.motion.skeleton import MIRROR

# The plane follows the soloist slowly, so that single turns and steps do not move the mirror image far.
PLANE_HEADING = FrameConfig(sigma=30.0, radius=90)  # frames
PLACE_SIGMA_FRAMES = 20.0
AHEAD = (0.38, 0.5)  # metres from the root to the plane, least and most


def solo_pair(solo: Solo, ahead: float) -> Duet:
    """The soloist as leader, and as reactor the mirror image in a plane `ahead` metres ahead of the root."""
    motion = solo.motion
    heading = smoothed_heading(torch.from_numpy(motion), PLANE_HEADING).numpy()
    normal = np.stack([heading[:, 0], np.zeros(len(heading)), heading[:, 1]], axis=1)
    place = gaussian_filter1d(motion[:, 0] * [1, 0, 1], PLACE_SIGMA_FRAMES, axis=0, mode="nearest")
    plane = (place + normal * ahead)[:, None]
    depth = ((motion - plane) * normal[:, None]).sum(axis=-1, keepdims=True)
    reflection = (motion - 2 * depth * normal[:, None])[:, list(MIRROR)]
    return Duet(solo.name, motion, reflection.astype(np.float32))
