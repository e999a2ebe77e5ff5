"""Kinetic features against loops written from their definition, and the pose that features are made of."""

from __future__ import annotations

import numpy as np
import pytest

from tests.python.support.bodies import random_walk
from training.evaluation.metrics.kinetic import kinetic_features
from training.evaluation.metrics.modes import Mode, feature_pose


def test_feature_pose_starts_at_the_root_and_repeats_the_wrists():
    motion = random_walk()
    pose = feature_pose(motion, "corrected")
    assert pose[0, 0] == pytest.approx([0.0, 0.0, 0.0])
    assert pose[:, 22:] == pytest.approx(pose[:, 20:22])
    assert pose[5, 3] == pytest.approx(motion[5, 3] - motion[0, 0])
    z_up = feature_pose(motion, "paper")
    assert z_up[5, 3] == pytest.approx(pose[5, 3] @ np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]]))


def kinetic_by_loop(motion: np.ndarray, mode: Mode) -> np.ndarray:
    """The definition read aloud: sums over frames and window terms, no prefix sums."""
    pose = feature_pose(motion, mode)
    time = 1 / 60 if mode == "paper" else 1 / 30
    frames = len(pose)
    result = []
    for joint in range(24):
        p = pose[:, joint]
        horizontal = vertical = expenditure = 0.0
        for i in range(1, frames):
            terms: list[np.ndarray] = [
                p[i + k] - p[i + k - 1] for k in range(-2, 3) if i + k - 1 >= 0 and i + k < frames
            ]
            velocity = np.sum(terms, axis=0) / (len(terms) * time)
            horizontal += velocity[0] ** 2 + velocity[2] ** 2
            vertical += velocity[1] ** 2
            terms = []
            for k in range(-2, 3):
                if i + k - 1 >= 0 and i + k + 1 < frames:
                    after = (p[i + k + 1] - p[i + k]) / time
                    before = (p[i + k] - p[i + k - 1]) / time
                    if mode == "paper":
                        before = p[i + k] - p[i + k - 1] / time
                    terms.append((after - before) / time)
            expenditure += float(np.linalg.norm(np.mean(terms, axis=0)))
        result += [value / (frames - 1) for value in (horizontal, vertical, expenditure)]
    return np.array(result)


@pytest.mark.parametrize("mode", ["paper", "corrected"])
def test_kinetic_features_by_their_definition(mode):
    motion = random_walk()
    features = kinetic_features(motion, mode)
    assert features.shape == (72,)
    assert features == pytest.approx(kinetic_by_loop(motion, mode))


def test_kinetic_features_of_steady_motion():
    frame = np.arange(50)[:, None, None]
    walk = np.zeros((50, 22, 3)) + frame * np.array([0.03, 0.01, 0.04])
    features = kinetic_features(walk, "corrected").reshape(24, 3)
    assert features == pytest.approx(np.tile([1.5**2, 0.3**2, 0.0], (24, 1)), abs=1e-9)
    # The benchmark's world stands on its side and lasts half as long: its y is our -z.
    paper = kinetic_features(walk, "paper").reshape(24, 3)
    assert paper[:, 0] == pytest.approx(np.full(24, 1.8**2 + 0.6**2))
    assert paper[:, 1] == pytest.approx(np.full(24, 2.4**2))
