"""Distillation: what the student is asked and should answer, and the program for a few steps on made duets."""

from __future__ import annotations

import copy
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from export.tiny import tiny_model
from tests.python.support.duets import made_duet
from tests.python.support.small_training import stage1, stage2, write_duets
from training import distill, train_denoiser, train_hfsq
from training.checkpoint import load_model, read_config
from training.config import STRIDE, write_json
from training.denoiser.clips import Augmentation, make_clip
from training.denoiser.windows import Batch, Windows
from training.diffusion.model import Model
from training.diffusion.sampler import sample_branches
from training.distill import Distillation, Options, student_diffusion


@pytest.fixture(scope="module")
def tiny() -> Model:
    return tiny_model()


@pytest.fixture(scope="module")
def batch(tiny: Model) -> Batch:
    """Whole windows and short ones."""
    config = replace(tiny.denoiser.config.condition, leader_shift=0, blurred=0.0, drop_music=0.0)
    song = np.random.default_rng(0).normal(size=(300, 54)).astype(np.float32)
    clip = make_clip(made_duet(300, 3), [song], 0.0, tiny.hfsq, tiny.frame, blur=6.0)
    block, margin = tiny.denoiser.config.block, tiny.denoiser.condition.receptive_field
    return Windows([clip], block, margin, STRIDE, config).batch(
        4, np.random.default_rng(0), short=0.5, song_ends=0.5
    )


def test_the_teacher_is_sampled_as_a_dance_is(tiny: Model, batch: Batch) -> None:
    teacher = replace(tiny, diffusion=replace(tiny.diffusion, extrapolation=(0.5, 0.25, 0.0)))
    stage = Distillation(teacher.denoiser, teacher.denoiser, teacher.diffusion)
    memory, keep = stage._branches(batch)
    n = len(batch.latents)
    noise = torch.randn(batch.latents.shape, generator=torch.Generator().manual_seed(1))
    with torch.no_grad():
        made = stage._sample_teacher(noise.repeat(3, 1, 1, 1), memory, batch.valid.repeat(3, 1), keep)
    whole = [i for i in range(n) if batch.valid[i].min() > 0]
    assert whole, "a window of a whole block is a dance of one block"
    steps = tiny.sampling.ddim()
    for i in whole:
        branches = sample_branches(teacher, memory[i], memory[n + i], noise[i], steps, torch.zeros(()))
        names = ("conditional", "silent", "unconditional")
        for at, name in zip((i, n + i, 2 * n + i), names, strict=True):
            # Both are clamped before they are decoded.
            wanted = torch.minimum(
                torch.maximum(getattr(branches, name), tiny.denoiser.lowest), tiny.denoiser.highest
            )
            torch.testing.assert_close(made[at], wanted, rtol=0, atol=1e-5)


def test_a_student_that_samples_as_the_teacher_does_has_no_loss_and_another_has(
    tiny: Model, batch: Batch
) -> None:
    # A teacher that is sampled in one step itself is such a student, if nothing is dropped out.
    one_step = student_diffusion(tiny.diffusion, None)
    student = copy.deepcopy(tiny.denoiser).train()
    assert student.config.dropout > 0
    loss, parts = Distillation(student, tiny.denoiser, one_step)(batch)
    assert set(parts) == {"latents", "speed", "music", "conditions"}
    assert float(loss) < 1e-9
    _, parts = Distillation(student, tiny.denoiser, tiny.diffusion)(batch)
    assert all(float(value) > 1e-6 for value in parts.values()), parts


def test_a_student_is_asked_where_its_only_step_begins_and_of_one_noise_for_all_branches(
    tiny: Model, batch: Batch
) -> None:
    student = copy.deepcopy(tiny.denoiser)
    asked: list[tuple[torch.Tensor, ...]] = []
    student.register_forward_pre_hook(lambda _, given: asked.append(given))
    Distillation(student, tiny.denoiser, tiny.diffusion)(batch)
    ((noise, time, *_),) = asked
    one_step = student_diffusion(tiny.diffusion, None)
    (only,) = replace(tiny, diffusion=one_step).sampling.ddim()
    assert time.tolist() == pytest.approx([only.time] * len(time))
    for branch in noise.split(len(batch.latents))[1:]:
        assert torch.equal(branch, noise[: len(batch.latents)])


def test_frames_that_no_dance_fills_do_not_count(tiny: Model, batch: Batch) -> None:
    stage = Distillation(tiny.denoiser, tiny.denoiser, tiny.diffusion)
    mean = distill.WeightedSquares(batch.valid, 2)
    error = torch.ones_like(batch.latents)
    error[batch.valid == 0] = 1e6
    # Of both layers, the finer at half weight: a mean.
    assert float(mean(error)) == pytest.approx(1.0)
    assert float(mean(error.diff(dim=1))) == 0.0
    error[:, :, 1] = 0
    assert float(mean(error)) == pytest.approx(1 / 1.5), (
        "the coarse layer has twice the weight of the fine one"
    )
    loss, _ = stage(batch)
    assert loss.isfinite()


