"""Foot skating and PFC of feet that slide by known amounts."""

from __future__ import annotations

import numpy as np
import pytest

from tests.python.support.bodies import standing
from training.evaluation.metrics.contact import foot_skating, physical_foot_contact


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


def test_a_foot_that_is_up_for_most_of_the_time_is_in_contact_while_it_is_down():
    motion = standing(100)
    motion[30:, [7, 10], 1] += 0.2
    assert foot_skating(motion)["contact_share"] == pytest.approx((29 / 99 + 1) / 2)


def test_feet_in_the_air_do_not_skate():
    motion = standing(300)
    motion[100:200, [8, 11], 1] += 0.5
    motion[:, [8, 11], 0] += np.clip(0.03 * (np.arange(300) - 100), 0, 3)[:, None]
    assert foot_skating(motion)["skate_share"] == pytest.approx(0.0, abs=0.01)


def test_contact_is_against_each_joints_own_floor():
    assert foot_skating(standing(50) + np.array([0.0, 1.0, 0.0]))["contact_share"] == pytest.approx(1.0)


@pytest.mark.parametrize("slower", ["ankles", "feet"])
def test_pfc_by_hand(slower: str):
    motion = standing(5)
    order = slice(None) if slower == "feet" else slice(None, None, -1)
    motion[:, 0, 0] += np.array([0.0, 0.0, 0.01, 0.01, 0.01])  # accelerations 0.01, -0.01, 0
    left, right = np.array([[0.03, 0.02], [0.05, 0.04]])[:, order]  # of ankle and foot, metres a frame
    motion[:, [7, 10], 0] += np.arange(5)[:, None] * left
    motion[:, [8, 11], 2] += np.arange(5)[:, None] * right
    motion[:, [7, 10, 8, 11], 1] += 0.5 * np.arange(5)[:, None]  # heights do not count
    assert physical_foot_contact(motion) == pytest.approx(1e4 * 0.02 * 0.04 * (1 + 1 + 0) / 3)
    assert physical_foot_contact(standing(9)) == 0.0


def test_pfc_takes_the_feet_after_the_root_has_changed_its_speed():
    motion = standing(5)
    motion[:, 0, 0] += np.array([0.0, 0.0, 0.01, 0.02, 0.03])
    motion[:, [7, 10, 8, 11], 0] += np.array([0.0, 0.0, 0.02, 0.04, 0.06])[:, None]
    assert physical_foot_contact(motion) == pytest.approx(1e4 * 0.02**2 / 3)


def test_pfc_does_not_count_falling():
    motion = standing(5)
    motion[:, 0, 1] += np.array([0.0, 0.0, 0.01, 0.03, 0.02])  # twice up, then down three times as hard
    motion[:, [7, 10, 8, 11], 0] += 0.02 * np.arange(5)[:, None]
    assert physical_foot_contact(motion) == pytest.approx(1e4 * 0.02**2 * (1 + 1 + 0) / 3)
