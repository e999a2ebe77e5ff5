"""The loop of every training: its learning rate, one step, and the average that is saved."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
import torch
from lightning_fabric import Fabric
from torch import Tensor, nn

from tests.python.support.small_training import stage1
from training.loop.ema import Ema
from training.loop.run import Run
from training.loop.schedule import Schedule, learning_rate


def test_the_learning_rate_rises_over_the_warm_up_and_falls_along_half_a_cosine_to_2_percent() -> None:
    def rate(step: int) -> float:
        return learning_rate(2.0, Schedule(1000, None, step), warmup=10)

    assert rate(0) == pytest.approx(0.2, rel=1e-4)
    assert rate(4) == pytest.approx(1.0, rel=1e-3)
    assert rate(500) == pytest.approx(2.0 * 0.51)
    assert rate(250) == pytest.approx(2.0 * (0.02 + 0.49 * (1 + math.sqrt(0.5))))
    assert rate(1000) == pytest.approx(0.04)


def test_a_training_ends_by_steps_or_by_minutes_whichever_comes_first() -> None:
    assert Schedule(100, None, step=25, spent=1e6).progress == 0.25
    assert Schedule(100, 2.0, step=10, spent=60.0).progress == 0.5
    assert Schedule(100, 2.0, step=80, spent=60.0).progress == 0.8
    assert Schedule(100, 2.0, step=10, spent=200.0).progress == 1


def test_time_is_counted_once(monkeypatch: pytest.MonkeyPatch) -> None:
    now = iter([13.0, 14.0])
    monkeypatch.setattr("time.monotonic", lambda: next(now))
    schedule = Schedule(100, 2.0, spent=5.0, _since=10.0)
    schedule.tick()
    schedule.tick()
    assert (schedule.step, schedule.spent) == (2, 9.0)


def test_the_average_forgets_the_first_weights_soon_and_then_follows_slowly() -> None:
    module = nn.BatchNorm1d(1)
    average = Ema(module, 0.5)
    seen = []
    for update, weight in enumerate((11.0, 0.0, 0.0), 1):
        nn.init.constant_(module.weight, weight)
        module.get_buffer("running_mean").fill_(update)
        average.update(module)
        seen.append(float(average.module.weight))
        assert float(average.module.get_buffer("running_mean")) == update, "buffers are copied"
    # From 1: a weight of 10/11 for the first value, then of 10/12 and 10/13 for the zeros.
    assert seen == pytest.approx([1 / 11 + 10, (1 / 11 + 10) * 2 / 12, (1 / 11 + 10) * 2 / 12 * 3 / 13])
    average.updates = 1000
    average.update(module)
    assert float(average.module.weight) == pytest.approx(seen[-1] / 2)
    assert not average.module.training
    assert not any(parameter.requires_grad for parameter in average.module.parameters())


class Slope(nn.Module):
    """A weight whose loss is the batch times the weight; notes whether it was trained as it ran."""

    def __init__(self) -> None:
        super().__init__()
        self.weight = nn.Parameter(torch.zeros(()))
        self.was_training: list[bool] = []

    def forward(self, batch: Tensor) -> tuple[Tensor, dict[str, Tensor]]:
        self.was_training.append(self.training)
        return self.weight * batch, {}


def run_of(tmp_path: Path, **changes: object) -> Run[Slope]:
    options = stage1(Path("duets.npz"), tmp_path, learning_rate=0.5, steps=1000, **changes)
    slope = Slope()
    optimizer = torch.optim.SGD(slope.parameters(), lr=1.0)
    return Run(Fabric(accelerator="cpu"), slope, slope, optimizer, options, tmp_path, 4, {})


def test_a_step_goes_down_its_own_gradient_no_longer_than_1_at_the_rate_of_the_schedule(
    tmp_path: Path,
) -> None:
    run = run_of(tmp_path)
    run.model.eval()
    for gradient, rate in ((0.5, 0.125), (100.0, 0.25), (-0.5, 0.375)):
        before = float(run.model.weight.detach())
        run._step(torch.tensor(gradient))
        assert float(run.model.weight.detach()) - before == pytest.approx(-rate * min(gradient, 1), rel=1e-3)
    assert run.model.was_training == [True] * 3
    with run.averaged() as average:
        assert float(average.weight) != float(run.model.weight.detach())


def test_random_numbers_differ_by_seed_rank_and_step(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Otherwise every stretch between two evaluations, or every device, would learn from the same windows."""
    drawn: list[int] = []
    for seed, rank, step in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 600)):
        run = run_of(tmp_path, seed=seed)
        monkeypatch.setattr(Fabric, "global_rank", rank)
        run.schedule.step = step
        drawn += [int(run._seed().integers(2**40)), int(torch.randint(2**40, ()))]
    assert len(set(drawn)) == 8


def test_a_training_goes_on_at_its_step_and_time_with_its_average(tmp_path: Path) -> None:
    run = run_of(tmp_path)
    for _ in range(3):
        run._step(torch.tensor(1.0))
    run.schedule.spent = 90.0
    run.save()
    again = run_of(tmp_path, resume=True)
    assert (again.schedule.step, again.schedule.spent, again.ema.updates) == (3, 90.0, 3)
    assert torch.equal(again.model.weight, run.model.weight)
    assert torch.equal(again.ema.module.weight, run.ema.module.weight)
