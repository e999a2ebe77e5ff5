"""Target thresholds: each is computed from the numbers it names, and fails on the wrong side of its limit."""

from __future__ import annotations

import copy
from typing import Any

import pytest

from training.evaluation.limits import ThresholdResult
from training.evaluation.metrics.speed import BANDS, band_name
from training.evaluation.thresholds import TARGETS, check_targets


def row(**changed: float) -> dict[str, Any]:
    mean = {
        "mpjpe_mm": 90.0, "root_error_mm": 180.0, "speed_ratio": 1.0, "acceleration_ratio": 1.0,
        **{f"energy_db {band_name(*edges)}": 0.0 for edges in BANDS},
        "skate_share": 0.3, "contact_share": 0.5, "ipr_capsules": 0.08, "hands_w1_m": 0.05, "facing_w1_deg": 4.0,
        "bed_forward": 0.4, "bed_forward_chance": 0.2, "bed_backward": 0.5, "bed_backward_chance": 0.2,
        "beats_ratio": 1.0, "bone_variation": 0.01, "bas": 0.3, "bas_low": 0.2, "bas_high": 0.4,
    } | changed  # fmt: skip
    return {
        "mean": mean,
        "per_seed": [mean],
        "trials": {n: {"mean": dict(mean)} for n in ("salsa_05", "salsa_11")},
    }


def good() -> dict[str, Any]:
    """Numbers that reach every target."""
    near = {"hands_w1_m": 0.1, "facing_w1_deg": 8.0}
    return {
        "trials": {"salsa_05": 800, "salsa_11": 1000},
        "beats_unknown": ["salsa_05"],
        "rows": {
            "truth": row(mpjpe_mm=0.0, root_error_mm=0.0),
            "reconstruction": row(mpjpe_mm=9.0, root_error_mm=12.0),
            "generated": row(),
            "solved": row(bone_variation=0.0),
            "solved, foot lock": row(skate_share=0.1),
            "nearest neighbour": row(**near),
        },
        "long_dance": {"truth": {"repeat_share": 0.1}, "generated": {"repeat_share": 0.12}},
        "seams": {"ratio": 1.0},
        "responses": {"song_over_leader": 0.2, "seeds_apart_pose_mm": 46.0},
        "two_sample": {"generated": 0.6},
        "controls": {
            "coarse": [
                {"pose_moved_mm": 70.0, "root_moved_mm": 250.0, "quick_ratio": 0.9},
                {"pose_moved_mm": 0.0, "root_moved_mm": 0.0, "quick_ratio": 1.0},
                {"pose_moved_mm": 40.0, "root_moved_mm": 150.0, "quick_ratio": 1.1},
            ],
            "fine": [
                {"quick_ratio": 0.3, "slow_ratio": 0.95, "acceleration_ratio": 0.6},
                {"quick_ratio": 3.0, "slow_ratio": 1.05, "acceleration_ratio": 1.5},
            ],
            "music": [{"songs_apart_mm": 0.0}, {"songs_apart_mm": 60.0}],
            "variety": [{"seeds_apart_mm": 0.0}, {"seeds_apart_mm": 90.0}],
        },
        "beat_following": {"salsa_11": {"p": 0.001, "difference": 0.5, "following": 0.9}},
    }  # fmt: skip


def missed(numbers: dict[str, Any]) -> dict[str, ThresholdResult]:
    return {result.name: result for result in check_targets(numbers) if not result.passed}


def test_good_numbers_reach_every_target():
    results = check_targets(good())
    assert [result.name for result in results if not result.passed] == []
    assert len({result.name for result in results}) == len(results) == len(TARGETS) + 4


