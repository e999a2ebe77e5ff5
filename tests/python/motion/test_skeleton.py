"""The measure by which dancers are scaled to one another."""

from __future__ import annotations

import numpy as np
import pytest

from training.motion.skeleton import JOINTS, PARENTS, body_height


def test_the_height_is_that_of_the_mean_leg_and_the_spine_whatever_the_pose() -> None:
    lengths = {"left_knee": 0.44, "right_knee": 0.4, "left_ankle": 0.38, "right_ankle": 0.38}
    lengths |= {"spine1": 0.11, "spine2": 0.12, "spine3": 0.13, "neck": 0.14, "head": 0.15}
    random = np.random.default_rng(0)
    motion = np.zeros((5, len(JOINTS), 3))
    for joint, name in enumerate(JOINTS[1:], 1):
        way = random.normal(size=(5, 3))
        way *= lengths.get(name, 0.2) / np.linalg.norm(way, axis=-1, keepdims=True)
        motion[:, joint] = motion[:, PARENTS[joint]] + way
    for frames in (motion, motion[:1]):
        assert body_height(frames) == pytest.approx((0.44 + 0.4) / 2 + 0.38 + 0.65)
