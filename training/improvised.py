"""Pairs made from solo dances, for leaders from elsewhere.

Nobody answered a soloist. What an improviser would do is to mirror them: the soloist and their image in an
upright mirror that stays at arm's length ahead of them make a pair that never meets, whatever is danced.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import torch
from scipy.ndimage import gaussian_filter1d

from training.config import STRIDE, ConditionConfig, FrameConfig
from training.data.augment import mirror_motion
from training.data.duet import Duet, Solo
from training.frame import smoothed_heading
from training.hfsq.autoencoder import Autoencoder
from training.skeleton import MIRROR
from training.stage2_data import Clip, make_clip

# The mirror follows the soloist slowly, or the image would be thrown about by every turn and step.
HEADING = FrameConfig(sigma=30.0, radius=90)  # frames
FOLLOWING = 20.0  # frames, standard deviation
AHEAD = (0.38, 0.5)  # metres from the root to the mirror
YAW = 20.0  # degrees; the frame of reference is turned by up to this much


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


def improvised_clips(
    solos: Sequence[Solo],
    copies: int,
    hfsq: Autoencoder,
    frame: FrameConfig,
    config: ConditionConfig,
    seed: int,
) -> list[Clip]:
    """`copies` silent clips of every solo dance and of its mirror image, each with its own distance, grid offset
    and yaw.
    """
    random = np.random.default_rng(seed)
    clips: list[Clip] = []
    for solo in solos:
        for motion in [solo.motion, mirror_motion(solo.motion)] * copies:
            pair = improvised(Solo(solo.name, motion), random.uniform(*AHEAD))
            cut = int(random.integers(STRIDE))
            pair = Duet(pair.name, pair.leader[cut:], pair.reactor[cut:])
            yaw = np.radians(random.uniform(-YAW, YAW))
            clips.append(make_clip(pair, [], 0.0, hfsq, frame, config.leader_blur, yaw))
    return clips
