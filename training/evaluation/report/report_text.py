"""The report in Markdown: every number of an evaluation in a table, and links to its pictures and videos."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from training.evaluation.out_of_distribution import (
    FARTHEST,
    HIGHEST_TOE,
    LOWEST_TOE,
    SPEED_FACTOR,
    SPEED_REST,
)
from training.evaluation.thresholds import Bar, check, check_quality

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


def number(value: float | None, digits: int = 3) -> str:
    return "–" if value is None or not math.isfinite(value) else f"{value:.{digits}f}"


def markdown_table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---", *["--:"] * (len(head) - 1)], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def bars_table(bars: list[Bar]) -> str:
    rows = [[b.name, number(b.value), b.limits, "yes" if b.passed else "**no**"] for b in bars]
    return markdown_table(["bar", "value", "limit", "reached"], rows)


def seeds_table(numbers: dict[str, Any]) -> str:
    """Every seed of the rows in which there is chance, mean over trials."""
    table = [
        [f"{name}, seed {seed}", *(number(row.get(key), digits) for _, key, digits in COLUMNS)]
        for name, measured in numbers["rows"].items()
        if len(measured["per_seed"]) > 1
        for seed, row in zip(numbers["seeds"], measured["per_seed"], strict=True)
    ]
    return markdown_table(["", *(label for label, _, _ in COLUMNS)], table)


def role_swap_table(swap: dict[str, Any]) -> str:
    keys = list(swap["generated"]["mean"])
    lines = [(name, trial, row) for name, rows in swap.items() for trial, row in rows["trials"].items()]
    table = [[f"{trial}, {name}", *(number(row["mean"][key]) for key in keys)] for name, trial, row in lines]
    table += [[f"mean, {name}", *(number(rows["mean"][key]) for key in keys)] for name, rows in swap.items()]
    return markdown_table(["", *keys], table)


def elsewhere_table(rows: dict[str, Any]) -> str:
    first = next(iter(rows.values()))
    keys = [key for key in first if key not in ("frames", "checks", "passed")]
    table = []
    for name, row in rows.items():
        missed = [check for check, passed in row["checks"].items() if not passed]
        verdict = "yes" if row["passed"] else f"**no**: {', '.join(missed)}"
        table.append([name, str(row["frames"]), *(number(row[key], 2) for key in keys), verdict])
    return markdown_table(["leader", "frames", *keys, "passed"], table)


def markdown(numbers: dict[str, Any], title: str, pictures: list[Path], videos: list[Path]) -> str:
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
        "## Bars of quality",
        "Reported, not demanded. `solved` is the skeleton that is drawn and exported. The best seed is one seed for "
        "all trials, the one whose worse ratio of the two is least. BED is taken above its own chance.",
        bars_table(check_quality(numbers)),
        "## Every measure",
        f"In brackets 95 % bootstrap intervals: over seeds, and for FID and Div over the {clips['count']} clips "
        f"of {clips['frames']} frames (hop {clips['hop']}). `paper` repeats the published features bug for bug, "
        "`corrected` has the real up axis and frame rate. Hands are the wrists: the body has no fingers. "
        "`IPR (capsules)` is not the paper's IPR. PFC depends on the length of the clip.",
        markdown_table(
            ["measure", *names], [[key, *(cell(rows[n], key) for n in names)] for key in measures]
        ),
        *(["## Per seed", seeds_table(numbers)] if len(numbers["seeds"]) > 1 else []),
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
    if "separability" in numbers:
        table = [[key, number(value)] for key, value in numbers["separability"].items()]
        parts += [
            "### Are coarse and fine two controls?",
            "Relative change of energy when one guidance rises from 0 to 1.2 beside 0. Its own end of the "
            "spectrum is under 1.5 Hz for coarse and over 3 Hz for fine.",
            markdown_table(["measure", "value"], table),
        ]
    if "long_dance" in numbers:
        dance = numbers["long_dance"]
        table = [[name, *(number(v) for v in dance[name].values())] for name in ("truth", "generated")]
        parts += [
            "## Two minutes",
            f"The trials and their mirror images as one leader, {dance['length']['frames']:.0f} frames: share of 2 s "
            "windows with a near-duplicate at least 4 s away, and the median distance to the nearest.",
            markdown_table(["", *dance["truth"]], table),
        ]
    if "role_swap" in numbers:
        parts += [
            "## Role swap",
            "The reactor leads and the model dances the leader (role input 1), measured against the true leader. Mean "
            "over seeds.",
            role_swap_table(numbers["role_swap"]),
        ]
    if "elsewhere" in numbers:
        passed = sum(row["passed"] for row in numbers["elsewhere"].values())
        parts += [
            "## Leaders from elsewhere",
            f"{passed} of {len(numbers['elsewhere'])} pass: everything finite; in 98 % of frames the lower of the two "
            f"toe joints between {LOWEST_TOE:g} and {HIGHEST_TOE:g} m above the leader's floor (`toe_low_m` and "
            "`toe_high_m` are the 1st and 99th percentile); median and largest distance of the roots under "
            f"{FARTHEST:g} m; mean joint speed under {SPEED_FACTOR:g} times the leader's plus {SPEED_REST:g} m/s. "
            "First seed; the songs are those of the trials.",
            elsewhere_table(numbers["elsewhere"]),
        ]
    parts += ["## Videos", "From two sides.", *(f"[{p.stem}]({p.name})" for p in videos)] if videos else []
    parts += ["## Pictures", *(f"![{p.stem}]({p.name})" for p in pictures)] if pictures else []
    return "\n\n".join(parts) + "\n"
