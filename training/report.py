"""Writes an evaluation down: JSON, Markdown, a table on the screen, energy spectra and filmstrips."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from rich.console import Console
from rich.table import Table

from training.bars import Bar, check
from training.dancer import Motions, Trial
from training.evaluate import Evaluation
from training.filmstrip import INK, REACTOR, RULE, filmstrip

# What the table on the screen and the first of the report's tables show: label, key, digits.
COLUMNS: tuple[tuple[str, str, int], ...] = (
    ("MPJPE mm", "mpjpe_mm", 1),
    ("MPJVE mm/f", "mpjve_mm", 1),
    ("root mm", "root_error_mm", 0),
    ("speed", "speed_ratio", 2),
    ("accel", "acceleration_ratio", 2),
    ("dist", "distance_ratio", 2),
    ("skate", "skate_share", 2),
    ("contact", "contact_share", 2),
    ("IPR caps", "ipr_capsules", 3),
    ("BED", "bed_forward", 3),
    ("BAS", "bas", 3),
    ("FID_k", "fid_k corrected", 1),
    ("FID_g", "fid_g corrected", 1),
    ("FID_cd", "fid_cd", 1),
)


OTHER_TONES = ("#5b9bd0", "#8f6fc4", "#4fa36a", "#c56b8f", "#8a8f98", "#b59a3c", "#6cc3c1")


def number(value: float | None, digits: int = 3) -> str:
    return "–" if value is None or not math.isfinite(value) else f"{value:.{digits}f}"


def screen_table(numbers: dict[str, Any]) -> Table:
    """The main table, one row per method, mean over trials and seeds."""
    table = Table(title=f"{', '.join(numbers['trials'])}; mean over trials and {len(numbers['seeds'])} seeds")
    table.add_column("")
    for label, _, _ in COLUMNS:
        table.add_column(label, justify="right")
    for name, row in numbers["rows"].items():
        table.add_row(name, *(number(row["mean"].get(key), digits) for _, key, digits in COLUMNS))
    return table


def markdown_table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---", *["--:"] * (len(head) - 1)], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def bars_table(bars: list[Bar]) -> str:
    rows = [[b.name, number(b.value), b.limits, "yes" if b.passed else "**no**"] for b in bars]
    return markdown_table(["bar", "value", "limit", "reached"], rows)


def markdown(numbers: dict[str, Any], title: str, pictures: list[Path]) -> str:
    """The whole report. Every measure of every row with its interval comes after the summary."""
    rows, clips = numbers["rows"], numbers["clips"]
    summary = [
        [name, *(number(row["mean"].get(key), digits) for _, key, digits in COLUMNS)]
        for name, row in rows.items()
    ]
    names = list(rows)
    measures = list(dict.fromkeys(key for row in rows.values() for key in row["mean"]))

    def cell(row: dict[str, Any], key: str) -> str:
        if key not in row["mean"]:
            return "–"
        low, high = row["interval"][key]
        value = number(row["mean"][key])
        return value if low == high else f"{value} [{number(low)}, {number(high)}]"

    seconds = numbers["seconds"]
    parts = [
        f"# {title}",
        f"Trials {', '.join(f'{k} ({v} frames)' for k, v in numbers['trials'].items())}; "
        f"seeds {', '.join(map(str, numbers['seeds']))}. Values are means over trials and seeds.",
        bars_table(check(numbers)),
        markdown_table(["", *(label for label, _, _ in COLUMNS)], summary),
        f"A dance of {seconds['frames']:.0f} frames took {seconds['mean']:.2f} s.",
        "## Every measure",
        f"In brackets 95 % bootstrap intervals: over seeds, and for FID and Div over the {clips['count']} clips "
        f"of {clips['frames']} frames (hop {clips['hop']}). `paper` repeats the published features bug for bug, "
        "`corrected` has the real up axis and frame rate. Hands are the wrists: the body has no fingers. "
        "`IPR (capsules)` is not the paper's IPR. PFC depends on the length of the clip.",
        markdown_table(
            ["measure", *names], [[key, *(cell(rows[n], key) for n in names)] for key in measures]
        ),
        "## Per trial",
    ]
    for trial in numbers["trials"]:
        table = [
            [
                name,
                *(number(row["trials"][trial]["mean"].get(key), digits) for _, key, digits in COLUMNS[:11]),
            ]
            for name, row in rows.items()
        ]
        parts += [f"### {trial}", markdown_table(["", *(label for label, _, _ in COLUMNS[:11])], table)]
    for section, heading in (("seams", "Block seams"), ("responses", "Responses to conditions")):
        table = [[key, number(value)] for key, value in numbers[section].items()]
        parts += [f"## {heading}", markdown_table(["measure", "value"], table)]
    if "two_sample" in numbers:
        table = [[name, number(value)] for name, value in numbers["two_sample"].items()]
        parts += [
            "## Told from the truth",
            "Share of unseen 2 s windows that a small network assigns rightly to generated or true; 0.5 is chance. "
            "The truth's own row tells one half of the true windows from the other: what chance looks like here.",
            markdown_table(["row", "accuracy"], table),
        ]
    if "beat_following" in numbers:
        table = [[t, *(number(v) for v in test.values())] for t, test in numbers["beat_following"].items()]
        parts += ["## Half a beat later", markdown_table(["trial", "p", "difference", "following"], table)]
    if "guidance" in numbers:
        keys = list(numbers["guidance"][0])
        table = [[number(c[k]) for k in keys] for c in numbers["guidance"]]
        parts += ["## Guidance, (1+s) cond - s uncond", markdown_table(keys, table)]
    parts += ["## Pictures", *(f"![{p.stem}]({p.name})" for p in pictures)] if pictures else []
    return "\n\n".join(parts) + "\n"


def spectra(trials: list[Trial], rows: dict[str, Motions], path: Path, fps: float = 30.0) -> Path:
    """Power of joint velocity by frequency for every row: over-smoothing and noise are seen at once."""
    figure = Figure(figsize=(8, 4.5), facecolor="#ffffff")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    edges = np.geomspace(0.2, fps / 2, 25)
    tones: dict[str, str] = dict(zip(rows, OTHER_TONES, strict=False))
    main = {"truth": INK, "generated": REACTOR}
    tones |= main
    for name, motions in rows.items():
        total = np.zeros(len(edges) - 1)
        for motion in (m for t in trials for m in motions[t.duet.name]):
            velocity = np.diff(motion, axis=0) * fps
            window = np.hanning(len(velocity))[:, None, None]
            power = (np.abs(np.fft.rfft(velocity * window, axis=0)) ** 2).sum(axis=2).mean(axis=1)
            bins = np.digitize(np.fft.rfftfreq(len(velocity), 1 / fps), edges) - 1
            inside = (bins >= 0) & (bins < len(total))
            count = np.maximum(np.bincount(bins[inside], minlength=len(total)), 1)
            total += np.bincount(bins[inside], power[inside], minlength=len(total)) / count / len(velocity)
        mean = total / sum(len(motions[t.duet.name]) for t in trials)
        known = mean > 0
        axes.loglog(
            np.sqrt(edges[1:] * edges[:-1])[known], mean[known], label=name, color=tones.get(name),
            linewidth=2.4 if name in main else 1.3, alpha=1.0 if name in main else 0.85,
        )  # fmt: skip
    axes.set(xlabel="Hz", ylabel="power of joint velocity")
    axes.grid(color=RULE)
    axes.legend(frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    return path


def draw(trials: list[Trial], rows: dict[str, Motions], out: Path, strips: list[str]) -> list[Path]:
    """Spectra of all rows, and a filmstrip of 8 s from the middle of every trial in each named row; of the
    generated dances their first 8 s too.
    """
    pictures = [spectra(trials, rows, out / "spectra.png")]
    for trial in trials:
        duet = trial.duet
        middle = max(len(duet) / 60 - 4.0, 0.0)
        for name in (n for n in strips if n in rows):
            motion = rows[name][duet.name][0]
            truth = None if name == "truth" else duet.reactor[: len(motion)]
            for start in (0.0, middle) if name == "generated" else (middle,):
                path = out / f"{duet.name}-{name.replace(' ', '-')}-{start:.0f}s.png"
                title = f"{duet.name}, {name}"
                pictures.append(
                    filmstrip(duet.leader[: len(motion)], motion, path, truth, start=start, title=title)
                )
    return pictures


def _plain(value: Any) -> Any:
    """JSON has no NaN."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def write_report(
    evaluation: Evaluation,
    trials: list[Trial],
    out: Path,
    title: str,
    facts: dict[str, Any],
    pictures: bool = True,
) -> list[Bar]:
    """metrics.json, report.md and pictures into a folder, the table on the screen; returns the bars.

    facts: what was measured (model, data, commit), kept at the head of metrics.json.
    """
    out.mkdir(parents=True, exist_ok=True)
    bars = check(evaluation.numbers)
    head = {"format": "reactdance-metrics", "version": 1, **facts}
    judged = [{"name": b.name, "value": b.value, "limits": b.limits, "passed": b.passed} for b in bars]
    (out / "metrics.json").write_text(
        json.dumps(_plain(head | evaluation.numbers | {"bars": judged}), indent=1) + "\n"
    )
    strips = ["truth", "reconstruction", "generated", "nearest neighbour"]
    drawn = draw(trials, evaluation.motions, out, strips) if pictures else []
    (out / "report.md").write_text(markdown(evaluation.numbers, title, drawn))
    console = Console(width=200)
    console.print(screen_table(evaluation.numbers))
    for bar in bars:
        mark = "[green]reached[/green]" if bar.passed else "[red]missed[/red]"
        console.print(f"{mark}  {bar.name}: {number(bar.value)} ({bar.limits})")
    return bars
