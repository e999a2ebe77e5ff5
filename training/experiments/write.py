"""Writes a measured table: Markdown beside the paper's numbers, JSON, and a picture with intervals."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from training.config import write_json
from training.experiments.measure import Numbers
from training.experiments.paper import PAPER
from training.experiments.tables import MEASURES, Measure, Table

Cell = tuple[float, float, float]
"""A mean and its 95 % interval."""


def cell(numbers: Numbers, measure: Measure) -> Cell | None:
    """A row's value of a measure with its interval; without one, low and high are the value."""
    value = numbers["mean"].get(measure.key)
    if value is None or not math.isfinite(value):
        return None
    low, high = numbers["interval"].get(measure.key, (value, value))
    return (value, low, high) if math.isfinite(low) and math.isfinite(high) else (value, value, value)


def add_relative_cost(table: Table, rows: Mapping[str, Numbers]) -> None:
    """Processor time of every training over that of our row's; of reconstructions over that of ours among them."""
    kinds: dict[bool, str] = {}
    for row in table.rows:
        if row.name.removeprefix("reconstruction: ") == table.ours:
            kinds[row.reconstruction] = row.name
    for row in table.rows:
        mine, ours = rows[row.name]["mean"], rows.get(kinds.get(row.reconstruction, ""), {"mean": {}})["mean"]
        if "cpu_minutes" in mine and "cpu_minutes" in ours:
            mine["train"] = mine["cpu_minutes"] / ours["cpu_minutes"]


def digits(value: float) -> str:
    """Three significant digits, whole numbers from 100 on; 0 for what only rounding has left."""
    if abs(value) < 1e-6:
        return "0"
    return f"{value:.{max(0, 2 - math.floor(math.log10(abs(value))))}f}"


def shown(found: Cell | None) -> str:
    if found is None:
        return ""
    value, low, high = found
    return (
        digits(value) if digits(low) == digits(high) else f"{digits(value)} ({digits(low)} to {digits(high)})"
    )


def markdown(table: Table, rows: Mapping[str, Numbers], facts: Mapping[str, Any]) -> str:
    """The table with intervals, the paper's numbers in a second one, and what differs from our row for certain."""
    names = [m for m in table.measures if any(cell(rows[r], MEASURES[m]) for r in rows)]
    lines = [f"### Table {table.number}: {table.title}", "", facts["note"], ""]
    lines += _head(names)
    lines += [
        f"| {name} | " + " | ".join(shown(cell(rows[name], MEASURES[m])) for m in names) + " |"
        for name in rows
    ]
    paper = PAPER[table.number]
    known = [m for m in names if any(m in given for given in paper.values())]
    lines += ["", "The paper's own numbers, on other data and at another scale:", "", *_head(known)]
    for name, given in paper.items():
        lines.append(f"| {name} | " + " | ".join(f"{given[m]:g}" if m in given else "" for m in known) + " |")
    lines += ["", *(f"- {line}" for line in verdicts(table, rows))]
    return "\n".join(lines) + "\n"


def _head(names: Sequence[str]) -> list[str]:
    return [
        "| | " + " | ".join(MEASURES[m].label for m in names) + " |",
        "|---|" + "---:|" * len(names),
    ]


def distance(found: Cell, measure: Measure, truth: Cell | None) -> Cell:
    """A value and its interval as something of which less is better: itself, or its distance from the truth."""
    if measure.better != "truth" or truth is None:
        return found
    value, low, high = found
    ends = (abs(low - truth[0]), abs(high - truth[0]))
    return abs(value - truth[0]), 0.0 if low <= truth[0] <= high else min(ends), max(ends)


def verdicts(table: Table, rows: Mapping[str, Numbers]) -> list[str]:
    """For every measure which rows are better or worse than our row, where the intervals do not overlap."""
    lines = []
    pairs = [row for row in table.rows if not row.reconstruction and row.name != table.ours]
    for name in table.measures:
        measure = MEASURES[name]
        ours = cell(rows[table.ours], measure)
        if not measure.better or ours is None or ours[1] == ours[2]:
            continue
        truth = cell(rows["truth"], measure)
        own = distance(ours, measure, truth)
        sides: dict[str, list[str]] = {"better": [], "worse": [], "not told apart": []}
        for row in pairs:
            found = cell(rows[row.name], measure)
            if found is not None:
                other = distance(found, measure, truth)
                side = "better" if other[2] < own[1] else "worse" if other[1] > own[2] else "not told apart"
                sides[side].append(row.name)
        said = "; ".join(f"{side}: {', '.join(found)}" for side, found in sides.items() if found)
        if not sides["better"] and not sides["worse"]:
            said = "no row can be told apart"
        lines.append(f"{measure.label}, beside *{table.ours}*: {said}.")
    return lines


def picture(path: Path, table: Table, rows: Mapping[str, Numbers]) -> None:
    """One panel for each measure: values with intervals, our row dark, the truth as a line."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    names = [m for m in table.measures if any(cell(rows[r.name], MEASURES[m]) for r in table.rows)]
    columns = min(4, len(names))
    height = math.ceil(len(names) / columns)
    size = (2.6 * columns + 2.2, height * (0.6 + 0.24 * len(table.rows)))
    figure, axes = plt.subplots(height, columns, figsize=size, sharey=True, squeeze=False)
    labels = [row.name for row in table.rows]
    for axis in list(axes.flat)[len(names) :]:
        axis.set_visible(False)
    for axis, name in zip(axes.flat, names, strict=False):
        for place, row in enumerate(table.rows):
            found = cell(rows[row.name], MEASURES[name])
            if found:
                colour = "#1f4e79" if row.name == table.ours else "#8aa4bd"
                axis.plot(found[1:], (place, place), color=colour, lw=2)
                axis.plot(found[0], place, "o", color=colour, ms=5)
        truth = cell(rows["truth"], MEASURES[name])
        if truth and MEASURES[name].better == "truth":
            axis.axvline(truth[0], color="#c0504d", lw=1)
        axis.set_title(MEASURES[name].label, fontsize=9)
        axis.tick_params(labelsize=7)
        axis.grid(alpha=0.3, axis="x")
        axis.set_yticks(range(len(labels)), labels)
        axis.set_ylim(len(labels) - 0.5, -0.5)
    figure.tight_layout()
    figure.savefig(path, dpi=80, metadata={"Date": None} if path.suffix == ".svg" else None)
    plt.close(figure)


def write_table(
    folder: Path, table: Table, rows: dict[str, Numbers], facts: dict[str, Any]
) -> tuple[Path, Path, Path]:
    """table-N.md, table-N.json and table-N.png in a folder. rows: the truth, chance and those of the table."""
    add_relative_cost(table, rows)
    folder.mkdir(parents=True, exist_ok=True)
    text, data, image = (folder / f"table-{table.number}.{kind}" for kind in ("md", "json", "png"))
    text.write_text(markdown(table, rows, facts))
    values = {
        name: {
            m: [float(f"{v:.4g}") for v in found]
            for m in table.measures
            if (found := cell(numbers, MEASURES[m])) is not None
        }
        for name, numbers in rows.items()
    }
    write_json(data, {"title": table.title, **facts, "rows": values, "paper": PAPER[table.number]})
    picture(image, table, rows)
    return text, data, image
