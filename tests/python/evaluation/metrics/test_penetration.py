"""Overlaps of two bodies at known distances, and bones that stretch."""

from __future__ import annotations

import numpy as np
import pytest

import training.evaluation.metrics.penetration as measured
from tests.python.support.bodies import standing
from training.data.made import made_dancer
from training.evaluation.metrics.errors import bone_variation
from training.evaluation.metrics.penetration import (
    CAPSULES,
    RADII,
    REFERENCE_HEIGHT,
    capsules,
    depth,
    penetration,
    segment_distance,
)
from training.motion.skeleton import JOINTS, body_height


@pytest.mark.parametrize(
    ("p0", "p1", "q0", "q1", "expected"),
    [
        ((0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), 1.0),  # parallel
        ((0, 0, 0), (1, 0, 0), (0.5, -1, 0.3), (0.5, 1, 0.3), 0.3),  # crossing
        ((0, 0, 0), (1, 0, 0), (4, 4, 0), (4, 9, 0), 5.0),  # ends
        ((0, 0, 0), (0, 0, 0), (0, 0, 2), (0, 0, 2), 2.0),  # two points
        ((0, 0, 0), (1, 0, 0), (0.25, 0, 2), (0.25, 0, 2), 2.0),  # a point beside a segment
        ((0.25, 0, 2), (0.25, 0, 2), (0, 0, 0), (1, 0, 0), 2.0),
        ((0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0), 1.0),  # one line
    ],
)
def test_segment_distance(p0, p1, q0, q1, expected: float):
    rows = [np.array([point], dtype=float) for point in (p0, p1, q0, q1)]
    assert segment_distance(*rows) == pytest.approx([expected])


def test_segment_distance_against_brute_force():
    random = np.random.default_rng(3)
    p0, p1, q0, q1 = random.normal(size=(4, 40, 3))
    grid = np.linspace(0, 1, 101)
    p = p0[:, None] + (p1 - p0)[:, None] * grid[:, None]
    q = q0[:, None] + (q1 - q0)[:, None] * grid[:, None]
    brute = np.linalg.norm(p[:, :, None] - q[:, None], axis=-1).min(axis=(1, 2))
    assert segment_distance(p0, p1, q0, q1) == pytest.approx(brute, abs=0.02)
    assert (segment_distance(p0, p1, q0, q1) <= brute + 1e-9).all()


def test_the_skull_begins_at_the_head():
    leader = made_dancer(30, 1)
    skull = next(i for i, (_, _, _, beyond) in enumerate(CAPSULES) if beyond > 0)
    start, end = capsules(leader)
    neck, head = (leader[:, JOINTS.index(name)] for name in ("neck", "head"))
    assert start[:, skull] == pytest.approx(head, abs=1e-6)
    assert end[:, skull] == pytest.approx(head + 0.6 * (head - neck), abs=1e-6)


def test_shares_and_percentiles_of_the_depth(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(measured, "depth", lambda leader, reactor: np.arange(101) / 1000)
    expected = {"ipr_capsules": 90 / 101, "depth_p50_mm": 50.0, "depth_p95_mm": 95.0}
    assert penetration(standing(1), standing(1)) == pytest.approx(expected)


def test_two_upper_arms_overlap_by_what_is_missing():
    """Two dancers back to back, arms spread: their arms and trunks are parallel capsules a known distance
    apart.
    """
    leader = standing(1)
    scale = body_height(leader) / REFERENCE_HEIGHT
    widest = RADII.max() * scale  # the trunk
    for apart in (0.1, 0.15, 0.3):
        reactor = leader @ np.diag([-1.0, 1.0, -1.0]) - np.array([0.0, 0.0, apart])
        assert depth(leader, reactor) == pytest.approx([max(2 * widest - apart, 0.0)])


def test_penetration_counts_only_deep_frames():
    leader = standing(4)
    widest = 2 * RADII.max() * body_height(leader) / REFERENCE_HEIGHT
    reactor = leader @ np.diag([-1.0, 1.0, -1.0])
    for frame, overlap in enumerate((-0.5, 0.009, 0.011, 0.05)):
        reactor[frame, :, 2] -= widest - overlap
    result = penetration(leader, reactor)
    assert result["ipr_capsules"] == pytest.approx(0.5)
    assert result["depth_p50_mm"] == pytest.approx(10.0)


def test_hands_may_touch():
    """In an open hold, wrist against wrist at arm's length, nothing penetrates."""
    leader = standing(1)
    leader[0, 20:22] = [(0.05, 1.1, 0.4), (-0.05, 1.1, 0.4)]
    leader[0, 18:20] = [(0.2, 1.15, 0.2), (-0.2, 1.15, 0.2)]
    reactor = leader @ np.diag([-1.0, 1.0, -1.0]) + np.array([0.0, 0.0, 0.88])
    assert penetration(leader, reactor)["ipr_capsules"] == 0.0
    assert {name for row in CAPSULES for name in row[:2]} <= set(JOINTS)


def test_bone_variation_of_one_stretching_bone():
    motion = standing(100)
    assert bone_variation(motion) == pytest.approx(0.0, abs=1e-12)
    motion[::2, 20, 0] += 0.025  # the left forearm, 0.25 m, is 0.275 m every other frame
    assert bone_variation(motion) == pytest.approx((0.0125 / 0.2625) / 21)


def test_no_overlap_of_any_two_capsules_is_missed():
    """Against all pairs: legs and arms also cross in their middles, far from the bones' ends."""
    leader, reactor = made_dancer(40, 1), made_dancer(40, 2)
    reactor = reactor + (leader[:, :1] - reactor[:, :1]) * np.array([1, 0, 1]) + np.array([0.25, 0, 0.1])
    (a0, a1), (b0, b1) = capsules(leader), capsules(reactor)
    radii = [RADII * body_height(each) / REFERENCE_HEIGHT for each in (leader, reactor)]
    expected = np.zeros(40)
    for i in range(len(RADII)):
        for j in range(len(RADII)):
            apart = segment_distance(a0[:, i], a1[:, i], b0[:, j], b1[:, j])
            expected = np.maximum(expected, radii[0][i] + radii[1][j] - apart)
    assert depth(leader, reactor) == pytest.approx(expected)
    assert (expected > 0.02).sum() > 10
