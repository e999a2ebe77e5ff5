"""A measured value between two limits, and how to read a value out of the numbers of an evaluation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

Numbers = dict[str, Any]
"""`Evaluation.numbers`."""
Read = Callable[[Numbers], float | None]
"""Reads one value; None where it was not measured."""


@dataclass(frozen=True)
class Threshold:
    """What is read, and the limits between which it has to lie."""

    name: str
    read: Read
    low: float
    high: float


@dataclass(frozen=True)
class ThresholdResult:
    """A measured value beside its limits."""

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


def check(numbers: Numbers, thresholds: Sequence[Threshold]) -> list[ThresholdResult]:
    """The result of every threshold whose value is among the numbers."""
    read = [(threshold, threshold.read(numbers)) for threshold in thresholds]
    return [ThresholdResult(t.name, float(value), t.low, t.high) for t, value in read if value is not None]


def of_row(row: str, key: str) -> Read:
    """A measure of a row, mean over duets and seeds."""
    return lambda numbers: numbers["rows"].get(row, {}).get("mean", {}).get(key)


def of_duet(row: str, duet: str, key: str) -> Read:
    """A measure of a row on one held-out duet, mean over seeds."""
    return lambda numbers: (
        numbers["rows"].get(row, {}).get("trials", {}).get(duet, {}).get("mean", {}).get(key)
    )


def of_section(section: str, key: str) -> Read:
    """A number of one of the experiments."""
    return lambda numbers: numbers.get(section, {}).get(key)


def constant(value: float) -> Read:
    """A value that is known already."""
    return lambda _: value


def at_end(control: str, end: str, key: str) -> Read:
    """What a control does at the `lower` or `upper` end of its travel."""

    def read(numbers: Numbers) -> float | None:
        rows = numbers.get("controls", {}).get(control)
        return rows[0 if end == "lower" else -1].get(key) if rows else None

    return read


def ratio(row: str, key: str, other: str) -> Read:
    """A measure of one row over the same of another; NaN where that is 0."""
    return _of_two(row, key, other, lambda value, reference: value / reference if reference else float("nan"))


def points_above(row: str, key: str, other: str) -> Read:
    """A share of one row minus the same of another, in percentage points."""
    return _of_two(row, key, other, lambda value, reference: (value - reference) * 100)


def _of_two(row: str, key: str, other: str, combine: Callable[[float, float], float]) -> Read:
    def read(numbers: Numbers) -> float | None:
        value, reference = of_row(row, key)(numbers), of_row(other, key)(numbers)
        return None if value is None or reference is None else combine(value, reference)

    return read


def beat_echo(row: str, direction: str) -> Read:
    """Beat echo degree (BED) above its own chance level over the truth's above its own; NaN if the truth is not
    above chance.

    Each has its own chance level, since more motion beats meet more of the partner's by accident.
    """

    def above_chance(numbers: Numbers, name: str) -> float | None:
        value, chance = (of_row(name, f"bed_{direction}{end}")(numbers) for end in ("", "_chance"))
        return None if value is None or chance is None else value - chance

    def read(numbers: Numbers) -> float | None:
        made, true = above_chance(numbers, row), above_chance(numbers, "truth")
        if made is None or true is None:
            return None
        return made / true if true > 0 else float("nan")

    return read


def repeats_above_truth(numbers: Numbers) -> float | None:
    """Share of windows that come again in a long dance, minus the truth's, in percentage points."""
    dance = numbers.get("long_dance")
    return dance and (dance["generated"]["repeat_share"] - dance["truth"]["repeat_share"]) * 100
