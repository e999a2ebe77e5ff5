"""Pairs made from solo dances, for leaders from elsewhere.

Nobody answered a soloist. What an improviser would do is to mirror them: the soloist and their image in an
upright mirror that stays at arm's length ahead of them make a pair that never meets, whatever is danced.
"""

from __future__ import annotations

import numpy as np
import torch
from scipy.ndimage import gaussian_filter1d

from training.config import FrameConfig
from training.data.duet import Duet, Solo
from training.motion.leader_frame import smoothed_heading
from training.motion.skeleton import MIRROR

# The mirror follows the soloist slowly, or the image would be thrown about by every turn and step.
HEADING = FrameConfig(sigma=30.0, radius=90)  # frames
FOLLOWING = 20.0  # frames, standard deviation
AHEAD = (0.38, 0.5)  # metres from the root to the mirror


def improvised(solo: Solo, ahead: float) -> Duet:
    """The soloist as leader and their image in a mirror `ahead` metres before them as reactor."""
    motion = solo.motion
    heading = smoothed_heading(torch.from_numpy(motion), HEADING).numpy()
    normal = np.stack([heading[:, 0], np.zeros(len(heading)), heading[:, 1]], axis=1)
    place = gaussian_filter1d(motion[:, 0] * [1, 0, 1], FOLLOWING, axis=0, mode="nearest")
    mirror = (place + normal * ahead)[:, None]
    before = ((motion - mirror) * normal[:, None]).sum(axis=-1, keepdims=True)
    image = (motion - 2 * before * normal[:, None])[:, list(MIRROR)]
    return Duet(solo.name, motion, image.astype(np.float32))