def test_the_song_part_is_weighted_by_the_constant_and_is_of_what_the_song_changes(
    tiny: Model, batch: Batch
) -> None:
    """MUSIC_WEIGHT times the mean square of the error with the song less that without it."""
    stage = Distillation(tiny.denoiser, tiny.denoiser, tiny.diffusion)
    torch.manual_seed(7)
    _, parts = stage(batch)
    torch.manual_seed(7)
    noise = torch.randn_like(batch.latents).repeat(3, 1, 1, 1)
    memory, keep = stage._branches(batch)
    given = (noise, memory, batch.valid.repeat(3, 1), keep)
    error = distill.predict(tiny.denoiser, *given, stage.steps[0]) - stage._sample_teacher(*given)
    with_song, silent, unconditional = error.split(len(batch.latents))
    mean = distill.WeightedSquares(batch.valid, 2)
    assert float(parts["music"]) > 0
    assert float(parts["music"]) == pytest.approx(
        distill.MUSIC_WEIGHT * float(mean(with_song - silent)), rel=1e-5
    )
    assert float(parts["conditions"]) == pytest.approx(float(mean(silent - unconditional)), rel=1e-5)


def test_the_loss_falls_and_the_condition_stays(tiny: Model, batch: Batch) -> None:
    student = copy.deepcopy(tiny.denoiser).requires_grad_(True)
    student.condition.requires_grad_(False)
    before = {key: value.clone() for key, value in student.condition.state_dict().items()}
    stage = Distillation(student, tiny.denoiser, tiny.diffusion)
    optimizer = torch.optim.AdamW([p for p in student.parameters() if p.requires_grad], lr=1e-3)
    losses = []
    for _ in range(40):
        torch.manual_seed(5)  # the same noise, so that the losses compare
        loss, _ = stage(batch)
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
        losses.append(float(loss))
    assert losses[-1] < 0.7 * losses[0]
    for key, value in student.condition.state_dict().items():
        assert torch.equal(value, before[key]), key


@pytest.fixture(scope="module")
def trained(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Duets and a checkpoint of both stages."""
    folder = tmp_path_factory.mktemp("teacher")
    data = write_duets(folder)
    train_hfsq.main(stage1(data, folder))
    train_denoiser.main(stage2(data, folder))
    return data, folder


def options(data: Path, teacher: Path, out: Path, **changes: object) -> Options:
    base = Options(
        data=data, out=out, teacher=teacher, val=("made_1",), test=("made_2",), steps=2, batch=4, synths=1,
        log_every=1, evaluate_every=2, augmentation=Augmentation(tempos=(1.0,), copies=1),
        precision="32-true",
    )  # fmt: skip
    return replace(base, **changes)


def test_the_program_leaves_a_checkpoint_that_samples_in_one_step_and_goes_on(
    trained: tuple[Path, Path], tmp_path: Path
) -> None:
    data, teacher = trained
    distill.main(options(data, teacher, tmp_path))
    assert load_model(tmp_path).sampling.music_guidance == load_model(teacher).sampling.music_guidance
    distill.main(options(data, teacher, tmp_path, steps=4, resume=True, music_guidance=3.0))
    steps = [
        line for line in (tmp_path / "distill" / "log.jsonl").read_text().splitlines() if "latents" in line
    ]
    assert len(steps) == 4
    student, taught = load_model(tmp_path), load_model(teacher)
    provenance = read_config(tmp_path, "denoiser")["provenance"]
    assert provenance["before"] == read_config(teacher, "denoiser")["provenance"]
    assert (student.sampling.steps, student.sampling.music_guidance) == (1, 3.0)
    assert set(student.sampling.extrapolation) == {0.0}
    assert student.sampling.reference_height == taught.sampling.reference_height
    for key, value in taught.denoiser.condition.state_dict().items():
        torch.testing.assert_close(student.denoiser.condition.state_dict()[key], value, rtol=0, atol=0)
    assert any(
        not torch.equal(value, taught.denoiser.state_dict()[key])
        for key, value in student.denoiser.state_dict().items()
    )


def test_a_student_does_not_go_on_with_another_teacher(trained: tuple[Path, Path], tmp_path: Path) -> None:
    """The checkpoint would name a teacher that it has not learnt from."""
    data, teacher = trained
    distill.main(options(data, teacher, tmp_path / "out"))
    for name, change in (("teacher", {}), ("sampling of the teacher", {"steps": 5})):
        other = tmp_path / name
        shutil.copytree(teacher, other)
        if change:
            config = read_config(other, "denoiser")
            write_json(other / "denoiser.json", config | {"diffusion": config["diffusion"] | change})
        else:
            train_denoiser.main(stage2(data, other, seed=1))
        with pytest.raises(ValueError, match=f"state.ckpt: it is of another {name} than there is now"):
            distill.main(options(data, other, tmp_path / "out", steps=4, resume=True))


def test_options_that_would_be_ignored_or_overwrite_the_teacher_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="leave --init out"):
        options(tmp_path, tmp_path, tmp_path / "out", init=tmp_path)
    with pytest.raises(ValueError, match="would be overwritten"):
        options(tmp_path, tmp_path, tmp_path)
