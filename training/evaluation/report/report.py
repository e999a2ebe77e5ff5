"""Writes an evaluation down: JSON, Markdown, a table on the screen, energy spectra, filmstrips and videos."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from training.data.duet import Duet
from training.evaluation.evaluate import Evaluation
from training.evaluation.out_of_distribution import Elsewhere
from training.evaluation.protocol import Trial
from training.evaluation.report.filmstrip import filmstrip
from training.evaluation.report.report_text import COLUMNS, markdown, number
from training.evaluation.report.spectra import draw_spectra
from training.evaluation.report.video import write_video
from training.evaluation.role_swap import swapped_trials
from training.evaluation.thresholds import Bar, check, check_quality


def screen_table(numbers: dict[str, Any]) -> Table:
    """The main table, one row per method, mean over trials and seeds."""
    table = Table(title=f"{', '.join(numbers['trials'])}; mean over trials and {len(numbers['seeds'])} seeds")
    table.add_column("")
    for label, _, _ in COLUMNS:
        table.add_column(label, justify="right")
    for name, row in numbers["rows"].items():
        table.add_row(name, *(number(row["mean"].get(key), digits) for _, key, digits in COLUMNS))
    return table


def draw(trials: list[Trial], evaluation: Evaluation, out: Path, strips: list[str]) -> list[Path]:
    """Spectra, and a filmstrip of 8 s from the middle of every trial in each named row; of the generated dances
    their first 8 s too. Then one filmstrip of the role swap and one of each kind of leader from elsewhere.
    """
    rows = evaluation.motions
    lines = {name: [m for t in trials for m in motions[t.duet.name]] for name, motions in rows.items()}
    pictures = [draw_spectra(lines, out / "spectra.png")]
    for trial in trials:
        duet = trial.duet
        middle = _middle(len(duet))
        for name in (n for n in strips if n in rows):
            motion = rows[name][duet.name][0]
            truth = None if name == "truth" else duet.reactor[: len(motion)]
            for start in (0.0, middle) if name == "generated" else (middle,):
                path = out / f"{duet.name}-{name.replace(',', '').replace(' ', '-')}-{start:.0f}s.png"
                title = f"{duet.name}, {name}"
                pictures.append(
                    filmstrip(duet.leader[: len(motion)], motion, path, truth, start=start, title=title)
                )
    for duet, made in _role_swap(trials, evaluation):
        path, title = out / f"{duet.name}-role-swap.png", f"{duet.name}, role swap: the reactor leads (blue)"
        pictures.append(
            filmstrip(duet.leader, made, path, duet.reactor, start=_middle(len(duet)), title=title)
        )
    for dance in _one_of_each_kind(evaluation):
        path, title = out / f"elsewhere-{dance.name}.png", f"{dance.name}, a leader from elsewhere"
        start = _middle(len(dance.leader))
        pictures.append(filmstrip(dance.leader, dance.reactor, path, start=start, title=title))
    return pictures


def _role_swap(trials: list[Trial], evaluation: Evaluation) -> list[tuple[Duet, np.ndarray]]:
    """The first trial that was danced with roles swapped, and what was generated for the leader's part."""
    danced = [trial for trial in trials if trial.duet.name in evaluation.swapped][:1]
    return [(t.duet, evaluation.swapped[t.duet.name][0]) for t in swapped_trials(danced)]


def _one_of_each_kind(evaluation: Evaluation) -> list[Elsewhere]:
    """The first leader from elsewhere of each kind, by the part of the name before the underscore."""
    return list({dance.name.partition("_")[0]: dance for dance in reversed(evaluation.elsewhere)}.values())


def _middle(frames: int) -> float:
    """Second at which 8 s from the middle begin."""
    return max(frames / 60 - 4.0, 0.0)


def film(trials: list[Trial], evaluation: Evaluation, out: Path) -> list[Path]:
    """Videos from two sides of the first seed's dances: every trial beside its truth, the role swap beside its
    truth, one of each kind of leader from elsewhere.
    """
    scenes = {
        t.duet.name: (
            t.duet.leader,
            {"truth": t.duet.reactor, "generated": evaluation.motions["generated"][t.duet.name][0]},
        )
        for t in trials
    }
    for duet, made in _role_swap(trials, evaluation):
        scenes[f"{duet.name}-role-swap"] = duet.leader, {"truth": duet.reactor, "reactor leads": made}
    for dance in _one_of_each_kind(evaluation):
        scenes[f"elsewhere-{dance.name}"] = dance.leader, {"generated": dance.reactor}
    return [
        write_video(leader, reactors, out / f"{name}.webm") for name, (leader, reactors) in scenes.items()
    ]


def _plain(value: Any) -> Any:
    """JSON has no NaN."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _judged(bars: list[Bar]) -> list[dict[str, Any]]:
    return [{"name": b.name, "value": b.value, "limits": b.limits, "passed": b.passed} for b in bars]


def write_report(
    evaluation: Evaluation,
    trials: list[Trial],
    out: Path,
    title: str,
    facts: dict[str, Any],
    pictures: bool = True,
    videos: bool = True,
) -> list[Bar]:
    """metrics.json, report.md, pictures and videos into a folder, the table on the screen; returns the bars.

    facts: what was measured (model, data, commit), kept at the head of metrics.json.
    """
    out.mkdir(parents=True, exist_ok=True)
    bars = check(evaluation.numbers)
    head = {"format": "reactdance-metrics", "version": 1, **facts}
    judged = {"bars": _judged(bars), "quality": _judged(check_quality(evaluation.numbers))}
    (out / "metrics.json").write_text(json.dumps(_plain(head | evaluation.numbers | judged), indent=1) + "\n")
    strips = ["truth", "reconstruction", "reconstruction, coarse alone", "generated", "nearest neighbour"]
    drawn = draw(trials, evaluation, out, strips) if pictures else []
    filmed = film(trials, evaluation, out) if videos else []
    (out / "report.md").write_text(markdown(evaluation.numbers, title, drawn, filmed))
    console = Console(width=200)
    console.print(screen_table(evaluation.numbers))
    for bar in bars:
        mark = "[green]reached[/green]" if bar.passed else "[red]missed[/red]"
        console.print(f"{mark}  {bar.name}: {number(bar.value)} ({bar.limits})")
    return bars
