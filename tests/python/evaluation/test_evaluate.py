"""Evaluation from end to end: a dancer made from formulas, whose responses are known, and the tiny exported
model.
"""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from export.evaluate import Options, dancer_of, main, paired_trials, solve_with_node
from export.runtime import open_model
from tests.python.support.real_data import real_file
from training.data.duet import Duet, Solo
from training.data.made import made_duet
from training.data.sources import read_split
from training.evaluation.baselines import mirrored_leader
from training.evaluation.evaluate import Evaluation, evaluate
from training.evaluation.metrics.bones import bone_variation
from training.evaluation.metrics.duet import duet_metrics
from training.evaluation.metrics.penetration import depth as overlap_depth
from training.evaluation.out_of_distribution import Elsewhere
from training.evaluation.probes import measure_beat_following, measure_seams
from training.evaluation.protocol import Settings, Trial, fit_length
from training.evaluation.report.report import draw, film, write_report
from training.evaluation.report.report_text import markdown
from training.evaluation.report.spectra import COARSE
from training.evaluation.report.video import write_video
from training.evaluation.thresholds import Bar, check
from training.motion.skeleton import JOINTS

TINY = Path(__file__).parents[2] / "fixtures/tiny-model"
SHIPPED = Path(__file__).parents[3] / "web/public/models/salsa"
QUICK = Settings(seeds=(0, 1), seam_starts=(0, 60), response_seeds=2, two_sample=False)


def made_music(frames: int, period: int, first: int = 0) -> np.ndarray:
    features = np.zeros((frames, 54), np.float32)
    features[first::period, 53] = 1.0
    return features


def mirror_dancer(leader, music, seed, heard_leader=None, guidance=None, coarse_only=False, role=0.0):
    """Mirrors the leader it hears, but for a lean that depends on the seed and a nod on every beat of the
    music.
    """
    made = mirrored_leader(leader if heard_leader is None else heard_leader, 0.8).astype(np.float64)
    made += leader[:, :1] - (leader if heard_leader is None else heard_leader)[:, :1]
    made[:, 15] += np.random.default_rng(seed).normal(scale=0.05, size=3)
    if music is not None:
        made[: len(music), 15, 1] -= 0.2 * music[: len(made), 53]
    return made


@pytest.fixture(scope="module")
def trials() -> list[Trial]:
    return [
        Trial(made_duet(560, 1, "one"), made_music(560, 20)),
        Trial(made_duet(500, 2, "two"), made_music(500, 24)),
    ]


@pytest.fixture(scope="module")
def train() -> list[Duet]:
    return [made_duet(400, seed) for seed in (3, 4)]


def test_fit_length_plays_forth_and_back():
    motion = np.arange(4.0)[:, None, None] * np.ones((1, 22, 3))
    assert list(fit_length(motion, 9)[:, 0, 0]) == [0, 1, 2, 3, 2, 1, 0, 1, 2]
    assert list(fit_length(motion, 2)[:, 0, 0]) == [0, 1]


