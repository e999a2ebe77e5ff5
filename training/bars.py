"""What a model has to reach on held-out duets, so that an evaluation can say pass or fail.

What a good model reaches beyond that is in `training.quality`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

Numbers = dict[str, Any]


@dataclass(frozen=True)
class Bar:
    """A measured value that has to lie between two limits."""

    name: str
    value: float
    low: float
    high: float

    @property
    def passed(self) -> bool:
        return self.low <= self.value <= self.high  # NaN fails

    @property
    def limits(self) -> str:
        if self.low == -inf:
            return f"at most {self.high:g}"
        return f"at least {self.low:g}" if self.high == inf else f"{self.low:g} to {self.high:g}"


def of_row(name: str, key: str) -> Callable[[Numbers], float | None]:
    def read(numbers: Numbers) -> float | None:
        row = numbers["rows"].get(name)
        return None if row is None else row["mean"].get(key)

    return read


def of_probe(section: str, key: str) -> Callable[[Numbers], float | None]:
    return lambda numbers: numbers.get(section, {}).get(key)


Rule = tuple[str, Callable[[Numbers], float | None], float, float]
"""Name, how to read it, limits; what a report does not have is left out."""


def _of_motion(row: str, prefix: str) -> tuple[Rule, ...]:
    """Bars on a row of generated motion: the joints that the graphs give, or the skeleton solved onto them."""
    return (
        (f"{prefix}mean joint speed over the truth's", of_row(row, "speed_ratio"), 0.7, 1.3),
        (f"{prefix}median root distance over the truth's", of_row(row, "distance_ratio"), 0.75, 1.25),
        (f"{prefix}MPJPE, mm", of_row(row, "mpjpe_mm"), -inf, 125),
        (f"{prefix}relative-root error, mm", of_row(row, "root_error_mm"), -inf, 280),
    )


BARS: tuple[Rule, ...] = (
    ("reconstruction MPJPE, mm", of_row("reconstruction", "mpjpe_mm"), -inf, 35),
    ("reconstruction root error, mm", of_row("reconstruction", "root_error_mm"), -inf, 50),
    *_of_motion("generated", ""),
    *_of_motion("solved", "solved: "),
    ("seams over the truth's", of_probe("seams", "ratio"), -inf, 1.3),
    ("number of seams measured", of_probe("seams", "seams"), 50, inf),
    (
        "rise of root error with another leader",
        of_probe("responses", "other_leader_raises_root_error"),
        0.2,
        inf,
    ),
    ("two seeds apart in pose, mm", of_probe("responses", "seeds_apart_pose_mm"), 5, inf),
)


def judge(numbers: Numbers, rules: Sequence[Rule]) -> list[Bar]:
    """Every rule whose measure is among the numbers."""
    read = [(name, value(numbers), low, high) for name, value, low, high in rules]
    return [Bar(name, float(value), low, high) for name, value, low, high in read if value is not None]


def check(numbers: Numbers) -> list[Bar]:
    """All bars that the numbers of `training.evaluate` can be held to."""
    return judge(numbers, BARS)
