"""A training that was cut off goes on as the same one, or not at all."""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest
import torch
from lightning_fabric import Fabric

from tests.python.support.small_training import HFSQ, stage1, write_duets
from training import train_hfsq
from training.checkpoint import load_hfsq
from training.loop.run import Run, flat_options


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_duets(tmp_path_factory.mktemp("data"))


def steps_logged(folder: Path) -> list[int]:
    return [json.loads(line)["step"] for line in (folder / "log.jsonl").read_text().splitlines()]


def stop_before(step_of: Callable[..., None], step: int, error: BaseException) -> Callable[..., None]:
    """A training step that fails with an error after `step` of them."""

    def stopping(run: Run, batch: object) -> None:
        if run.schedule.step == step:
            raise error
        step_of(run, batch)

    return stopping


def interrupt_in(step_of: Callable[..., None], step: int) -> Callable[..., None]:
    """A training step in the middle of which Ctrl-C is pressed, in the one with this number."""

    def pressing(run: Run, batch: object) -> None:
        if run.schedule.step + 1 == step:
            os.kill(os.getpid(), signal.SIGINT)
        step_of(run, batch)

    return pressing


def test_training_resumes_where_it_stopped(data: Path, tmp_path: Path) -> None:
    """Weights and log are those of a training that did not stop."""
    whole, stopped = stage1(data, tmp_path / "whole", steps=4), stage1(data, tmp_path / "stopped", steps=4)
    train_hfsq.main(whole)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("training.train_hfsq.Run._step", stop_before(Run._step, 3, OSError("no space left")))
        with pytest.raises(OSError, match="no space left"):
            train_hfsq.main(stopped)
    assert torch.load(stopped.out / "hfsq" / "state.ckpt", weights_only=False)["step"] == 2
    assert max(steps_logged(stopped.out / "hfsq")) == 3
    with (stopped.out / "hfsq" / "log.jsonl").open("a") as log:
        log.write('{"step": 3, "minu')  # as a killed program leaves it
    train_hfsq.main(replace(stopped, resume=True))
    assert steps_logged(stopped.out / "hfsq") == steps_logged(whole.out / "hfsq")
    weights, expected = (load_hfsq(options.out)[0].state_dict() for options in (stopped, whole))
    for name, value in expected.items():
        assert torch.equal(weights[name], value), name


def test_no_step_is_lost_by_an_interruption_or_at_the_end(data: Path, tmp_path: Path) -> None:
    options = stage1(data, tmp_path, steps=4, evaluate_every=100)

    def saved_step() -> int:
        return torch.load(tmp_path / "hfsq" / "state.ckpt", weights_only=False)["step"]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("training.train_hfsq.Run._step", interrupt_in(Run._step, 3))
        with pytest.raises(SystemExit, match="stopped after step 3; go on with --resume"):
            train_hfsq.main(options)
    assert saved_step() == 3
    train_hfsq.main(replace(options, resume=True))
    assert steps_logged(tmp_path / "hfsq") == [1, 2, 3, 4, 4], "the last row is the measures"
    assert saved_step() == 4


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"hfsq": replace(HFSQ, groups=4)}, r"--hfsq\.groups \(it was 2\)"),
        ({"hfsq": replace(HFSQ, levels=(7, 5, 5, 5))}, r"--hfsq\.levels \(it was \(8, 5, 5, 5\)\)"),
        ({"val": ("made_0",)}, r"--val \(it was \('made_1',\)\)"),
        ({"learn_all": True}, r"--learn-all \(it was False\)"),
        ({"seed": 5}, r"--seed \(it was 0\)"),
        ({"learning_rate": 1e-5}, r"--learning-rate \(it was 0\.0003\)"),
        ({"solo": Path("solo.npz")}, r"--solo \(it was None\)"),
    ],
)
def test_a_training_does_not_go_on_as_another_one(
    data: Path, tmp_path: Path, changes: dict, sentence: str
) -> None:
    """Another split, above all: the checkpoint would say that dances were held out that it has learnt from."""
    state = tmp_path / "state.ckpt"
    torch.save({"options": flat_options(stage1(data, tmp_path))}, state)
    options = stage1(data, tmp_path, resume=True, steps=4, **changes)
    run = cast(Run, SimpleNamespace(state=state, fabric=Fabric(), options=options))
    with pytest.raises(ValueError, match=sentence):
        Run.load(run)


def test_a_damaged_state_is_named(data: Path, tmp_path: Path) -> None:
    train_hfsq.main(stage1(data, tmp_path))
    state = tmp_path / "hfsq/state.ckpt"
    state.write_bytes(state.read_bytes()[:1000])
    with pytest.raises(ValueError, match=r"state\.ckpt: the file is damaged"):
        train_hfsq.main(stage1(data, tmp_path, resume=True, steps=4))


def test_a_training_in_the_folder_of_an_earlier_one_begins_its_own_log(data: Path, tmp_path: Path) -> None:
    for _ in range(2):
        train_hfsq.main(stage1(data, tmp_path))
    assert steps_logged(tmp_path / "hfsq").count(1) == 1