def test_evaluation_of_a_known_dancer(trials: list[Trial], train: list[Duet], tmp_path: Path):
    given = {"reconstruction": {t.duet.name: [t.duet.reactor + np.float32(0.01)] for t in trials}}
    result = evaluate(
        mirror_dancer,
        trials,
        train,
        replace(QUICK, two_sample=True),
        given,
        solvers={"solved": lambda motion, leader: motion + 0.001},
        elsewhere=[Solo("martial_1", made_duet(300, 5).leader), Solo("martial_2", made_duet(90, 6).leader)],
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
    assert "solved: MPJPE, mm" in {bar.name for bar in check(numbers)}
    # The mean is over trials of means over seeds.
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
    assert list(numbers["elsewhere"]) == ["martial_1", "martial_2"]
    assert numbers["role_swap"]["generated"]["mean"]["mpjpe_mm"] > 0
    # Drawn without the fine layer, not measured: to this dancer all is the same.
    assert np.array_equal(result.motions[COARSE]["one"][0], result.motions["generated"]["one"][0])
    told = numbers["two_sample"]
    assert list(told) == list(rows)
    assert told["mean pose"] > 0.75
    # It listens to the leader; of the music it only nods.
    heard = numbers["responses"]
    assert heard["change_other_leader"] > 3 * heard["change_other_song"] > 0
    assert heard["song_over_leader"] == pytest.approx(
        heard["change_other_song"] / heard["change_other_leader"]
    )
    assert heard["change_half_beat"] > 0
    assert heard["seeds_apart_pose_mm"] > 0
    assert heard["seeds_apart_place_mm"] == pytest.approx(0.0, abs=1e-3)

    bars = write_report(result, trials, tmp_path, "made", {"model": "formula"}, pictures=False, videos=False)
    stored = json.loads((tmp_path / "metrics.json").read_text())
    assert stored["model"] == "formula"
    assert stored["rows"]["generated"]["mean"]["mpjpe_mm"] == pytest.approx(by_hand)
    assert [b["name"] for b in stored["bars"]] == [b.name for b in bars]
    assert "solved: MPJPE, mm" in {bar["name"] for bar in stored["quality"]}
    text = (tmp_path / "report.md").read_text()
    for part in (
        "reconstruction",
        "| generated, seed 1 |",
        "| two, nearest neighbour |",
        "| martial_2 | 90 |",
    ):
        assert part in text
    drawn = draw(trials[:1], result, tmp_path, ["generated"])
    assert [p.name for p in drawn] == [
        "spectra.png", "one-generated-0s.png", "one-generated-5s.png", "one-role-swap.png", "elsewhere-martial_1.png"
    ]  # fmt: skip
    film = [tmp_path / "one.webm"]
    linked = markdown(numbers, "made", drawn, film)
    assert all(p.exists() and f"]({p.name})" in linked for p in drawn)
    assert "](one.webm)" in linked


def test_the_report_films_the_first_seed(tmp_path: Path):
    duet, stranger = made_duet(8, 1, "one"), made_duet(4, 2, "martial_1")
    made = [duet.reactor + np.float32(0.1 * seed) for seed in (1, 2)]
    swapped = [duet.leader + np.float32(0.1 * seed) for seed in (1, 2)]
    others = [Elsewhere(f"martial_{n}", stranger.leader, stranger.reactor) for n in (1, 2)]
    filmed = film(
        [Trial(duet, None)],
        Evaluation({}, {"generated": {"one": made}}, {"one": swapped}, others),
        tmp_path,
    )
    assert [path.name for path in filmed] == ["one.webm", "one-role-swap.webm", "elsewhere-martial_1.webm"]
    for path, leader, reactors in zip(
        filmed,
        (duet.leader, duet.reactor, stranger.leader),
        (
            {"truth": duet.reactor, "generated": made[0]},
            {"truth": duet.leader, "reactor leads": swapped[0]},
            {"generated": stranger.reactor},
        ),
        strict=True,
    ):
        alone = write_video(leader, reactors, tmp_path / "alone.webm")
        assert path.read_bytes() == alone.read_bytes(), path.name


def test_bars_are_held(trials: list[Trial], train: list[Duet]):
    numbers = evaluate(mirror_dancer, trials, train, replace(QUICK, seeds=(0,), response_seeds=1)).numbers
    bars = {bar.name: bar for bar in check(numbers)}
    assert "reconstruction MPJPE, mm" not in bars  # there is no such row to hold
    assert not bars["number of seams measured"].passed
    numbers["rows"]["generated"]["mean"]["mpjpe_mm"] = 124.0
    assert {b.name: b for b in check(numbers)}["MPJPE, mm"].passed
    numbers["rows"]["generated"]["mean"]["mpjpe_mm"] = 126.0
    assert not {b.name: b for b in check(numbers)}["MPJPE, mm"].passed
    assert not Bar("unknown", float("nan"), 0.0, 1.0).passed
    assert "**no**" in markdown(numbers, "made", [], [])


def test_seams_are_found_where_the_blocks_meet(trials: list[Trial]):
    """A dancer that jumps at every 240th frame of what it is given, wherever that was cut out."""

    def jumping(leader, music, seed, heard_leader=None, guidance=None, coarse_only=False, role=0.0):
        reactor = next(
            t.duet.reactor[-len(leader) :] for t in trials if np.array_equal(t.duet.leader[-1], leader[-1])
        )
        return reactor + np.where((np.arange(len(leader)) // 240) % 2 == 1, 0.05, 0.0)[:, None, None]

    whole = {t.duet.name: [jumping(t.duet.leader, None, 0)] for t in trials}
    settings = Settings(seeds=(0,), seam_starts=(0, 60, 120))
    found = measure_seams(jumping, trials, whole, settings)
    assert found["seams"] == 2 + 2 + 1 + 2 + 1 + 1
    assert found["ratio"] > 3
    assert found["paper_jitter_mm"] > found["paper_jitter_truth_mm"]

    def true(leader, music, seed, heard_leader=None, guidance=None, coarse_only=False, role=0.0):
        return next(
            t.duet.reactor[-len(leader) :] for t in trials if np.array_equal(t.duet.leader[-1], leader[-1])
        )

    seamless = measure_seams(true, trials, {t.duet.name: [t.duet.reactor] for t in trials}, settings)
    assert seamless["ratio"] == pytest.approx(1.0)  # compared with the truth at the same frames
    assert seamless["paper_jitter_mm"] == pytest.approx(seamless["paper_jitter_truth_mm"])
    elsewhere = measure_seams(jumping, trials, whole, replace(settings, seam_spacing=200, seam_starts=(0,)))
    assert elsewhere["ratio"] == pytest.approx(1.0, abs=0.01)


def test_beat_following(trials: list[Trial]):
    """A body that slows down on the beat of what it hears is told from one that does so at its own times."""

    def pulsing(leader, music, seed, heard_leader=None, guidance=None, coarse_only=False, role=0.0):
        beats = np.flatnonzero(music[:, 53])
        phase = (np.arange(len(leader)) - beats[0]) / 20
        speed = (
            1.0 - np.cos(2 * np.pi * phase) + np.random.default_rng(seed).normal(scale=0.1, size=len(leader))
        )
        return (np.cumsum(speed) * 0.01)[:, None, None] * np.ones((1, 22, 3))

    def deaf(leader, music, seed, heard_leader=None, guidance=None, coarse_only=False, role=0.0):
        return pulsing(leader, trials[0].music, seed)

    assert measure_beat_following(pulsing, trials[:1], 12)["one"]["p"] < 0.01
    assert measure_beat_following(deaf, trials[:1], 12)["one"]["p"] > 0.5


def test_guidance_grid(trials: list[Trial], train: list[Duet]):
    def louder(leader, music, seed, heard_leader=None, guidance=None, coarse_only=False, role=0.0):
        coarse, fine = guidance or (0.0, 0.0)
        time = np.arange(len(leader))[:, None, None] / 30
        slow, quick = np.sin(2 * np.pi * 0.5 * time), 0.1 * np.sin(2 * np.pi * 6 * time)
        return leader + (1 + coarse) * slow + (1 + fine) * quick

    settings = replace(QUICK, seeds=(0,), response_seeds=1, seam_starts=(0,), guidance_grid=(0.0, 1.2))
    cells = evaluate(louder, trials[:1], train, settings).numbers["guidance"]
    assert [(c["coarse"], c["fine"]) for c in cells] == [(0.0, 0.0), (0.0, 1.2), (1.2, 0.0), (1.2, 1.2)]
    assert cells[2]["slow_energy"] > 2 * cells[0]["slow_energy"]
    assert cells[2]["quick_energy"] == pytest.approx(cells[0]["quick_energy"], rel=0.1)
    assert cells[1]["quick_energy"] > 2 * cells[0]["quick_energy"]
    assert cells[1]["slow_energy"] == pytest.approx(cells[0]["slow_energy"], rel=0.1)


@pytest.mark.skipif(shutil.which("node") is None, reason="Node is not installed")
def test_the_pages_solver_keeps_bones_rigid():
    """A body whose bones breathe comes back with constant ones, close to where it was."""
    motion = made_duet(60, 1).leader
    breathing = motion[:, :1] + (motion - motion[:, :1]) * (1 + 0.05 * np.sin(np.arange(60)))[:, None, None]
    far = motion + np.array([3, 0, 0], np.float32)
    solved = solve_with_node(breathing, far)
    assert bone_variation(breathing) > 0.02
    assert bone_variation(solved) < 1e-4
    assert np.linalg.norm(solved - breathing, axis=-1).mean() < 0.05


@pytest.mark.skipif(shutil.which("node") is None, reason="Node is not installed")
def test_the_pages_solver_keeps_the_dancer_out_of_the_leader():
    """Somebody who stands within the leader steps aside, level, and no farther than must be."""
    motion = np.repeat(made_duet(90, 1).leader[:1], 90, axis=0)
    inside = motion + np.array([0.1, 0, 0], np.float32)
    free, solved = (solve_with_node(inside, motion + np.array([x, 0, 0], np.float32)) for x in (3, 0))
    aside = solved - free
    assert np.median(overlap_depth(motion, inside)) > 0.1
    assert np.abs(aside[..., 1]).max() == 0
    assert 0.05 < np.linalg.norm(aside, axis=-1).max() < 0.64
    trunk = [JOINTS.index(joint) for joint in ("pelvis", "spine1", "spine2", "spine3", "neck", "head")]
    assert np.linalg.norm(solved[:, trunk] - motion[:, trunk], axis=-1).min() > 0.2


@pytest.mark.skipif(not TINY.exists(), reason="tiny model not built")
def test_the_program_measures_an_exported_model(tmp_path: Path):
    duets = [made_duet(300, seed, name) for seed, name in enumerate(("train", "val", "one", "two"))]
    archive = {
        f"{d.name}/{role}": m for d in duets for role, m in (("leader", d.leader), ("follower", d.reactor))
    }
    np.savez(tmp_path / "duets.npz", **archive)  # pyright: ignore[reportArgumentType]
    main(
        Options(
            data=tmp_path / "duets.npz", out=tmp_path / "out", model=TINY, val=("val",), test=("one", "two"),
            pictures=False, videos=False, music=False, settings=replace(QUICK, seam_starts=(0,), response_seeds=1),
        )
    )  # fmt: skip
    stored = json.loads((tmp_path / "out/metrics.json").read_text())
    assert stored["runtime"] == "onnxruntime"
    assert stored["rows"]["generated"]["mean"]["mpjpe_mm"] > 0
    # The tiny model alternates its block phase, so boundaries lie every 120 frames of 300.
    assert stored["seams"]["seams"] == 2 * 2 * 2
    with pytest.raises(SystemExit, match="--model"):
        main(Options(data=tmp_path / "duets.npz", out=tmp_path / "out"))


def test_the_shipped_numbers_are_those_of_the_shipped_graphs():
    """metrics.json beside the manifest: same graphs, and one dance of it measured again."""
    model = open_model(SHIPPED, threads=1)
    stored = json.loads((SHIPPED / "metrics.json").read_text())
    assert stored["graphs"] == {k: g["files"]["wasm"]["sha256"] for k, g in model.manifest["graphs"].items()}
    assert all(bar["passed"] for bar in stored["bars"])
    options = Options(data=real_file("cmu_salsa/duets.npz"), out=Path())
    trial = paired_trials(options, read_split(options.data, options.val, options.test))[0]
    sampling = stored["sampling"]
    dancer = dancer_of(model, sampling["steps"], tuple(sampling["guidance"]), sampling["music"])
    made = dancer(trial.duet.leader, trial.music, stored["seeds"][0])
    known = stored["rows"]["generated"]["trials"][trial.duet.name]["seeds"][0]
    again = duet_metrics(trial.duet.leader, trial.duet.reactor, made, trial.music)
    for key in ("mpjpe_mm", "root_error_mm", "speed_ratio", "skate_share", "hands_w1_m", "bone_variation"):
        assert again[key] == pytest.approx(known[key], rel=0.01, abs=1e-5), key
