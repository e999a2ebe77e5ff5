"""Errors, speeds and distances against values worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest

from training.evaluation.metrics import quick_report
from training.evaluation.metrics.distance import bearing, facing, hand_distance, root_distance, wasserstein
from training.evaluation.metrics.errors import mpjpe, mpjve, root_error, root_error_by_distance
from training.evaluation.metrics.speed import band_decibels, band_power, joint_acceleration, joint_speed
from training.motion.heading import heading


def still(frames: int = 61) -> np.ndarray:
    """A body of distinct joints that does not move; the left side is at +x, so it faces +z."""
    body = np.random.default_rng(0).normal(scale=0.3, size=(22, 3))
    for left, right, half in ((1, 2, 0.1), (16, 17, 0.2)):
        body[left], body[right] = (half, 1.0, 0.0), (-half, 1.0, 0.0)
    return np.repeat(body[None], frames, axis=0)


def turned(motion: np.ndarray, degrees: float) -> np.ndarray:
    """Turned to the left about the vertical axis through the origin."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return motion @ np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]).T


def test_mpjpe_ignores_the_place_and_counts_every_joint():
    truth, generated = still(), still() + np.array([3.0, 0.0, -2.0])
    assert mpjpe(truth, generated) == pytest.approx(0.0, abs=1e-9)
    generated[:, 5, 1] += 0.022  # one joint of 22, 22 mm
    assert mpjpe(truth, generated) == pytest.approx(1.0)


def test_mpjve_is_per_frame():
    truth, generated = still(), still()
    generated[:, 7, 2] += 0.022 * np.arange(61)  # 22 mm per frame on one joint of 22
    assert mpjve(truth, generated) == pytest.approx(1.0)
    assert mpjve(truth, generated + 0.1 * np.arange(61)[:, None, None]) == pytest.approx(1.0)


def test_root_error_is_seen_from_the_leader():
    leader, truth = still(), still() + np.array([0.6, 0.0, 0.0])
    generated = truth + np.array([0.03, 0.0, 0.04])
    assert root_error(leader, truth, generated) == pytest.approx(50.0)
    # The same couple somewhere else in the room makes the same error.
    assert root_error(leader, truth, generated + 5.0, leader + 5.0) == pytest.approx(50.0)


def test_root_error_splits_by_the_true_distance():
    leader, truth, generated = still(40), still(40), still(40)
    for block, (distance, error) in enumerate(((0.3, 0.1), (0.7, 0.2), (1.0, 0.3), (2.0, 0.4))):
        rows = slice(10 * block, 10 * block + 10)
        truth[rows, :, 0] += distance
        generated[rows, :, 0] += distance + error
    split = root_error_by_distance(leader, truth, generated)
    assert list(split) == ["0-0.4 m", "0.4-0.8 m", "0.8-1.2 m", ">1.2 m"]
    assert list(split.values()) == pytest.approx([100.0, 200.0, 300.0, 400.0])


def test_motions_of_unequal_length_are_refused():
    with pytest.raises(ValueError, match="same number of frames"):
        mpjpe(still(10), still(9))


def test_speed_and_acceleration_of_known_paths():
    time = np.arange(61)[:, None, None] / 30
    assert joint_speed(still() + time * np.array([0.6, 0.0, 0.8])) == pytest.approx(1.0)
    assert joint_acceleration(still() + 0.5 * time**2 * np.array([0.0, 3.0, 4.0])) == pytest.approx(5.0)


@pytest.mark.parametrize(("hertz", "band"), [(0.5, 0), (2.0, 1), (4.0, 2), (10.0, 3)])
def test_band_power_finds_a_sine(hertz: float, band: int):
    frames = 601
    motion = still(frames)
    motion[:, :, 1] += np.sin(2 * np.pi * hertz * np.arange(frames) / 30)[:, None]
    power = band_power(motion)
    speed = np.diff(motion, axis=0) * 30
    assert power[band] == pytest.approx((speed**2).sum(axis=-1).mean(), rel=0.01)
    assert np.delete(power, band) == pytest.approx(np.zeros(3), abs=1e-6 * power[band])


def test_travelling_does_not_leak_into_the_quick_bands():
    """A walk that speeds up ends faster than it began; nothing in it is quicker than 1 Hz."""
    motion = still(601)
    motion[:, :, 0] += (np.arange(601)[:, None] / 30) ** 2 / 20
    power = band_power(motion)
    assert power[3] < 1e-9 * power[0]


def test_doubling_a_motion_is_six_decibels():
    motion = np.cumsum(np.random.default_rng(1).normal(size=(200, 22, 3)), axis=0)
    assert list(band_decibels(motion, 2 * motion).values()) == pytest.approx([20 * np.log10(2)] * 4)


def test_heading_facing_and_bearing():
    leader = still()
    assert heading(leader)[0] == pytest.approx([0.0, 1.0])
    assert heading(turned(leader, 90))[0] == pytest.approx([1.0, 0.0], abs=1e-9)
    partner = turned(leader, 180)
    partner += leader[:, :1] + np.array([0.0, 0.0, 0.7]) - partner[:, :1]
    assert facing(leader, partner) == pytest.approx(np.full(61, 180.0))
    assert facing(leader, turned(leader, 30)) == pytest.approx(np.full(61, 30.0))
    assert bearing(leader, partner) == pytest.approx(np.zeros(61), abs=1e-5)
    assert bearing(leader, leader + np.array([0.0, 0.0, -1.0])) == pytest.approx(np.full(61, 180.0))
    assert root_distance(leader, partner) == pytest.approx(np.full(61, 0.7))


def test_nearest_hands_of_four_pairs():
    leader, reactor = still(), still()
    leader[:, 20], leader[:, 21] = (0.0, 1.0, 0.0), (1.0, 1.0, 0.0)
    reactor[:, 20], reactor[:, 21] = (5.0, 1.0, 0.0), (1.0, 1.3, 0.4)
    assert hand_distance(leader, reactor) == pytest.approx(np.full(61, 0.5))


def test_wasserstein_of_a_shift_is_the_shift():
    sample = np.random.default_rng(2).normal(size=500)
    assert wasserstein(sample, sample + 0.25) == pytest.approx(0.25)


def test_quick_report():
    time = np.arange(61)[:, None, None] / 30
    leader = still()
    truth = still() + np.array([0.0, 0.0, 0.5]) + time * np.array([0.0, 1.0, 0.0])
    generated = still() + np.array([0.0, 0.0, 1.0]) + time * np.array([0.0, 0.5, 0.0])
    report = quick_report(leader, truth, generated)
    offset = np.array([0.0, 0.0, 0.5]) - time[:, 0] * np.array([0.0, 0.5, 0.0])
    distances = [np.median(np.hypot(d, time[:, 0, 0] * v)) for d, v in ((1.0, 0.5), (0.5, 1.0))]
    assert report["mpjpe_mm"] == pytest.approx(0.0, abs=1e-9)
    assert report["root_error_mm"] == pytest.approx(1000 * np.linalg.norm(offset, axis=-1).mean())
    assert report["speed_ratio"] == pytest.approx(0.5)
    assert report["distance_ratio"] == pytest.approx(distances[0] / distances[1])
