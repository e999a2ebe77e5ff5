"""The tables of the paper: that their rows are what they say, that nothing is trained twice, and what is written."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import tyro

from tests.python.support.held_out import generate_mirrored, made_held_out
from training import train_denoiser, train_hfsq
from training.baselines import __main__ as baselines
from training.evaluation import no_latent_baseline
from training.experiments.__main__ import Options
from training.experiments.jobs import Data, Job, run_all, stage1_job, stage2_job
from training.experiments.measure import MeasureJob, measured
from training.experiments.scale import Scale
from training.experiments.tables import MEASURES, TABLES, Row
from training.experiments.write import cell, digits, verdicts, write_table

DATA = Data(Path("duets.npz"), ("a",), ("b",), Path("music"))
ROOT = Path("runs")
TRAINED = [(t.number, row) for t in TABLES.values() for row in t.rows if row.guidance is None]
PROGRAMS = {
    "training.train_hfsq": train_hfsq.Options,
    "training.train_denoiser": train_denoiser.Options,
    "training.baselines": baselines.Options,
    "training.evaluation.no_latent_baseline": no_latent_baseline.Options,
}


def parsed(job: Job):
    """The options that a job's program understands."""
    return tyro.cli(PROGRAMS[job.command[2]], args=job.command[3:])


@pytest.mark.parametrize(("number", "row"), TRAINED, ids=[f"{n}-{r.name}" for n, r in TRAINED])
def test_programs_understand_every_row_with_equal_data_steps_and_seeds(number: int, row: Row) -> None:
    scale = Scale()
    first, second = (job(row, 3, scale, DATA, ROOT) for job in (stage1_job, stage2_job))
    one, two = parsed(first), parsed(second)
    for options in (one, two):
        assert (options.data, options.val, options.test) == (DATA.source, DATA.val, DATA.test)
    assert second.stage1 == first.folder
    assert (two.steps, two.batch, two.seed) == (scale.stage2_steps, scale.batch, 3)
    if isinstance(one, train_hfsq.Options):
        assert (one.steps, one.batch, one.seed) == (scale.stage1_steps, scale.batch, 3)
    if isinstance(two, train_denoiser.Options):
        assert isinstance(one, train_hfsq.Options)
        assert len(two.loss.layers) == len(two.denoiser.depths) == one.hfsq.layers
        assert sum(two.denoiser.depths) == 4, "as many layers in every row"


def test_rows_change_what_their_names_say() -> None:
    def options(number: int, name: str):
        row = next(r for r in TABLES[number].rows if r.name == name)
        return tuple(parsed(job(row, 0, Scale(), DATA, ROOT)) for job in (stage1_job, stage2_job))

    assert options(2, "HFSQ without PM")[0].hfsq.masking is None
    assert options(2, "HFSQ with PM")[0].hfsq.masking is not None
    assert options(2, "RVQ-VAE with PM")[0].hfsq.quantiser == "rvq"
    assert options(2, "VAE")[0].hfsq.quantiser == "kl"
    stitched = options(3, "stitching without periodic positions and causal mask")[1]
    assert stitched.diffusion.stitching
    assert (stitched.denoiser.mask, stitched.denoiser.positions) == ("bidirectional", "sinusoidal")
    assert options(3, "stride 64")[1].stride == 64
    assert options(5, "R = 3")[0].hfsq.layers == 3
    assert not options(8, "without the leader")[1].denoiser.condition.leader
    assert not options(8, "without music")[1].denoiser.condition.music
    both = options(8, "both")[1].denoiser.condition
    assert both.leader
    assert both.music


def test_tables_share_trainings_and_seeds_do_not() -> None:
    def folder(number: int, name: str, seed: int = 0, scale: Scale | None = None) -> Path:
        row = next(r for r in TABLES[number].rows if r.name == name)
        return stage2_job(row, seed, scale or Scale(), DATA, ROOT).folder

    ours = folder(2, "HFSQ with PM")
    assert {
        folder(3, "stride 4, blockwise"),
        folder(5, "R = 2"),
        folder(6, "stride 4"),
        folder(8, "both"),
    } == {ours}
    assert folder(3, "stride 16") == folder(6, "stride 16") != ours
    assert folder(2, "HFSQ with PM", 1) != ours
    assert folder(2, "HFSQ with PM", 0, replace(Scale(), stage2_steps=7)) != ours
    first = [stage1_job(r, 0, Scale(), DATA, ROOT).folder for r in TABLES[3].rows]
    assert len(set(first)) == 1, "stage 1 is shared where a row does not concern it"


def counting(folder: Path) -> Job:
    """A job that adds a line to a file of its folder."""
    code = f"p = {str(folder)!r}; open(p + '/count', 'a').write('x')"
    return Job((sys.executable, "-c", code, ""), folder)


def test_what_is_done_is_not_repeated(tmp_path: Path) -> None:
    jobs = [counting(tmp_path / name) for name in ("a", "b", "a")]
    run_all(jobs, 2, lambda _: None)
    run_all(jobs, 2, lambda _: None)
    for name in ("a", "b"):
        assert (tmp_path / name / "count").read_text() == "x"
        assert json.loads((tmp_path / name / "cost.json").read_text())["cpu_minutes"] >= 0


def test_what_was_measured_counts_for_the_same_data_and_weights_alone(tmp_path: Path) -> None:
    job = MeasureJob(TABLES[4].rows[0], (tmp_path,), DATA, (0,), tmp_path)
    weights = tmp_path / "denoiser.safetensors"
    weights.write_bytes(b"1")
    first = job.result
    assert replace(job).result == first
    for changed in (replace(DATA, val=("c",)), replace(DATA, source=Path("other.npz"))):
        assert replace(job, data=changed).result != first
    weights.write_bytes(b"2")
    assert job.result != first