# What is changed in the generated row, just inside and just outside its limit, and the target that fails.
@pytest.mark.parametrize(
    "key, inside, outside, target",
    [
        ("mpjpe_mm", 94.0, 96.0, "MPJPE, mm"),
        ("root_error_mm", 214.0, 216.0, "relative-root error, mm"),
        ("speed_ratio", 0.91, 0.89, "mean joint speed over the truth's"),
        ("speed_ratio", 1.09, 1.11, "mean joint speed over the truth's"),
        ("acceleration_ratio", 0.91, 0.89, "mean joint acceleration over the truth's"),
        ("energy_db 0-1 Hz", 2.9, 3.1, "energy in 0-1 Hz against the truth, dB"),
        ("energy_db 6-15 Hz", -2.9, -3.1, "energy in 6-15 Hz against the truth, dB"),
        ("skate_share", 0.3 * 1.14, 0.3 * 1.16, "skating over the truth's"),
        ("contact_share", 0.5 * 0.86, 0.5 * 0.84, "feet in contact over the truth's"),
        ("contact_share", 0.5 * 1.14, 0.5 * 1.16, "feet in contact over the truth's"),
        ("ipr_capsules", 0.109, 0.111, "IPR (capsules) above the truth's, points"),
        ("hands_w1_m", 0.099, 0.1, "hand distance, W1 over nearest neighbour's"),
        ("facing_w1_deg", 7.9, 8.0, "facing, W1 over nearest neighbour's"),
        ("bed_forward", 0.2 + 0.61 * 0.2, 0.2 + 0.59 * 0.2, "BED forward above chance over the truth's"),
        ("bed_forward_chance", 0.27, 0.29, "BED forward above chance over the truth's"),
        ("bed_backward", 0.2 + 0.61 * 0.3, 0.2 + 0.59 * 0.3, "BED backward above chance over the truth's"),
        ("beats_ratio", 1.14, 1.16, "motion beats over the truth's"),
        ("bone_variation", 0.019, 0.021, "variation of raw bones"),
    ],
)
def test_limits_of_the_motion(key: str, inside: float, outside: float, target: str):
    for rows, prefix in (("generated", ""), ("solved", "solved: ")):
        numbers = good()
        numbers["rows"][rows]["mean"][key] = inside
        assert missed(numbers).keys() == set()
        numbers["rows"][rows]["mean"][key] = outside
        # Bones of the solved skeleton are rigid by construction and not asked about.
        expected = set() if (rows, key) == ("solved", "bone_variation") else {prefix + target}
        assert missed(numbers).keys() == expected


def test_limits_of_the_reconstruction_and_the_experiments():
    for section, key, outside, target in (
        ("seams", "ratio", 0.89, "seams over the truth's"),
        ("seams", "ratio", 1.16, "seams over the truth's"),
        ("responses", "song_over_leader", 0.09, "another song's change over another leader's"),
    ):
        numbers = good()
        numbers[section][key] = outside
        assert missed(numbers).keys() == {target}
    for key, target in (
        ("mpjpe_mm", "reconstruction MPJPE, mm"),
        ("root_error_mm", "reconstruction root error, mm"),
    ):
        numbers = good()
        numbers["rows"]["reconstruction"]["mean"][key] = 25.1
        assert missed(numbers).keys() == {target}


@pytest.mark.parametrize(
    "section, key, inside, outside, target",
    [
        ("responses", "seeds_apart_pose_mm", 45.1, 44.9, "two seeds apart in pose, mm"),
        ("two_sample", "generated", 0.655, 0.665, "told from the truth, accuracy"),
    ],
)
def test_limits_of_variety_and_of_the_two_sample_test(
    section: str, key: str, inside: float, outside: float, target: str
):
    numbers = good()
    numbers[section][key] = inside
    assert missed(numbers).keys() == set()
    numbers[section][key] = outside
    assert missed(numbers).keys() == {target}


