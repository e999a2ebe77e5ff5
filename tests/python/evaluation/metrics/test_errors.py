"""Errors against values worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest

from tests.python.support.bodies import random_body, random_walk
from training.evaluation.metrics import mean_report, quick_report
from training.evaluation.metrics.errors import (
    bone_variation,
    mpjpe,
    mpjve,
    root_error,
    root_error_by_distance,
)


def test_mpjpe_ignores_the_place_and_counts_every_joint():
    truth, generated = random_body(), random_body() + np.array([3.0, 0.0, -2.0])
    assert mpjpe(truth, generated) == pytest.approx(0.0, abs=1e-9)
    generated[:, 5, 1] += 0.022  # one joint of 22, 22 mm
    assert mpjpe(truth, generated) == pytest.approx(1.0)


def test_mpjve_is_per_frame():
    truth, generated = random_body(), random_body()
    generated[:, 7, 2] += 0.022 * np.arange(61)  # 22 mm per frame on one joint of 22
    assert mpjve(truth, generated) == pytest.approx(1.0)
    assert mpjve(truth, generated + 0.1 * np.arange(61)[:, None, None]) == pytest.approx(1.0)


def test_root_error_is_seen_from_the_leader():
    leader, truth = random_body(), random_body() + np.array([0.6, 0.0, 0.0])
    generated = truth + np.array([0.03, 0.0, 0.04])
    assert root_error(leader, truth, generated) == pytest.approx(50.0)
    # The same couple at another place of the room has the same error.
    assert root_error(leader + 5.0, truth + 5.0, generated + 5.0) == pytest.approx(50.0)


def test_root_error_splits_by_the_true_distance():
    leader, truth, generated = random_body(40), random_body(40), random_body(40)
    for block, (distance, error) in enumerate(((0.3, 0.1), (0.7, 0.2), (1.0, 0.3), (2.0, 0.4))):
        rows = slice(10 * block, 10 * block + 10)
        truth[rows, :, 0] += distance
        # Half and one and a half times the error in turns.
        generated[rows, :, 0] += distance + error * np.resize([0.5, 1.5], 10)[:, None]
    split = root_error_by_distance(leader, truth, generated)
    assert list(split) == ["0-0.4 m", "0.4-0.8 m", "0.8-1.2 m", ">1.2 m"]
    assert list(split.values()) == pytest.approx([100.0, 200.0, 300.0, 400.0])


def test_motions_of_unequal_length_are_refused():
    with pytest.raises(ValueError, match="same number of frames"):
        mpjpe(random_body(10), random_body(9))


def test_quick_report():
    time = np.arange(61)[:, None, None] / 30
    leader = random_body()
    truth = random_body() + np.array([0.0, 0.0, 0.5]) + time * np.array([0.0, 1.0, 0.0])
    generated = random_body() + np.array([0.0, 0.0, 2.0]) + time * np.array([0.0, 0.5, 0.0])
    report = quick_report(leader, truth, generated)
    offset = np.array([0.0, 0.0, 1.5]) - time[:, 0] * np.array([0.0, 0.5, 0.0])
    distances = [np.median(np.hypot(d, time[:, 0, 0] * v)) for d, v in ((2.0, 0.5), (0.5, 1.0))]
    assert report["mpjpe_mm"] == pytest.approx(0.0, abs=1e-9)
    assert report["root_error_mm"] == pytest.approx(1000 * np.linalg.norm(offset, axis=-1).mean())
    assert report["speed_ratio"] == pytest.approx(0.5)
    assert report["distance_ratio"] == pytest.approx(distances[0] / distances[1])


def test_a_mean_of_reports_is_of_what_all_of_them_have():
    assert mean_report([{"a": 1.0, "b": 2.0}, {"a": 3.0}]) == {"a": 2.0}
    assert mean_report([]) == {}


def test_dancers_in_one_place_count_among_the_nearest():
    leader, truth = random_body(20), random_body(20)
    truth[10:, :, 0] += 0.75
    split = root_error_by_distance(leader, truth, truth + np.array([0.1, 0.0, 0.0]))
    assert split["0-0.4 m"] == pytest.approx(100.0)
    assert split["0.4-0.8 m"] == pytest.approx(100.0)
    assert np.isnan(split[">1.2 m"])


def test_bone_variation_is_a_share_of_the_length():
    motion = random_walk(50)
    assert bone_variation(2 * motion) == pytest.approx(bone_variation(motion))
    assert bone_variation(random_body(50)) == pytest.approx(0.0, abs=1e-9)
    pulsing = random_body(50) * (1 + 0.1 * (-1.0) ** np.arange(50))[:, None, None]
    assert bone_variation(pulsing) == pytest.approx(0.1)
