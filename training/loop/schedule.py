"""How far a training has come, and its learning rate there."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field


@dataclass
class Schedule:
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


def learning_rate(peak: float, schedule: Schedule, warmup: int) -> float:
    """Linear warm-up over `warmup` steps, then half a cosine down to 2 % of the peak."""
    warm = min(1.0, (schedule.step + 1) / warmup)
    return peak * warm * (0.02 + 0.98 * 0.5 * (1 + math.cos(math.pi * schedule.progress)))
