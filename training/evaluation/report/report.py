"""Writes an evaluation into a folder: JSON, Markdown, energy spectra, filmstrips and videos."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from training.config import FPS
from training.data.duet import Duet
from training.evaluation.evaluate import Evaluation
from training.evaluation.limits import ThresholdResult
from training.evaluation.out_of_distribution import OutOfDistributionDance
from training.evaluation.protocol import GENERATED, TRUTH, HeldOutDuet
from training.evaluation.report.conditions import seen_sentences
from training.evaluation.report.filmstrip import filmstrip
from training.evaluation.report.report_text import COLUMNS, markdown
from training.evaluation.report.spectra import draw_spectra
from training.evaluation.report.tables import number
from training.evaluation.report.video import write_video
from training.evaluation.role_swap import swapped_duets
from training.evaluation.thresholds import check_required, check_targets

# Rows that get filmstrips, where they were measured.
FILMSTRIPS = (TRUTH, "reconstruction", "reconstruction, coarse alone", GENERATED, "nearest neighbour")
FILMSTRIP_SECONDS = 8.0


def screen_table(numbers: dict[str, Any]) -> Table:
    """The main table, one row per method, mean over held-out duets and seeds."""
    table = Table(title=f"{', '.join(numbers['trials'])}; mean over duets and {len(numbers['seeds'])} seeds")
    table.add_column("")
    for label, _, _ in COLUMNS:
        table.add_column(label, justify="right")
    for name, row in numbers["rows"].items():
        table.add_row(name, *(number(row["mean"].get(key), digits) for _, key, digits in COLUMNS))
    return table


def draw(held_out: list[HeldOutDuet], evaluation: Evaluation, out: Path, strips: Sequence[str]) -> list[Path]:
    """Spectra, and a filmstrip of 8 s from the middle of every duet in each named row; of the generated dances
    their first 8 s too. Then one filmstrip of the role swap and one of each dance of the out-of-distribution
    leaders. Returns the PNG files.
    """
    rows = evaluation.motions
    lines = {name: [m for i in held_out for m in motions[i.duet.name]] for name, motions in rows.items()}
    pictures = [draw_spectra(lines, out / "spectra.png")]
    for item in held_out:
        duet = item.duet
        middle = _middle(len(duet))
        for name in (n for n in strips if n in rows):
            motion = rows[name][duet.name][0]
            truth = None if name == TRUTH else duet.reactor[: len(motion)]
            for start in (0.0, middle) if name == GENERATED else (middle,):
                path = out / f"{duet.name}-{name.replace(',', '').replace(' ', '-')}-{start:.0f}s.png"
                title = f"{duet.name}, {name}"
                pictures.append(
                    filmstrip(duet.leader[: len(motion)], motion, path, truth, start=start, title=title)
                )
    for duet, made in _role_swap(held_out, evaluation):
        path = out / f"{duet.name}-role-swap.png"
        title = f"{duet.name}, role swap: the generated leader in orange"
        pictures.append(
            filmstrip(duet.leader, made, path, duet.reactor, start=_middle(len(duet)), title=title)
        )
    for dance in _one_of_each_kind(evaluation):
        path, title = out / f"out-of-distribution-{dance.name}.png", f"{dance.name}, out of distribution"
        start = _middle(len(dance.leader))
        pictures.append(filmstrip(dance.leader, dance.reactor, path, start=start, title=title))
    return pictures


def _role_swap(held_out: list[HeldOutDuet], evaluation: Evaluation) -> list[tuple[Duet, np.ndarray]]:
    """The first duet that was generated with roles swapped, exchanged, and the leader (T, 22, 3) generated for it."""
    chosen = [item for item in held_out if item.duet.name in evaluation.swapped][:1]
    return [(item.duet, evaluation.swapped[item.duet.name][0]) for item in swapped_duets(chosen)]


def _one_of_each_kind(evaluation: Evaluation) -> list[OutOfDistributionDance]:
    """The first out-of-distribution leader of each dance, by the part of the name before the underscore."""
    dances = reversed(evaluation.out_of_distribution)
    return list({dance.name.partition("_")[0]: dance for dance in dances}.values())


def _middle(frames: int) -> float:
    """Second at which the filmstrip from the middle begins."""
    return max((frames / FPS - FILMSTRIP_SECONDS) / 2, 0.0)


def film(held_out: list[HeldOutDuet], evaluation: Evaluation, out: Path) -> list[Path]:
    """Videos from two sides of the first seed's dances: every duet beside its truth, the role swap beside its
    truth, one of each dance of the out-of-distribution leaders. Returns the WebM files.
    """
    scenes = {
        item.duet.name: (
            item.duet.leader,
            {"truth": item.duet.reactor, "generated": evaluation.motions[GENERATED][item.duet.name][0]},
        )
        for item in held_out
    }
    for duet, made in _role_swap(held_out, evaluation):
        scenes[f"{duet.name}-role-swap"] = duet.leader, {"truth": duet.reactor, "reactor leads": made}
    for dance in _one_of_each_kind(evaluation):
        scenes[f"out-of-distribution-{dance.name}"] = dance.leader, {"generated": dance.reactor}
    return [
        write_video(leader, reactors, out / f"{name}.webm") for name, (leader, reactors) in scenes.items()
    ]


def _json_values(value: Any) -> Any:
    """The value with None for NaN and infinity, which JSON does not have."""
    if isinstance(value, dict):
        return {key: _json_values(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_json_values(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _json_results(results: list[ThresholdResult]) -> list[dict[str, Any]]:
    return [{"name": r.name, "value": r.value, "limits": r.limits, "passed": r.passed} for r in results]


def write_report(
    evaluation: Evaluation,
    held_out: list[HeldOutDuet],
    out: Path,
    title: str,
    facts: dict[str, Any],
    pictures: bool,
    videos: bool,
) -> list[ThresholdResult]:
    """metrics.json, report.md, pictures and videos into a folder, the table on the screen.

    facts: what was measured (model, data, commit), kept at the head of metrics.json. Returns the results of the
    required thresholds; metrics.json has them as `required`, and the `targets` beside them.
    """
    out.mkdir(parents=True, exist_ok=True)
    numbers = evaluation.numbers
    required, targets = check_required(numbers), check_targets(numbers)
    head = {"format": "reactdance-metrics", "version": 1, **facts}
    results = {"required": _json_results(required), "targets": _json_results(targets)}
    (out / "metrics.json").write_text(json.dumps(_json_values(head | numbers | results), indent=1) + "\n")
    drawn = draw(held_out, evaluation, out, FILMSTRIPS) if pictures else []
    filmed = film(held_out, evaluation, out) if videos else []
    (out / "report.md").write_text(markdown(head | numbers, title, drawn, filmed))
    console = Console(width=200)
    console.print(screen_table(numbers))
    for result in required:
        mark = "[green]reached[/green]" if result.passed else "[red]missed[/red]"
        console.print(f"{mark}  {result.name}: {number(result.value)} ({result.limits})")
    for sentence in seen_sentences(facts):
        console.print(f"[red]{sentence}[/red]")
    return required
