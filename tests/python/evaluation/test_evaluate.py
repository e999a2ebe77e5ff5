"""Evaluation from end to end: a generator made from formulas, whose responses are known, and its report."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.python.support.duets import made_duet
from tests.python.support.held_out import generate_mirrored
from training.data.duet import Duet, Solo
from training.evaluation.evaluate import evaluate
from training.evaluation.limits import ThresholdResult
from training.evaluation.metrics.repetition import MIN_FRAMES
from training.evaluation.protocol import COARSE_ALONE, HeldOutDuet, Settings
from training.evaluation.report.report import draw, write_report
from training.evaluation.report.report_text import markdown
from training.evaluation.rows import measure_row
from training.evaluation.thresholds import check_required

QUICK = Settings(seeds=(0, 1), seam_starts=(0, 60), response_seeds=2, two_sample=False)


def test_evaluation_of_a_known_generator(held_out: list[HeldOutDuet], train: list[Duet], tmp_path: Path):
    given = {"reconstruction": {i.duet.name: [i.duet.reactor + np.float32(0.01)] for i in held_out}}
    result = evaluate(
        generate_mirrored,
        held_out,
        train,
        240,
        replace(QUICK, two_sample=True, seen_leaders=("indian",)),
        given,
        solvers={"solved": lambda motions, leader, music: [motion + 0.001 for motion in motions]},
        out_of_distribution=[
            Solo("martial_1", made_duet(300, 5).leader),
            Solo("martial_2", made_duet(90, 6).leader),
            Solo("indian_1", made_duet(90, 7).leader),
        ],
    )
    numbers = result.numbers
    rows = numbers["rows"]
    assert list(rows) == [
        "truth", "reconstruction", "generated", "solved", "nearest neighbour", "mean pose", "mirrored leader"
    ]  # fmt: skip
    assert rows["truth"]["mean"]["mpjpe_mm"] == 0.0
    assert rows["reconstruction"]["mean"]["root_error_mm"] == pytest.approx(10 * np.sqrt(3), rel=1e-3)
    assert rows["truth"]["mean"]["fid_k corrected"] == pytest.approx(0.0, abs=1e-6)
    assert rows["solved"]["mean"]["mpjpe_mm"] == pytest.approx(rows["generated"]["mean"]["mpjpe_mm"])
    assert rows["solved"]["mean"]["root_error_mm"] != rows["generated"]["mean"]["root_error_mm"]
    assert "solved: MPJPE, mm" in {result.name for result in check_required(numbers)}
    # The mean is over duets of means over seeds.
    by_hand = np.mean(
        [[s["mpjpe_mm"] for s in rows["generated"]["trials"][n]["seeds"]] for n in ("one", "two")]
    )
    assert rows["generated"]["mean"]["mpjpe_mm"] == pytest.approx(by_hand)
    low, high = rows["generated"]["interval"]["mpjpe_mm"]
    assert low < by_hand < high
    seeds = rows["generated"]["per_seed"]
    assert [seed["mpjpe_mm"] for seed in seeds] == pytest.approx(
        [
            np.mean([rows["generated"]["trials"][n]["seeds"][i]["mpjpe_mm"] for n in ("one", "two")])
            for i in (0, 1)
        ]
    )
    assert seeds[0]["mpjpe_mm"] != seeds[1]["mpjpe_mm"]
    groups = numbers["out_of_distribution"]
    assert {name: list(group["leaders"]) for name, group in groups.items()} == {
        "seen": ["indian_1"],
        "unseen": ["martial_1", "martial_2"],
    }
    assert numbers["role_swap"]["generated"]["mean"]["mpjpe_mm"] > 0
    others = numbers["other_dances"]
    assert list(others) == ["fid_k", "fid_g", "fid_cd"]
    assert all(low <= value <= high for value, low, high in others.values())
    # Drawn without the fine layer, not measured: this generator has none.
    assert np.array_equal(result.motions[COARSE_ALONE]["one"][0], result.motions["generated"]["one"][0])
    told = numbers["two_sample"]
    assert list(told) == list(rows)
    assert told["mean pose"] > 0.75
    # The leader changes all of the motion, the music only the head.
    changes = numbers["responses"]
    assert changes["change_other_leader"] > 3 * changes["change_other_song"] > 0
    assert changes["song_over_leader"] == pytest.approx(
        changes["change_other_song"] / changes["change_other_leader"]
    )
    assert changes["change_half_beat"] > 0
    assert changes["seeds_apart_pose_mm"] > 0
    assert changes["seeds_apart_place_mm"] == pytest.approx(0.0, abs=1e-3)

    required = write_report(
        result, held_out, tmp_path, "made", {"model": "formula"}, pictures=False, videos=False
    )
    stored = json.loads((tmp_path / "metrics.json").read_text())
    assert stored["model"] == "formula"
    assert stored["rows"]["generated"]["mean"]["mpjpe_mm"] == pytest.approx(by_hand)
    assert [result["name"] for result in stored["required"]] == [result.name for result in required]
    assert "solved: MPJPE, mm" in {result["name"] for result in stored["targets"]}
    text = (tmp_path / "report.md").read_text()
    for part in (
        "reconstruction",
        "| generated, seed 1 |",
        "| two, nearest neighbour |",
        "| martial_2 | 90 |",
        "### Not seen in training:",
        " of 2 pass",
        "### Seen in training:",
        "of all 3 leaders",
        "| snapping: ",
    ):
        assert part in text
    drawn = draw(held_out[:1], result, tmp_path, ["generated"])
    assert [p.name for p in drawn] == [
        "spectra.png", "one-generated-0s.png", "one-generated-5s.png", "one-role-swap.png",
        "out-of-distribution-indian_1.png", "out-of-distribution-martial_1.png"
    ]  # fmt: skip
    film = [tmp_path / "one.webm"]
    linked = markdown(numbers, "made", drawn, film)
    assert all(p.exists() and f"]({p.name})" in linked for p in drawn)
    assert "](one.webm)" in linked


def test_duets_may_be_of_any_length_above_a_clip() -> None:
    """One is too short for the measures of repetition, whichever comes first."""
    short, long = (HeldOutDuet(made_duet(frames, 1, str(frames)), None) for frames in (MIN_FRAMES - 1, 300))
    for held_out in ([short, long], [long, short]):
        row = measure_row(held_out, {item.duet.name: [item.duet.reactor] for item in held_out})
        alone = measure_row([long], {"300": [long.duet.reactor]})
        assert row["mean"]["repeat_share"] == alone["mean"]["repeat_share"]


def test_what_cannot_be_measured_is_refused_before_anything_is_generated(train: list[Duet]) -> None:
    def generate(*_: object, **__: object) -> np.ndarray:
        raise AssertionError("it was generated")

    short, long = ([HeldOutDuet(made_duet(frames, 1), None)] for frames in (150, 200))
    with pytest.raises(ValueError, match="1 clips of 4 s, one every 2 s, and a FID needs two"):
        evaluate(generate, short, train, 240)
    with pytest.raises(ValueError, match="all duets are held out"):
        evaluate(generate, long, [], 240)


def test_required_thresholds_are_checked(held_out: list[HeldOutDuet], train: list[Duet]):
    numbers = evaluate(
        generate_mirrored, held_out, train, 240, replace(QUICK, seeds=(0,), response_seeds=1)
    ).numbers
    results = {result.name: result for result in check_required(numbers)}
    assert "reconstruction MPJPE, mm" not in results  # there is no such row to hold
    assert not results["number of seams measured"].passed
    numbers["rows"]["generated"]["mean"]["mpjpe_mm"] = 124.0
    assert {r.name: r for r in check_required(numbers)}["MPJPE, mm"].passed
    numbers["rows"]["generated"]["mean"]["mpjpe_mm"] = 126.0
    assert not {r.name: r for r in check_required(numbers)}["MPJPE, mm"].passed
    assert not ThresholdResult("unknown", float("nan"), 0.0, 1.0).passed
    assert "**no**" in markdown(numbers, "made", [], [])