# A control, the end of its travel, what is changed there just inside and just outside its limit, and the target.
@pytest.mark.parametrize(
    "control, end, key, inside, outside, target",
    [
        ("coarse", 0, "pose_moved_mm", 61.0, 59.0, "coarse at its lower end moves pose, mm"),
        ("coarse", 0, "root_moved_mm", 201.0, 199.0, "coarse at its lower end moves root, mm"),
        ("coarse", -1, "pose_moved_mm", 31.0, 29.0, "coarse at its upper end moves pose, mm"),
        ("coarse", -1, "root_moved_mm", 101.0, 99.0, "coarse at its upper end moves root, mm"),
        ("coarse", 0, "quick_ratio", 0.76, 0.74, "coarse at its lower end: energy over 3 Hz"),
        ("coarse", 0, "quick_ratio", 1.24, 1.26, "coarse at its lower end: energy over 3 Hz"),
        ("coarse", -1, "quick_ratio", 0.76, 0.74, "coarse at its upper end: energy over 3 Hz"),
        ("coarse", -1, "quick_ratio", 1.24, 1.26, "coarse at its upper end: energy over 3 Hz"),
        ("fine", 0, "quick_ratio", 0.49, 0.51, "fine at its lower end: energy over 3 Hz"),
        ("fine", -1, "quick_ratio", 2.51, 2.49, "fine at its upper end: energy over 3 Hz"),
        ("fine", 0, "slow_ratio", 0.91, 0.89, "fine at its lower end: energy under 1.5 Hz"),
        ("fine", -1, "slow_ratio", 1.09, 1.11, "fine at its upper end: energy under 1.5 Hz"),
        (
            "fine", -1, "acceleration_ratio", 1.59, 1.61, "fine at its upper end: acceleration over the truth's"
        ),
        ("music", -1, "songs_apart_mm", 50.1, 49.9, "music at its upper end: two songs apart in pose, mm"),
    ],
)  # fmt: skip
def test_limits_of_the_controls(control: str, end: int, key: str, inside: float, outside: float, target: str):
    numbers = good()
    numbers["controls"][control][end][key] = inside
    assert missed(numbers).keys() == set()
    numbers["controls"][control][end][key] = outside
    assert missed(numbers).keys() == {target}


def test_limits_of_the_beats_of_single_duets():
    numbers = good()
    numbers["rows"]["generated"]["trials"]["salsa_05"]["mean"]["bas"] = 0.9  # its beats are unknown
    assert missed(numbers).keys() == set()
    for value in (0.19, 0.41):
        numbers["rows"]["generated"]["trials"]["salsa_11"]["mean"]["bas"] = value
        result = missed(numbers)["BAS of salsa_11 in the truth's interval"]
        assert (result.low, result.high) == (0.2, 0.4)
    # p alone is not following: the motion beats have to move with the music.
    numbers = good()
    numbers["beat_following"]["salsa_11"]["following"] = -0.99
    assert missed(numbers).keys() == {"half a beat later, salsa_11: following"}
    numbers = good()
    numbers["beat_following"]["salsa_11"]["p"] = 0.01
    assert missed(numbers).keys() == {"half a beat later, salsa_11: p"}


def test_what_was_not_measured_has_no_target_and_what_is_not_a_number_fails():
    numbers = good()
    for name in ("solved", "reconstruction", "nearest neighbour"):
        del numbers["rows"][name]
    for name in ("controls", "beat_following"):
        del numbers[name]
    names = {result.name for result in check_targets(numbers)}
    absent = ("solved", "reconstruction", "neighbour", "half a beat", " end")
    assert not any(word in name for name in names for word in absent)
    assert "MPJPE, mm" in names
    silent = copy.deepcopy(good())
    for name in ("truth", "generated", "solved"):
        for trial in silent["rows"][name]["trials"].values():
            for key in ("bas", "bas_low", "bas_high"):
                del trial["mean"][key]
    assert not any("BAS" in result.name for result in check_targets(silent))
    below_chance = good()
    below_chance["rows"]["truth"]["mean"]["bed_forward"] = 0.1  # below chance: nothing to compare with
    assert "BED forward above chance over the truth's" in missed(below_chance)


def test_limits_of_the_foot_lock_and_of_repetition():
    numbers = good()
    numbers["rows"]["solved, foot lock"] = row(skate_share=0.16)
    assert missed(numbers)["foot lock: skating over without"].value == pytest.approx(0.16 / 0.3)
    numbers = good()
    numbers["long_dance"]["generated"]["repeat_share"] = 0.16
    assert missed(numbers)["two minutes: repeated windows above the truth's, points"].value == pytest.approx(
        6
    )
