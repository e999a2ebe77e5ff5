"""The cache of predictions: the same dances, from fewer passes of the network."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from torch import Tensor

from export.runtime import open_model
from tests.python.support.duets import made_duet
from training.diffusion import cached_model
from training.diffusion.cached_model import CachedModel
from training.diffusion.model import ReactionModel
from training.diffusion.react import Request, react

TINY = Path(__file__).parents[2] / "fixtures/tiny-model"


@dataclass
class Counting:
    """The tiny exported model, counting its passes."""

    model: ReactionModel = field(default_factory=lambda: open_model(TINY))
    passes: int = 0

    def __getattr__(self, name: str) -> object:
        return getattr(self.model, name)

    def predict(self, *inputs: Tensor) -> Tensor:
        self.passes += 1
        return self.model.predict(*inputs)


@pytest.mark.parametrize("settings", [{}, {"guidance": (0.5, 0.5), "variety": 1.5}, {"seed": 1}])
def test_dances_are_the_same(settings: dict):
    leader = made_duet(200, 1).leader
    plain, cached = Counting(), CachedModel(Counting())  # pyright: ignore[reportArgumentType]
    for request in (Request(leader), Request(leader, **settings), Request(leader)):
        np.testing.assert_array_equal(react(cached, request), react(plain.model, request))


def test_a_moved_control_needs_no_pass():
    leader, counting = made_duet(200, 1).leader, Counting()
    model = CachedModel(counting)  # pyright: ignore[reportArgumentType]
    react(model, Request(leader, guidance=(0.5, 0.0), variety=1.5))
    before = counting.passes
    react(model, Request(leader, guidance=(-0.5, 1.0), variety=0.5))
    assert counting.passes == before > 0


def test_the_oldest_predictions_are_forgotten(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(cached_model, "MAX_PREDICTIONS", 2)
    leader, counting = made_duet(200, 1).leader, Counting()
    model = CachedModel(counting)  # pyright: ignore[reportArgumentType]
    react(model, Request(leader, steps=4))
    first = counting.passes
    react(model, Request(leader, steps=4))
    assert counting.passes == 2 * first
    assert len(model._predictions) == 2
