"""How two bodies stand to each other, against values worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest

from tests.python.support.bodies import random_body, random_walk, turned
from training.evaluation.metrics.distance import (
    CROSS_JOINTS,
    cross_distances,
    facing,
    hand_distance,
    hands_held,
    root_distance,
    wasserstein,
)
from training.motion.heading import heading
from training.motion.skeleton import JOINTS


def test_heading_facing_and_root_distance():
    leader = random_body()
    assert heading(leader)[0] == pytest.approx([0.0, 1.0])
    assert heading(turned(leader, 90))[0] == pytest.approx([1.0, 0.0], abs=1e-9)
    partner = turned(leader, 180)
    partner += leader[:, :1] + np.array([0.0, 0.0, 0.7]) - partner[:, :1]
    assert facing(leader, partner) == pytest.approx(np.full(61, 180.0))
    assert facing(leader, turned(leader, 30)) == pytest.approx(np.full(61, 30.0))
    assert np.isfinite(facing(random_walk(600), random_walk(600))).all(), (
        "also where both face exactly the same way"
    )
    assert root_distance(leader, partner) == pytest.approx(np.full(61, 0.7))


def test_heading_is_that_of_hips_and_shoulders_together():
    body = random_body()
    body[:, 16], body[:, 17] = (0.0, 1.4, -0.1), (0.0, 1.4, 0.1)  # twisted to the left, as wide as the hips
    assert heading(body)[0] == pytest.approx(np.array([1.0, 1.0]) / np.sqrt(2))


def test_nearest_hands_of_four_pairs():
    leader, reactor = random_body(), random_body()
    leader[:, 20], leader[:, 21] = (0.0, 1.0, 0.0), (1.0, 1.0, 0.0)
    reactor[:, 20], reactor[:, 21] = (5.0, 1.0, 0.0), (1.0, 1.3, 0.4)
    assert hand_distance(leader, reactor) == pytest.approx(np.full(61, 0.5))


def test_hands_are_held_where_wrists_are_near_and_go_together():
    leader, reactor = random_walk(90), random_walk(90, seed=1)
    leader[:, 20:22] = leader[:, :1] + np.array([[0.3, 0.2, 0.0], [-5.0, 0.0, 0.0]])
    reactor[:, 20:22] = leader[:, 20:22] + np.array([[0.3, 0.0, 0.0], [9.0, 0.0, 0.0]])
    assert hands_held(leader, reactor) == 1.0
    reactor[45:, 20, 1] += 0.5
    assert hands_held(leader, reactor) == pytest.approx(0.5, abs=0.03), "too far away in the second half"
    reactor[45:, 20] = leader[45:, 20]
    reactor[45:, 20, 1] += 0.3 * np.sin(np.arange(45) * 0.8)
    assert hands_held(leader, reactor) == pytest.approx(0.5, abs=0.12), "near, but to and fro"


def test_wasserstein_of_a_shift_is_the_shift():
    sample = np.random.default_rng(2).normal(size=500)
    assert wasserstein(sample, sample + 0.25) == pytest.approx(0.25)


def test_cross_distances_are_of_the_ten_joints_of_the_benchmark():
    names = "pelvis left_ankle right_ankle left_foot right_foot head"
    names += " left_shoulder right_shoulder left_wrist right_wrist"
    assert [JOINTS[joint] for joint in CROSS_JOINTS] == names.split()


def test_cross_distances():
    leader, reactor = random_walk(10), random_walk(10, seed=5)
    features = cross_distances(leader, reactor).reshape(10, 10)
    for i, a in enumerate(CROSS_JOINTS):
        for j, b in enumerate(CROSS_JOINTS):
            expected = np.linalg.norm(reactor[:, a] - leader[:, b], axis=-1).mean()
            assert features[i, j] == pytest.approx(expected)
