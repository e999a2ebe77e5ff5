"""The evaluation program: the tiny exported model, and the shipped numbers."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from export.evaluate import Options, main, paired_duets, reactor_generator
from export.golden import Scene
from export.manifest import Card
from export.runtime import open_model
from export.tiny import tiny_model
from export.write import write_model
from tests.python.support.bodies import TRAINING_BODIES
from tests.python.support.duets import made_duet
from tests.python.support.real_data import real_file
from training.checkpoint import (
    load_model,
    read_card,
    save_denoiser,
    save_hfsq,
    write_card,
)
from training.data.sources import read_split
from training.data.splits import Split
from training.denoiser.denoiser import Denoiser
from training.diffusion.model import Model
from training.distill import student_diffusion
from training.evaluation.metrics.duet import duet_metrics
from training.evaluation.metrics.errors import mpjpe
from training.evaluation.protocol import Settings
from training.music.recipe import MUSIC_FEATURES

TINY = Path(__file__).parents[2] / "fixtures/tiny-model"
SHIPPED = Path(__file__).parents[3] / "web/public/models/salsa"
CHECKPOINTS = Path(__file__).parents[3] / "training/checkpoints"


def test_every_argument_of_a_generator_reaches_the_model() -> None:
    duet = made_duet(60, 1)
    music = np.random.default_rng(0).normal(size=(60, MUSIC_FEATURES))
    generate = reactor_generator(open_model(TINY, threads=1))
    changes = {
        "music": None,
        "seed": 1,
        "condition_leader": duet.reactor,
        "guidance": (0.5, 0.0),
        "music_guidance": 3.0,
        "variety": 0.5,
        "role": 1.0,
    }
    given = {"leader": duet.leader, "music": music, "seed": 0}
    usual = generate(**given)
    assert np.array_equal(usual, generate(**given))
    for name, value in changes.items():
        assert not np.allclose(usual, generate(**given | {name: value}), atol=1e-4), name
    fewer = reactor_generator(open_model(TINY, threads=1), steps=1)
    assert not np.allclose(usual, fewer(**given), atol=1e-4)


def write_duets_and_checkpoint(folder: Path, model: Model) -> Path:
    """Writes duets.npz with train, val, one and two, 300 frames each, and the checkpoint of a model that held out val
    and one alone; it is returned.
    """
    duets = [made_duet(300, seed, name) for seed, name in enumerate(("train", "val", "one", "two"))]
    archive = {
        f"{d.name}/{role}": m for d in duets for role, m in (("leader", d.leader), ("follower", d.reactor))
    }
    np.savez(folder / "duets.npz", **archive)  # pyright: ignore[reportArgumentType]
    checkpoint = folder / "checkpoint"
    provenance = {"options": {"val": "('val',)", "test": "('one',)"}}
    save_hfsq(checkpoint, model.hfsq, model.frame, provenance)
    save_denoiser(checkpoint, model.hfsq, model.denoiser, model.diffusion, provenance)
    write_card(checkpoint, model.reference_height, 1.4, TRAINING_BODIES, 1.2)
    return checkpoint


def test_validation_duets_are_measured_with_seams_at_the_ends_of_the_models_own_blocks(tmp_path: Path):
    tiny = tiny_model()
    config = replace(tiny.denoiser.config, block=30)
    denoiser = Denoiser(tiny.hfsq.latent_width, tiny.hfsq.layers, config)
    checkpoint = write_duets_and_checkpoint(tmp_path, replace(tiny, denoiser=denoiser))
    settings = Settings(seeds=(0,), seam_starts=(0,), response_seeds=1, two_sample=False)
    main(
        Options(
            data=tmp_path / "duets.npz", out=tmp_path / "out", checkpoint=checkpoint, val=("val", "two"),
            test=("one",), measure="val", pictures=False, videos=False, music=False, settings=settings,
        )
    )  # fmt: skip
    stored = json.loads((tmp_path / "out/metrics.json").read_text())
    assert stored["seams"]["seams"] == 2 * 2, "frames 120 and 240 of two duets"
    assert stored["seen"] == ["two"], "of those that are measured"


def test_the_program_measures_an_exported_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    checkpoint = write_duets_and_checkpoint(tmp_path, tiny_model())
    main(
        Options(
            data=tmp_path / "duets.npz", out=tmp_path / "out", model=TINY, checkpoint=checkpoint,
            val=("val",), test=("one", "two"), pictures=False, videos=False, music=False,
            settings=Settings(
                seeds=(0, 1), seam_starts=(0,), response_seeds=1, two_sample=False, guidance_grid=(0.0, 1.2)
            ),
        )
    )  # fmt: skip
    stored = json.loads((tmp_path / "out/metrics.json").read_text())
    assert stored["runtime"] == "onnxruntime"
    assert stored["split"] == {"train": ["train"], "val": ["val"], "test": ["one", "two"]}
    assert stored["seen"] == ["two"]
    report = (tmp_path / "out/report.md").read_text()
    assert "Data duets.npz, training: train; validation: val; test: one, two. Model tiny under" in report
    assert f"Machine: {stored['machine']}." in report
    assert "**Not held out: two." in report
    assert "Not held out: two." in " ".join(capsys.readouterr().out.split())
    assert stored["rows"]["generated"]["mean"]["mpjpe_mm"] > 0
    nearest = stored["rows"]["nearest neighbour"]["mean"]["mpjpe_mm"]
    assert nearest > 50, "of the training duets; among the measured ones it is the truth"
    weights = {"coarse": 0.0, "fine": 0.0, "music": 1.0, "variety": 1.0}
    how = {"steps": 4, "last_time": 0.25, "extrapolation": [0.0, 0.0, 0.0]}
    assert stored["sampling"] == how | weights
    assert stored["seams"]["seams"] == 2 * 2, "one boundary in 300 frames, two duets, two seeds"
    # Guidance at every step, of the checkpoint: each cell is another dance.
    assert len({cell["mpjpe_mm"] for cell in stored["guidance"]}) == 4
    guided = next(cell for cell in stored["guidance"] if (cell["coarse"], cell["fine"]) == (0.0, 1.2))
    generate = reactor_generator(load_model(checkpoint), at_every_step=True)
    errors = [
        mpjpe(duet.reactor, generate(duet.leader, None, 0, guidance=(0.0, 1.2)))
        for duet in read_split(tmp_path / "duets.npz", ("val",), ("one", "two")).test
    ]
    assert guided["mpjpe_mm"] == pytest.approx(np.mean(errors), rel=1e-4)


def test_a_folder_that_cannot_be_made_is_refused_before_anything_is_measured(tmp_path: Path):
    write_duets_and_checkpoint(tmp_path, tiny_model())
    (tmp_path / "file").touch()
    # With no model there, only what comes before the measuring can fail in this way.
    with pytest.raises(NotADirectoryError, match="file/out"):
        main(
            Options(
                data=tmp_path / "duets.npz", out=tmp_path / "file/out", checkpoint=tmp_path / "none",
                val=("val",), test=("one", "two"), music=False,
            )
        )  # fmt: skip


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"model": None}, "give --model"),
        ({"settings": Settings(seeds=())}, "one or more --settings.seeds"),
        ({"music": False, "songs": Path("songs")}, "--songs are not read"),
        ({"settings": Settings(guidance_grid=(1.0,))}, "give --checkpoint"),
        ({"controlled": (Path("leader.bvh"),)}, "are for --settings.controls"),
        ({"settings": Settings(seen_leaders=("indian",))}, "of --out-of-distribution"),
        ({"settings": Settings(beats_unknown=("three",))}, r"not measured \(one, two are\)"),
    ],
)
def test_options_that_would_be_ignored_are_refused(changes: dict, sentence: str):
    given = {"data": Path("duets.npz"), "out": Path("out"), "model": TINY, "test": ("one", "two")}
    with pytest.raises(ValueError, match=sentence):
        Options(**given | changes)


def test_the_duets_that_are_measured_are_those_that_were_asked_for():
    duets = Split((), (made_duet(60, 1, "chosen by"),), (made_duet(60, 2, "kept"),))
    options = Options(data=Path("duets.npz"), out=Path("out"), model=TINY, music=False)
    for measure, name in (("val", "chosen by"), ("test", "kept")):
        (held_out,) = paired_duets(replace(options, measure=measure), duets)
        assert held_out.duet.name == name
        assert held_out.music is None
    with pytest.raises(ValueError, match="name them with --val"):
        paired_duets(replace(options, measure="val"), replace(duets, val=()))


def test_the_shipped_model_is_that_of_the_held_out_recipe():
    """Both checkpoints have the same networks, schedule and sampling; they differ in the dances that they saw."""
    shipped, held_out = (load_model(CHECKPOINTS / name) for name in ("salsa", "salsa-held-out"))
    assert shipped.diffusion == held_out.diffusion
    assert shipped.denoiser.config == held_out.denoiser.config
    assert shipped.frame == held_out.frame
    assert shipped.hfsq.config == held_out.hfsq.config


@pytest.mark.parametrize("name", ["salsa", "salsa-held-out"])
def test_a_student_has_stage_1_and_condition_of_its_teacher_and_one_step(name: str):
    student, teacher = (load_model(CHECKPOINTS / f"{name}{suffix}") for suffix in ("", "-teacher"))
    assert student.diffusion == student_diffusion(teacher.diffusion, student.sampling.music_guidance)
    assert student.sampling.steps == 1
    for of_student, of_teacher in (
        (student.hfsq, teacher.hfsq),
        (student.denoiser.condition, teacher.denoiser.condition),
    ):
        known = of_teacher.state_dict()
        assert all(torch.equal(value, known[key]) for key, value in of_student.state_dict().items())


def test_the_shipped_numbers_are_those_of_the_held_out_checkpoint(tmp_path: Path):
    """metrics.json beside the manifest: one dance of it generated and measured again."""
    checkpoint = CHECKPOINTS / "salsa-held-out"
    stored = json.loads((SHIPPED / "metrics.json").read_text())
    assert stored["model"] == json.loads((checkpoint / "card.json").read_text())["id"]
    assert all(result["passed"] for result in stored["required"])
    data = real_file("cmu_salsa/duets.npz")
    write_model(load_model(checkpoint), Card(**read_card(checkpoint)), tmp_path, Scene(240, silent_from=200))
    model = open_model(tmp_path, threads=1)
    val, test = (tuple(stored["split"][part]) for part in ("val", "test"))
    options = Options(data=data, out=Path(), model=tmp_path, val=val, test=test)
    held_out = paired_duets(options, read_split(options.data, options.val, options.test))[0]
    sampling = stored["sampling"]
    made = reactor_generator(model, sampling["steps"])(
        held_out.duet.leader,
        held_out.music,
        stored["seeds"][0],
        guidance=(sampling["coarse"], sampling["fine"]),
        music_guidance=sampling["music"],
        variety=sampling["variety"],
    )
    known = stored["rows"]["generated"]["trials"][held_out.duet.name]["seeds"][0]
    again = duet_metrics(held_out.duet.leader, held_out.duet.reactor, made, held_out.music)
    # Rounding to 8 bits turns differences of single precision between machines into millimetres.
    for key in ("mpjpe_mm", "root_error_mm", "speed_ratio", "skate_share", "hands_w1_m", "bone_variation"):
        assert again[key] == pytest.approx(known[key], rel=0.05, abs=1e-5), key
