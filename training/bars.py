"""What a model has to reach on held-out duets, so that an evaluation can say pass or fail."""

from __future__ import annotations

from collections.abc import Callable
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


def _row(name: str, key: str) -> Callable[[Numbers], float | None]:
    def read(numbers: Numbers) -> float | None:
        row = numbers["rows"].get(name)
        return None if row is None else row["mean"][key]

    return read


def _probe(section: str, key: str) -> Callable[[Numbers], float | None]:
    return lambda numbers: numbers.get(section, {}).get(key)


Rule = tuple[str, Callable[[Numbers], float | None], float, float]
"""Name, how to read it, limits; what a report does not have is left out."""


def _of_motion(row: str, prefix: str) -> tuple[Rule, ...]:
    """Bars on a row of generated motion: the joints that the graphs give, or the skeleton solved onto them."""
    return (
        (f"{prefix}mean joint speed over the truth's", _row(row, "speed_ratio"), 0.7, 1.3),
        (f"{prefix}median root distance over the truth's", _row(row, "distance_ratio"), 0.75, 1.25),
        (f"{prefix}MPJPE, mm", _row(row, "mpjpe_mm"), -inf, 125),
        (f"{prefix}relative-root error, mm", _row(row, "root_error_mm"), -inf, 280),
    )


BARS: tuple[Rule, ...] = (
    ("reconstruction MPJPE, mm", _row("reconstruction", "mpjpe_mm"), -inf, 35),
    ("reconstruction root error, mm", _row("reconstruction", "root_error_mm"), -inf, 50),
    *_of_motion("generated", ""),
    *_of_motion("solved", "solved: "),
    ("seams over the truth's", _probe("seams", "ratio"), -inf, 1.3),
    ("number of seams measured", _probe("seams", "seams"), 50, inf),
    (
        "rise of root error with another leader",
        _probe("responses", "other_leader_raises_root_error"),
        0.2,
        inf,
    ),
    ("two seeds apart in pose, mm", _probe("responses", "seeds_apart_pose_mm"), 5, inf),
)


def check(numbers: Numbers) -> list[Bar]:
    """All bars that the numbers of `training.evaluate` can be held to."""
    read = [(name, value(numbers), low, high) for name, value, low, high in BARS]
    return [Bar(name, float(value), low, high) for name, value, low, high in read if value is not None]
