"""Fixtures of the evaluation's tests."""

from __future__ import annotations

import pytest

from tests.python.support.held_out import made_held_out, made_train
from training.data.duet import Duet
from training.evaluation.protocol import HeldOutDuet


@pytest.fixture(scope="module")
def held_out() -> list[HeldOutDuet]:
    return made_held_out()


@pytest.fixture(scope="module")
def train() -> list[Duet]:
    return made_train()
