"""Feet, seams, penetration and bones against motions whose answer is known by construction."""

from __future__ import annotations

import numpy as np
import pytest

from training.evaluation.metrics.bones import bone_variation
from training.evaluation.metrics.contact import foot_skating, physical_foot_contact
from training.evaluation.metrics.penetration import (
    CAPSULES,
    RADII,
    REFERENCE_HEIGHT,
    depth,
    penetration,
    segment_distance,
)
from training.evaluation.metrics.seams import (
    boundaries,
    paper_jitter,
    seam_ratio,
    seam_sample,
    velocity_change,
)
from training.motion.skeleton import JOINTS, body_height


def rest_pose() -> np.ndarray:
    """A T-pose (22, 3) standing on y = 0, left at +x, facing +z."""
    half = {
        "pelvis": (0, 0.95, 0), "left_hip": (0.09, 0.9, 0), "left_knee": (0.09, 0.5, 0),
        "left_ankle": (0.09, 0.08, 0), "left_foot": (0.09, 0.02, 0.13), "spine1": (0, 1.05, 0),
        "spine2": (0, 1.18, 0), "spine3": (0, 1.25, 0), "neck": (0, 1.45, 0), "head": (0, 1.55, 0),
        "left_collar": (0.07, 1.4, 0), "left_shoulder": (0.18, 1.42, 0), "left_elbow": (0.45, 1.42, 0),
        "left_wrist": (0.7, 1.42, 0),
    }  # fmt: skip
    pose = np.zeros((22, 3))
    for index, name in enumerate(JOINTS):
        x, y, z = half[name.replace("right", "left")]
        pose[index] = (-x if name.startswith("right") else x, y, z)
    return pose


def standing(frames: int) -> np.ndarray:
    return np.repeat(rest_pose()[None], frames, axis=0)


def test_a_known_slide_skates():
    motion = standing(301)
    frame = np.arange(301)
    motion[:, [7, 10], 0] += 0.01 * frame[:, None]  # left foot: 0.3 m/s along x, planted
    motion[:, [8, 11], 2] += 0.005 * frame[:, None]  # right foot: 0.15 m/s along z, planted
    result = foot_skating(motion)
    assert result["contact_share"] == pytest.approx(1.0)
    assert result["skate_share"] == pytest.approx(0.5)
    assert result["slide_speed"] == pytest.approx((0.3 + 0.15) / 2)


def test_lifted_and_falling_feet_are_not_in_contact():
    motion = standing(400)
    motion[200:300, [7, 10], 1] += 0.031  # left foot above the height
    motion[:, [8, 11], 1] += np.where(np.arange(400) % 2 == 0, 0.0, 0.01)[:, None]  # right foot at 0.3 m/s
    assert foot_skating(motion)["contact_share"] == pytest.approx((399 - 101) / 399 / 2)
    motion[200:300, [7, 10], 1] -= 0.002  # now below it
    assert foot_skating(motion)["contact_share"] == pytest.approx((399 - 2) / 399 / 2)
    floating = standing(100)
    floating[:, :, 1] += 0.2 * np.arange(100)[:, None]
    nothing = foot_skating(floating)
    assert nothing["contact_share"] == 0.0
    assert np.isnan(nothing["skate_share"])
    assert np.isnan(nothing["slide_speed"])


def test_contact_is_against_each_joints_own_floor():
    assert foot_skating(standing(50) + np.array([0.0, 1.0, 0.0]))["contact_share"] == pytest.approx(1.0)


def test_pfc_by_hand():
    motion = standing(5)
    motion[:, 0, 0] += np.array([0.0, 0.0, 0.01, 0.01, 0.01])  # accelerations 0.01, -0.01, 0
    motion[:, [7, 10], 0] += np.arange(5)[:, None] * np.array([0.03, 0.02])  # smaller on the left: 0.02
    motion[:, [8, 11], 2] += np.arange(5)[:, None] * np.array([0.05, 0.04])  # smaller on the right: 0.04
    motion[:, [7, 10, 8, 11], 1] += 0.5 * np.arange(5)[:, None]  # heights do not count
    assert physical_foot_contact(motion) == pytest.approx(1e4 * 0.02 * 0.04 * (1 + 1 + 0) / 3)
    assert physical_foot_contact(standing(9)) == 0.0


def test_pfc_does_not_count_falling():
    motion = standing(4)
    motion[:, 0, 1] += np.array([0.0, 0.0, 0.01, 0.01])  # up, then down
    motion[:, [7, 10, 8, 11], 0] += 0.02 * np.arange(4)[:, None]
    assert physical_foot_contact(motion) == pytest.approx(1e4 * 0.02**2 * (1 + 0) / 2)


def smooth(frames: int, seed: int = 0) -> np.ndarray:
    phase = np.random.default_rng(seed).uniform(0, 2 * np.pi, (1, 22, 3))
    return 0.1 * np.sin(2 * np.pi * np.arange(frames)[:, None, None] / 30 + phase)


def test_velocity_change_of_a_parabola():
    motion = np.arange(20.0)[:, None, None] ** 2 * np.array([0.003, 0.0, 0.004]) / 2 * np.ones((1, 22, 1))
    change = velocity_change(motion)
    assert np.isnan(change[[0, -1]]).all()
    assert change[1:-1] == pytest.approx(np.full(18, 5.0))


def test_a_jump_at_the_boundary_is_a_seam_and_between_two_it_is_not():
    truth = smooth(1000)
    seams = boundaries(1000)
    assert list(seams) == [240, 480, 720, 960]
    assert list(boundaries(500, first=120)) == [120, 360]
    same = seam_ratio([seam_sample(truth, truth, seams)])
    assert same == pytest.approx({"seams": 4, "ratio": 1.0, "own": 1.0})
    jump = truth.copy()
    jump[240:, :, 1] += 0.05  # between frames 239 and 240
    assert seam_ratio([seam_sample(truth, jump, seams)])["ratio"] > 2
    between = truth.copy()
    # Changes frames 242 and 243; the window of the seam at 240 ends with frame 241.
    between[243:, :, 1] += 0.05
    assert seam_ratio([seam_sample(truth, between, seams)])["ratio"] == pytest.approx(1.0)


def test_seams_of_many_motions_add_up_by_frames():
    truth = smooth(500)
    still = np.zeros_like(truth)
    samples = [seam_sample(truth, truth, boundaries(500)), seam_sample(truth, still, boundaries(500))]
    result = seam_ratio(samples)
    assert result["seams"] == 4
    assert result["ratio"] == pytest.approx(0.5)
    assert result["own"] == pytest.approx(1.0)
    slow = seam_ratio([seam_sample(truth, 0.5 * truth, boundaries(500))])
    assert (slow["ratio"], slow["own"]) == pytest.approx((0.5, 1.0))


def test_paper_jitter_sees_thirty_frames():
    motion = np.zeros((600, 22, 3))
    motion[271:, :, 0] = 0.06  # changes frames 270 and 271, 30.5 frames and more from a boundary at 240
    assert paper_jitter(motion, np.array([240])) == 0.0
    motion[270, :, 0] = 0.06  # changes frames 269 and 270: of the 60 frames 210..269, one changes by 60 mm
    assert paper_jitter(motion, np.array([240])) == pytest.approx(60 / 60)


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