def test_jitter_has_an_interval_over_seeds_and_none_for_one_motion() -> None:
    held_out = made_held_out()
    motions = {
        i.duet.name: [generate_mirrored(i.duet.leader, i.music, seed) for seed in (0, 1)] for i in held_out
    }
    for duet in motions.values():
        duet[1] = duet[1] + np.random.default_rng(1).normal(scale=0.01, size=duet[1].shape)
    numbers = measured(held_out, motions)
    low, high = numbers["interval"]["jitter"]
    assert low < numbers["mean"]["jitter"] < high
    alone = measured(held_out, {name: duet[:1] for name, duet in motions.items()})
    assert alone["interval"]["jitter"] == (alone["mean"]["jitter"],) * 2


def test_a_training_that_was_cut_off_goes_on(tmp_path: Path) -> None:
    """Its checkpoint is there, as after every evaluation."""
    code = f"import sys; open({str(tmp_path / 'options')!r}, 'w').write(' '.join(sys.argv))"
    job = Job((sys.executable, "-c", code, ""), tmp_path / "a")
    (job.folder / "denoiser").mkdir(parents=True)
    for name in ("denoiser.json", "denoiser/state.ckpt"):
        (job.folder / name).touch()
    run_all([job], 1, lambda _: None)
    assert "--resume" in (tmp_path / "options").read_text()
    assert json.loads((job.folder / "cost.json").read_text())["cpu_minutes"] is None


def test_a_training_that_fails_shows_the_end_of_its_log(tmp_path: Path) -> None:
    job = Job((sys.executable, "-c", "raise SystemExit('no such dance')", ""), tmp_path / "a")
    with pytest.raises(RuntimeError, match="no such dance"):
        run_all([job], 1, lambda _: None)


def made(value: float, low: float, high: float, **more: float) -> dict:
    mean = {MEASURES["fid_cd"].key: value, **more}
    return {"mean": mean, "interval": {MEASURES["fid_cd"].key: (low, high)}}


def test_a_table_says_what_can_be_told_apart(tmp_path: Path) -> None:
    table = TABLES[3]
    rows = {"truth": made(0, 0, 0), "nearest neighbour": made(9, 8, 10)}
    values = ((20, 15, 25), (8, 7, 9), (10, 9.5, 14), (10, 9.2, 11))
    rows |= {row.name: made(*v, seconds=1.5) for row, v in zip(table.rows, values, strict=True)}
    said = verdicts(table, rows)
    assert said[0].startswith(
        "FID_cd, beside *stride 4, blockwise*: better: stride 16; worse: stride 64; not told"
    )
    text, data, image = write_table(tmp_path, table, rows, {"note": "Small.", "seeds": [0]})
    assert "| stride 64 | 20.0 (15.0 to 25.0) |" in text.read_text()
    assert "| stride 64 | 39.5 |  |" in text.read_text(), "the paper's row"
    assert json.loads(data.read_text())["rows"]["stride 16"]["fid_cd"] == [8, 7, 9]
    assert image.stat().st_size > 1000


def test_measures_that_should_be_near_the_truth_are_judged_by_their_distance() -> None:
    table, key = TABLES[3], MEASURES["div_cd"].key

    def row(value: float, low: float, high: float) -> dict:
        return {"mean": {key: value}, "interval": {key: (low, high)}}

    rows = {"truth": row(10, 10, 10)}
    values = (row(16, 15, 17), row(10.5, 10.4, 10.6), row(8, 7, 9), row(12, 11.5, 12.5))
    rows |= {r.name: v for r, v in zip(table.rows, values, strict=True)}
    said = next(line for line in verdicts(table, rows) if line.startswith("Div_cd"))
    assert "better: stride 16; worse: stride 64; not told apart: stitching" in said


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (1e-13, "0"), (0.01234, "0.0123"), (1.234, "1.23"), (12.34, "12.3"), (1234.5, "1234")],
)
def test_numbers_have_three_digits(value: float, text: str) -> None:
    assert digits(value) == text


def test_a_value_that_is_not_there_leaves_its_cell_empty() -> None:
    assert cell({"mean": {}, "interval": {}}, MEASURES["bas"]) is None
    assert cell({"mean": {"bas": float("nan")}, "interval": {}}, MEASURES["bas"]) is None


def test_wrong_options_are_refused_in_one_sentence() -> None:
    given = {"data": Path("d"), "val": ("a",), "test": ("b",)}
    with pytest.raises(ValueError, match="no table 7 here: give one of 1, 2, 3, 4, 5, 6, 8"):
        Options(table=(7,), **given)
    with pytest.raises(ValueError, match="give them with --checkpoint"):
        Options(table=(4,), **given)
    with pytest.raises(ValueError, match="for table 4 alone"):
        Options(table=(3,), checkpoint=Path("x"), **given)
    with pytest.raises(ValueError, match="one or more of each"):
        Options(table=(3,), seeds=(), **given)
    with pytest.raises(ValueError, match="--processes 0 is not at least 1"):
        Options(table=(3,), processes=0, **given)
    with pytest.raises(ValueError, match="leave --seeds and --scale out"):
        Options(table=(4,), checkpoint=Path("x"), seeds=(0,), **given)
    with pytest.raises(ValueError, match=r"--scale\.width 15 cannot be shared by 4 heads"):
        Options(table=(3,), scale=Scale(width=15), **given)
