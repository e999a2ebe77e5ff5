"""Speeds and energy by frequency of known paths."""

from __future__ import annotations

import numpy as np
import pytest

from tests.python.support.bodies import random_body
from training.evaluation.metrics.speed import band_decibels, band_power, joint_acceleration, joint_speed


def test_speed_and_acceleration_of_known_paths():
    time = np.arange(61)[:, None, None] / 30
    assert joint_speed(random_body() + time * np.array([0.6, 0.0, 0.8])) == pytest.approx(1.0)
    assert joint_acceleration(random_body() + 0.5 * time**2 * np.array([0.0, 3.0, 4.0])) == pytest.approx(5.0)


@pytest.mark.parametrize(("hertz", "band"), [(0.5, 0), (2.0, 1), (4.0, 2), (10.0, 3)])
def test_band_power_finds_a_sine(hertz: float, band: int):
    frames = 601
    motion = random_body(frames)
    motion[:, :, 1] += np.sin(2 * np.pi * hertz * np.arange(frames) / 30)[:, None]
    power = band_power(motion)
    speed = np.diff(motion, axis=0) * 30
    assert power[band] == pytest.approx((speed**2).sum(axis=-1).mean(), rel=0.01)
    assert np.delete(power, band) == pytest.approx(np.zeros(3), abs=1e-6 * power[band])


def test_travelling_does_not_leak_into_the_quick_bands():
    """A walk that speeds up ends faster than it began; nothing in it is quicker than 1 Hz."""
    motion = random_body(601)
    motion[:, :, 0] += (np.arange(601)[:, None] / 30) ** 2 / 20
    power = band_power(motion)
    assert power[3] < 1e-9 * power[0]


def test_doubling_a_motion_is_six_decibels():
    motion = np.cumsum(np.random.default_rng(1).normal(size=(200, 22, 3)), axis=0)
    assert list(band_decibels(motion, 2 * motion).values()) == pytest.approx([20 * np.log10(2)] * 4)


@pytest.mark.parametrize("frames", [121, 122])
def test_all_bands_together_are_the_squared_speed(frames: int):
    """Of an even travel, and of a flicker from frame to frame, which is at the highest frequency."""
    motion = random_body(frames)
    motion[:, :, 0] += 2 / 30 * np.arange(frames)[:, None]
    assert band_power(motion).sum() == pytest.approx(4.0)
    flicker = random_body(frames)
    flicker[:, :, 0] += 0.01 * (-1.0) ** np.arange(frames)[:, None]
    assert band_power(flicker).sum() == pytest.approx(0.6**2)
