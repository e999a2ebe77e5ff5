"""What both training programs share: schedule, averaging, logging with curves, resumable state."""

from __future__ import annotations

import copy
import json
import math
import time
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path
from typing import Generic, Literal, TypeVar

import torch
from lightning_fabric import Fabric
from torch import Tensor, nn
from torch.utils.tensorboard import SummaryWriter

Precision = Literal["32-true", "bf16-mixed", "16-mixed"]
M = TypeVar("M", bound=nn.Module)


def fast_precision() -> Precision:
    """bf16 on a GPU and on processors with matrix tiles; without tiles its products are slower than single ones."""
    tiles = torch.cpu._is_amx_tile_supported()
    return "bf16-mixed" if torch.accelerator.is_available() or tiles else "32-true"


@dataclass
class Budget:
    """How far a training has come: by steps, or by minutes if a time limit is given and reached first."""

    steps: int
    minutes: float | None
    step: int = 0
    spent: float = 0.0  # seconds, over all resumed parts
    _since: float = field(default_factory=time.monotonic)

    def tick(self) -> None:
        now = time.monotonic()
        self.spent += now - self._since
        self._since = now
        self.step += 1

    @property
    def progress(self) -> float:
        """0 at the start, 1 at the end."""
        by_time = self.spent / (60 * self.minutes) if self.minutes else 0.0
        by_steps = self.step / self.steps if self.steps else 1.0
        return min(1.0, max(by_steps, by_time))


def learning_rate(peak: float, budget: Budget, warmup: int) -> float:
    """Linear warm-up over `warmup` steps, then half a cosine down to 2 % of the peak."""
    warm = min(1.0, (budget.step + 1) / warmup)
    return peak * warm * (0.02 + 0.98 * 0.5 * (1 + math.cos(math.pi * budget.progress)))


class Average(Generic[M]):
    """Exponential moving average of a module's parameters (buffers are copied)."""

    def __init__(self, module: M, decay: float) -> None:
        self.module = copy.deepcopy(module).eval().requires_grad_(False)
        self.decay = decay
        self.updates = 0

    @torch.no_grad()
    def update(self, module: nn.Module) -> None:
        self.updates += 1
        # Early on the average would mostly remember the initial weights.
        decay = min(self.decay, self.updates / (self.updates + 10))
        for mine, theirs in zip(self.module.parameters(), module.parameters(), strict=True):
            mine.lerp_(theirs.detach().to(mine.dtype), 1 - decay)
        for mine, theirs in zip(self.module.buffers(), module.buffers(), strict=True):
            mine.copy_(theirs)


class Journal:
    """Numbers of a run: printed, sent to TensorBoard, kept as JSON lines and drawn as curves.png. Rank 0
    only.
    """

    def __init__(self, folder: Path, enabled: bool) -> None:
        self.folder, self.enabled = folder, enabled
        self._sums: dict[str, list[float]] = defaultdict(list)
        if enabled:
            folder.mkdir(parents=True, exist_ok=True)
            self._board = SummaryWriter(str(folder))

    def add(self, values: dict[str, Tensor]) -> None:
        for name, value in values.items():
            self._sums[name].append(float(value))

    def write(self, budget: Budget, extra: dict[str, float] | None = None) -> None:
        """Log the means since the last call, and `extra` as it is."""
        means = {name: sum(v) / len(v) for name, v in self._sums.items()} | (extra or {})
        self._sums.clear()
        if not self.enabled:
            return
        row = {"step": budget.step, "minutes": round(budget.spent / 60, 2), **means}
        with (self.folder / "journal.jsonl").open("a") as file:
            file.write(json.dumps(row) + "\n")
        for name, value in means.items():
            self._board.add_scalar(name, value, budget.step)
        shown = "  ".join(f"{name} {value:.4g}" for name, value in means.items())
        print(
            f"{100 * budget.progress:5.1f} %  step {budget.step}  {row['minutes']} min  {shown}", flush=True
        )

    def draw(self) -> None:
        """Redraw curves.png from the whole journal."""
        if not self.enabled:
            return
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        rows = [json.loads(line) for line in (self.folder / "journal.jsonl").read_text().splitlines()]
        names = sorted({name for row in rows for name in row} - {"step", "minutes"})
        columns = 4
        height = max(1, math.ceil(len(names) / columns))
        figure, axes = plt.subplots(height, columns, figsize=(4 * columns, 2.6 * height), squeeze=False)
        for axis in axes.flat:
            axis.set_visible(False)
        for axis, name in zip(axes.flat, names, strict=False):
            points = [(row["step"], row[name]) for row in rows if name in row]
            axis.plot(*zip(*points, strict=True), lw=1)
            axis.set_title(name, fontsize=9)
            axis.grid(alpha=0.3)
            axis.set_visible(True)
        figure.tight_layout()
        figure.savefig(self.folder / "curves.png", dpi=80)
        plt.close(figure)


def save_state(
    fabric: Fabric,
    path: Path,
    model: nn.Module,
    optimizer: torch.optim.Optimizer,
    average: Average,
    budget: Budget,
) -> None:
    """Everything needed to go on training after a crash, in one file that is replaced only when written
    whole.
    """
    state = {
        "model": model,
        "optimizer": optimizer,
        "average": average.module.state_dict(),
        "updates": average.updates,
        "step": budget.step,
        "spent": budget.spent,
    }
    part = path.with_suffix(".part")
    fabric.save(part, state)
    if fabric.is_global_zero:
        part.replace(path)


def load_state(
    fabric: Fabric,
    path: Path,
    model: nn.Module,
    optimizer: torch.optim.Optimizer,
    average: Average,
    budget: Budget,
) -> None:
    """Inverse of `save_state`, strict."""
    rest = fabric.load(path, {"model": model, "optimizer": optimizer}, strict=True)
    average.module.load_state_dict(rest["average"], strict=True)
    average.updates = rest["updates"]
    budget.step, budget.spent = rest["step"], rest["spent"]
