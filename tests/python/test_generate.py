"""A dance from the command line is the one that the page makes of the same leader."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from training.checkpoint import load_model, read_card
from training.data.made import made_dancer
from training.diffusion.react import Request, react
from training.generate import Options, load_generator
from training.motion.other_body import in_body
from training.motion.skeleton import JOINTS

SHIPPED = Path(__file__).parents[2] / "training/checkpoints/salsa"


def test_the_network_gets_the_leader_in_the_body_of_the_training_unless_asked_otherwise(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    leader = made_dancer(60, 1)
    for side in ("left", "right"):  # another rig: shoulders 10 cm higher
        leader[:, JOINTS.index(f"{side}_shoulder"), 1] += 0.1
    given = Options(checkpoint=SHIPPED, leader=Path("leader.npy"), out=Path("out"))
    known = in_body(leader, read_card(SHIPPED)["training_bodies"]["leader"])
    model = load_model(SHIPPED)
    wanted = react(model, Request(leader, seed=1, condition_leader=known))
    assert load_generator(given, leader)(None, 1) == pytest.approx(wanted, abs=1e-5)

    monkeypatch.setenv("PATH", "")
    as_is = load_generator(replace(given, leader_as_is=True), leader)(None, 1)
    assert as_is == pytest.approx(react(model, Request(leader, seed=1)), abs=1e-5)
    assert np.abs(as_is - wanted).max() > 0.05
    with pytest.raises(ValueError, match="Node was not found"):
        load_generator(given, leader)
