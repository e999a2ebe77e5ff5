"""Geometric features of poses that show them, and against the published rules."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d

from training.evaluation.metrics.geometric import (
    HIPS,
    HUMERUS,
    SHOULDERS,
    geometric_features,
    geometric_flags,
)
from training.evaluation.metrics.modes import Mode, feature_pose


def still(frames: int = 3) -> np.ndarray:
    """A T-pose, y up, left at +x, with its arms a little bent so that no direction is undefined."""
    pose = np.array(
        [
            (0, 0.95, 0), (0.09, 0.9, 0), (-0.09, 0.9, 0), (0, 1.05, 0), (0.09, 0.5, 0.02), (-0.09, 0.5,
            0.02), (0, 1.18, 0), (0.09, 0.08, 0), (-0.09, 0.08, 0), (0, 1.3, 0), (0.09, 0.02, 0.13), (-0.09,
            0.02, 0.13), (0, 1.45, 0), (0.07, 1.4, 0), (-0.07, 1.4, 0), (0, 1.55, 0), (0.18, 1.42, 0),
            (-0.18, 1.42, 0), (0.45, 1.42, 0), (-0.45, 1.42, 0), (0.7, 1.42, 0.01), (-0.7, 1.42, 0.01),
        ]
    )  # fmt: skip
    return np.repeat(pose[None], frames, axis=0)


def holds(motion: np.ndarray) -> set[int]:
    """Numbers, from 1, of the geometric features that hold in the second frame."""
    return {int(i) + 1 for i in np.flatnonzero(geometric_flags(motion, "corrected")[0])}


def test_a_still_t_pose_shows_the_poses_it_should():
    """9 holds as the wrists are 1.4 m apart, more than 2.5 shoulder widths, 24 and 25 as the arms stand off
    the trunk, 16 as the published plane through root, right hip and right toes faces back. No limb is bent
    (7, 8, 20, 21), and both hands are more than 1.2 humeri above the lowest joint (30, 31).
    """
    assert 2.5 * SHOULDERS < 1.4
    assert holds(still()) == {9, 16, 24, 25}


@pytest.mark.parametrize(
    ("joint", "where", "appears", "vanishes"),
    [
        (21, (-0.25, 1.6, 0.0), {7}, {9}),  # right wrist folded to the shoulder: elbow bent, wrists close
        (20, (0.25, 1.6, 0.0), {8}, {9}),
        (8, (-0.09, 0.6, -0.3), {20}, set()),  # right heel to the back: knee bent
        (7, (0.09, 0.6, -0.3), {21}, set()),
        (21, (-0.25, 0.25, 0.0), {30}, {9}),  # right hand near the floor
        (20, (0.25, 0.25, 0.0), {31}, {9}),
        (21, (-0.7, 1.51, 0.0), {3}, set()),  # right hand above the neck by more than 0.2 of a humerus
        (20, (0.7, 1.51, 0.0), {4}, set()),
        (8, (-0.09, 0.35, 0.0), {17}, set()),  # right foot lifted higher than 1.2 humeri above the other toes
        (7, (0.09, 0.35, 0.0), {18}, set()),
        (5, (-0.09, 0.9, 0.4), {26}, set()),  # right thigh level
        (4, (0.09, 0.9, 0.4), {27}, set()),
        (12, (0.0, 0.95, 0.5), {29}, set()),  # trunk level
    ],
)
def test_geometric_poses(joint, where, appears, vanishes):
    motion = still()
    motion[:, joint] = where
    changed = holds(motion)
    assert appears <= changed
    assert not vanishes & changed
    assert not appears & holds(still())


@pytest.mark.parametrize(
    ("joints", "feature", "threshold", "factor"),
    [((21,), 13, 2.5 * HUMERUS, 1), ((20,), 14, 2.5 * HUMERUS, 1), ((8,), 22, 2.5 * HUMERUS, 1),
     ((7,), 23, 2.5 * HUMERUS, 1), (tuple(range(22)), 32, 2.3 * HUMERUS, 1)],
)  # fmt: skip
def test_fast_joints_cross_their_threshold(joints, feature, threshold, factor):
    rates: dict[Mode, int] = {"corrected": 30, "paper": 120}
    for mode, rate in rates.items():
        for share, expected in ((0.99, False), (1.01, True)):
            motion = still()
            motion[1:, list(joints)] += np.array([0.0, 0.0, share * threshold / rate])
            assert geometric_flags(motion, mode)[0, feature - 1] == expected


@pytest.mark.parametrize(
    ("joint", "direction", "feature", "threshold"),
    [
        (21, (0, 0, -1), 1, 1.8 * HUMERUS),  # as published, the right hand counts going back ...
        (20, (0, 0, 1), 2, 1.8 * HUMERUS),  # ... and the left one going forward
        (9, (0, 1, 0), 5, 1.8 * HUMERUS),  # as published, 5 and 6 see chest against belly, not the wrists
        (9, (0, 1, 0), 6, 1.8 * HUMERUS),
        (21, (-1, 0, 0), 10, 1.4 * HUMERUS),  # the hands come apart
    ],
)
def test_geometric_moves(joint, direction, feature, threshold):
    for share, expected in ((0.98, False), (1.02, True)):
        motion = still()
        motion[1:, joint] += np.array(direction) * share * threshold / 30
        assert geometric_flags(motion, "corrected")[0, feature - 1] == expected


def test_ankles_apart_by_more_than_two_hips():
    for apart, expected in ((2.08, False), (2.12, True)):
        motion = still()
        motion[:, 7, 0], motion[:, 8, 0] = apart * HIPS / 2, -apart * HIPS / 2
        assert (19 in holds(motion)) == expected


PUBLISHED = """
nmove neck rhip lhip rwrist 1.8hl; nmove neck lhip rhip lwrist 1.8hl; nplane chest neck neck rwrist .2hl
nplane chest neck neck lwrist .2hl; move belly chest chest rwrist 1.8hl; move belly chest chest lwrist 1.8hl
angle relbow rshoulder relbow rwrist 0,110; angle lelbow lshoulder lelbow lwrist 0,110
nplane lshoulder rshoulder lwrist rwrist 2.5sw; move lwrist rwrist rwrist lwrist 1.4hl
move rwrist root lwrist root 1.4hl; move lwrist root rwrist root 1.4hl; fast rwrist 2.5hl; fast lwrist 2.5hl
plane root lhip ltoes rankle .38hl; plane root rhip rtoes lankle .38hl; nplane zero +y y_min rankle 1.2hl
nplane zero +y y_min lankle 1.2hl; nplane lhip rhip lankle rankle 2.1hw; angle rknee rhip rknee rankle 0,110
angle lknee lhip lknee lankle 0,110; fast rankle 2.5hl; fast lankle 2.5hl
angle neck root rshoulder relbow 25,180; angle neck root lshoulder lelbow 25,180
angle neck root rhip rknee 50,180; angle neck root lhip lknee 50,180; plane rankle neck lankle root .5hl
angle neck root zero +y 70,110; nplane zero -y y_min rwrist -1.2hl; nplane zero -y y_min lwrist -1.2hl
fast root 2.3hl
"""
POINTS = [
    "root", "lhip", "rhip", "belly", "lknee", "rknee", "spine", "lankle", "rankle", "chest", "ltoes", "rtoes",
    "neck", "linshoulder", "rinshoulder", "head", "lshoulder", "rshoulder", "lelbow", "relbow", "lwrist", "rwrist",
    "lhand", "rhand",
]  # fmt: skip
UNITS = {"hl": HUMERUS, "sw": SHOULDERS, "hw": HIPS}


def published_flag(rule: str, pose: np.ndarray, before: np.ndarray, rate: float) -> bool:
    """One printed rule on one frame, points and limits by name."""
    kind, *names, limit = rule.split()

    def points(frame: np.ndarray) -> list[np.ndarray]:
        special = {"zero": (0, 0, 0), "+y": (0, 1, 0), "-y": (0, -1, 0), "y_min": (0, frame[:, 1].min(), 0)}
        return [np.array(special[n], float) if n in special else frame[POINTS.index(n)] for n in names]

    def along(vector: np.ndarray, direction: np.ndarray) -> float:
        return float(vector @ direction / np.linalg.norm(direction))

    now, then = points(pose), points(before)
    if kind == "angle":
        a, b, c, d = now
        degrees = np.degrees(np.arccos(along(d - c, b - a) / np.linalg.norm(d - c)))
        low, high = map(float, limit.split(","))
        return low < degrees < high
    threshold = float(limit[:-2]) * UNITS[limit[-2:]]
    if kind == "fast":
        return float(np.linalg.norm(now[0] - then[0])) * rate > threshold
    a, b, c, d = now
    if kind == "nplane":
        return along(d - c, b - a) > threshold
    if kind == "move":
        return along((c - a) - (then[2] - then[0]), b - a) * rate > threshold
    normal = np.cross(c - a, b - a)
    if kind == "plane":
        return along(d - a, normal) > threshold
    return along((d - a) - (then[3] - then[0]), normal) * rate > threshold


def test_all_geometric_features_as_published():
    rules = [rule for line in PUBLISHED.strip().splitlines() for rule in line.split("; ")]
    assert len(rules) == 32
    rates: dict[Mode, int] = {"corrected": 30, "paper": 120}
    for mode, rate in rates.items():
        noise = np.random.default_rng(8).normal(size=(400, 22, 3))
        motion = 0.5 * still(1) + 1.5 * gaussian_filter1d(noise, 8, axis=0)
        pose = feature_pose(motion, mode)
        expected = [
            [published_flag(r, pose[i], pose[i - 1], rate) for r in rules] for i in range(1, len(pose))
        ]
        flags = geometric_flags(motion, mode)
        assert (flags == np.array(expected)).all()
    varied = set(np.flatnonzero(flags.any(axis=0) & ~flags.all(axis=0)))
    assert len(varied) > 20  # the comparison saw both answers of most features


def test_geometric_features_are_shares():
    motion = np.concatenate([still(2), still(2)])
    motion[2:, 21] = (-0.3, 1.6, 0.0)  # bent in two of the three frames that count
    assert geometric_features(motion, "corrected")[6] == pytest.approx(2 / 3)
