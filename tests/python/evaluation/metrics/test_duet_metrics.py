"""A row has every measure, and the truth measured against itself has no error."""

from __future__ import annotations

import numpy as np
import pytest

from tests.python.support.bodies import random_walk, swinging_body
from tests.python.support.held_out import made_music
from training.evaluation.metrics.beats import bas, bed, music_beats
from training.evaluation.metrics.contact import foot_skating, physical_foot_contact
from training.evaluation.metrics.distance import facing, hand_distance, hands_held, root_distance, wasserstein
from training.evaluation.metrics.duet import clip_count, duet_metrics, set_metrics
from training.evaluation.metrics.errors import bone_variation, mpjpe, root_error
from training.evaluation.metrics.penetration import penetration
from training.evaluation.metrics.repetition import repetition
from training.evaluation.metrics.speed import band_decibels, joint_acceleration, joint_speed


def test_the_truth_measured_against_itself():
    leader, truth = swinging_body(400, 3), swinging_body(400, 4)
    row = duet_metrics(leader, truth, truth, made_music(400, 20))
    zero = {k: v for k, v in row.items() if k.endswith(("error_mm", "_w1_m", "_w1_deg")) or "energy_db" in k}
    assert len(zero) == 8
    assert all(value == pytest.approx(0.0, abs=1e-9) for value in zero.values())
    ratios = {k: v for k, v in row.items() if k.endswith("_ratio")}
    assert len(ratios) == 4
    assert all(value == pytest.approx(1.0) for value in ratios.values())
    further = {"mpjpe_mm", "pfc", "ipr_capsules", "bas", "bas_chance", "skate_share", "bone_variation"}
    assert further | {"repeat_share", "repeat_mm"} <= set(row)
    short = duet_metrics(leader[:150], truth[:150], truth[:150])
    assert set(row) - set(short) == {k for k in row if k.startswith(("bas", "repeat"))}


def test_every_measure_is_of_the_dancers_that_it_names():
    leader, truth, made = (swinging_body(400, seed) for seed in (3, 4, 5))
    # Faster, larger, elsewhere, and without a period.
    made = made * 1.2 + random_walk(400) + np.array([1.5, 0.0, 0.0])
    made[200:] += np.array([20.0, 0.0, 0.0])  # away from the leader, whose hand is held before
    made[:200, 20] = leader[:200, 20]
    music = made_music(400, 20)
    row = duet_metrics(leader, truth, made, music)
    echo, real_echo = bed(leader, made), bed(leader, truth)
    aligned = bas(music_beats(music), made)
    beside = {"truth": root_distance(leader, truth), "made": root_distance(leader, made)}
    expected = {
        "mpjpe_mm": mpjpe(truth, made),
        "root_error_mm": root_error(leader, truth, made),
        "speed_ratio": joint_speed(made) / joint_speed(truth),
        "acceleration_ratio": joint_acceleration(made) / joint_acceleration(truth),
        "distance_ratio": np.median(beside["made"]) / np.median(beside["truth"]),
        "distance_w1_m": wasserstein(beside["truth"], beside["made"]),
        "hands_w1_m": wasserstein(hand_distance(leader, truth), hand_distance(leader, made)),
        "hands_held": hands_held(leader, made),
        "facing_w1_deg": wasserstein(facing(leader, truth), facing(leader, made)),
        "pfc": physical_foot_contact(made),
        "bone_variation": bone_variation(made),
        "bed_forward": echo["forward"],
        "bed_forward_chance": echo["forward_chance"],
        "bed_backward": echo["backward"],
        "bed_backward_chance": echo["backward_chance"],
        "beats_ratio": echo["reactor_beats"] / real_echo["reactor_beats"],
        "bas": aligned["value"],
        "bas_chance": aligned["chance"],
        "bas_low": aligned["low"],
        "bas_high": aligned["high"],
        **{f"energy_db {band}": value for band, value in band_decibels(truth, made).items()},
        **foot_skating(made),
        **penetration(leader, made),
        **repetition(made),
    }
    assert {name: row[name] for name in expected} == pytest.approx(expected, nan_ok=True)
    others = duet_metrics(leader, truth, truth, music)
    same = {name for name in expected if row[name] == others[name]}
    assert same == set(), "these would not tell one dancer from the other"


def test_sets_of_clips():
    leader, truth = (
        swinging_body(600, 3),
        np.cumsum(np.random.default_rng(7).normal(scale=0.01, size=(600, 22, 3)), axis=0),
    )
    assert clip_count([truth, truth]) == 18
    same = set_metrics([(leader, truth)], [(leader, truth)], "corrected", resamples=5)
    assert set(same) == {"fid_k", "fid_g", "fid_cd", "div_k", "div_g", "div_cd"}
    for name in ("k", "g", "cd"):
        assert same[f"fid_{name}"].value == pytest.approx(0.0, abs=1e-6)
        assert same[f"div_{name}"].value > 0
    far = set_metrics([(leader, truth)], [(leader, 1.5 * truth)], "corrected", resamples=5)
    assert far["fid_k"].value > 0.1
    assert far["fid_cd"].value > 0.1
