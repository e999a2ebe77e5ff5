"""The log of a training and its curves."""

from __future__ import annotations

import json
import math
from collections import defaultdict
from pathlib import Path

from torch import Tensor
from torch.utils.tensorboard import SummaryWriter

from training.loop.schedule import Schedule


class Logger:
    """Numbers of a run: printed, sent to TensorBoard, kept as JSON lines and drawn as curves.png. Rank 0 only."""

    def __init__(self, folder: Path, enabled: bool, step: int) -> None:
        """step: where the run begins or goes on; what the folder's log has of later steps is dropped."""
        self.folder, self.enabled = folder, enabled
        self._sums: dict[str, list[float]] = defaultdict(list)
        if enabled:
            folder.mkdir(parents=True, exist_ok=True)
            self._board = SummaryWriter(str(folder), purge_step=step + 1)
            kept = [row for row in self._rows() if row["step"] <= step]
            self._log.write_text("".join(json.dumps(row) + "\n" for row in kept))

    @property
    def _log(self) -> Path:
        return self.folder / "log.jsonl"

    def _rows(self) -> list[dict[str, float]]:
        """The rows of the log, without a last line that a killed program has not finished."""
        lines = self._log.read_text().splitlines(keepends=True) if self._log.exists() else []
        return [json.loads(line) for line in lines if line.endswith("\n")]

    def add(self, values: dict[str, Tensor]) -> None:
        for name, value in values.items():
            self._sums[name].append(float(value))

    def write(self, schedule: Schedule, extra: dict[str, float] | None = None) -> None:
        """Log the means since the last call, and `extra` as it is."""
        means = {name: sum(v) / len(v) for name, v in self._sums.items()} | (extra or {})
        self._sums.clear()
        if not self.enabled:
            return
        row = {"step": schedule.step, "minutes": round(schedule.spent / 60, 2), **means}
        with self._log.open("a") as file:
            file.write(json.dumps(row) + "\n")
        for name, value in means.items():
            self._board.add_scalar(name, value, schedule.step)
        shown = "  ".join(f"{name} {value:.4g}" for name, value in means.items())
        print(
            f"{100 * schedule.progress:5.1f} %  step {schedule.step}  {row['minutes']} min  {shown}",
            flush=True,
        )

    def draw(self) -> None:
        """Redraw curves.png from the whole log."""
        if not self.enabled:
            return
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        rows = self._rows()
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
