"""What a person reads who gives a program something wrong."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.python.support.duets import made_duet
from training.command_line import run_program
from training.data.splits import split
from training.generate import Options


def failing(error: type[Exception]) -> None:
    raise error("a mistake in the code")


def test_what_the_project_finds_wrong_is_one_sentence(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    line = ["generate", "--checkpoint", "a", "--leader", "b.npz", "--out", "c"]
    monkeypatch.setattr(sys, "argv", line)
    with pytest.raises(SystemExit, match=r"^not among the duets: \['x'\]; there are a$"):
        run_program(lambda options: split([made_duet(4, 1, "a")], ["x"], []), Options)
    with pytest.raises(SystemExit, match=r"^\[Errno 2\] No such file or directory: 'b\.npz'$"):
        run_program(lambda options: np.load(options.leader), Options)
    monkeypatch.setattr(sys, "argv", [*line, "--music-guidance", "3"])
    with pytest.raises(SystemExit):
        run_program(lambda options: None, Options)
    assert "--music-guidance weighs a song" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("module", "words"),
    [
        ("training.train_hfsq", "Trains stage 1, the HFSQ autoencoder"),
        ("training.experiments", "Repeat a table"),
    ],
)
def test_help_begins_with_a_call_that_runs_and_says_what_the_program_does(module: str, words: str) -> None:
    call = [sys.executable, "-m", module, "--help"]
    said = subprocess.run(
        call, check=True, capture_output=True, text=True, env=os.environ | {"COLUMNS": "120"}
    ).stdout
    assert f"usage: python -m {module} " in said
    assert words in said


@pytest.mark.parametrize("error", [ValueError, RuntimeError, TypeError])
def test_other_errors_keep_their_traceback(monkeypatch: pytest.MonkeyPatch, error: type[Exception]) -> None:
    monkeypatch.setattr(sys, "argv", ["generate", "--checkpoint", "a", "--leader", "b.npz", "--out", "c"])
    with pytest.raises(error, match="a mistake in the code"):
        run_program(lambda options: failing(error), Options)
    with pytest.raises(ValueError, match="could not convert"):
        run_program(lambda options: float("x"), Options)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"leader": Path("b.bvh"), "duet": "one"}, "a file that holds one dancer"),
        ({"fps": 30.0}, "--fps is the frame rate of a BVH file"),
        ({"leader": Path("b.bvh"), "fps": 0.0}, "--fps 0 is not between 5 and 1000"),
        ({"music_guidance": 3.0}, "add --song"),
        ({"seeds": ()}, "give one or more --seeds"),
        ({"coarse": float("nan")}, "finite numbers"),
    ],
)
def test_a_dance_is_not_made_with_options_that_would_be_ignored(changes: dict, sentence: str) -> None:
    given: dict[str, Any] = {"checkpoint": Path("a"), "leader": Path("b.npz"), "out": Path("c")}
    with pytest.raises(ValueError, match=sentence):
        Options(**given | changes)
