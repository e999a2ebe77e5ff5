"""The report in Markdown: every number of an evaluation in a table, and links to its pictures and videos."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from training.evaluation.limits import ThresholdResult
from training.evaluation.out_of_distribution import (
    FAULTS,
    MAX_DISTANCE,
    MAX_FAULTS,
    MAX_SPEED_EXTRA,
    MAX_SPEED_RATIO,
    MAX_TOE_HEIGHT,
    MIN_TOE_HEIGHT,
)
from training.evaluation.report.conditions import conditions
from training.evaluation.report.paper_table import paper_table
from training.evaluation.report.tables import markdown_table, number
from training.evaluation.thresholds import check_required, check_targets

Numbers = dict[str, Any]
Sections = list[str]
"""Paragraphs, headings and tables in Markdown, one after the other."""

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
    ("hands", "hands_held", 2),
    ("BED", "bed_forward", 3),
    ("BAS", "bas", 3),
    ("FID_k", "fid_k corrected", 1),
    ("FID_g", "fid_g corrected", 1),
    ("FID_cd", "fid_cd", 1),
)
# FID exists only for all duets together.
DUET_COLUMNS = tuple(column for column in COLUMNS if not column[1].startswith("fid"))


def markdown(numbers: Numbers, title: str, pictures: list[Path], videos: list[Path]) -> str:
    """The whole report: thresholds, the main table, every measure, then each experiment that was made."""
    sections = [f"# {title}", *_summary(numbers), *_every_measure(numbers), *_per_seed(numbers)]
    sections += [*_per_duet(numbers), *_boundaries_and_responses(numbers), *_two_sample(numbers)]
    sections += [*_beat_following(numbers), *_controls(numbers), *_guidance(numbers)]
    sections += [*_long_dance(numbers), *_role_swap(numbers), *_out_of_distribution(numbers)]
    if videos:
        sections += ["## Videos", "From two sides.", *(f"[{p.stem}]({p.name})" for p in videos)]
    if pictures:
        sections += ["## Pictures", *(f"![{p.stem}]({p.name})" for p in pictures)]
    return "\n\n".join(sections) + "\n"


def _summary(numbers: Numbers) -> Sections:
    rows = [
        [name, *(number(row["mean"].get(key), digits) for _, key, digits in COLUMNS)]
        for name, row in numbers["rows"].items()
    ]
    seconds = numbers["seconds"]
    return [
        f"Measured duets: {', '.join(f'{k} ({v} frames)' for k, v in numbers['trials'].items())}; "
        f"seeds {', '.join(map(str, numbers['seeds']))}. Values are means over duets and seeds.",
        *conditions(numbers),
        "## Required",
        "These limits and the targets below were set for the salsa couple that the shipped model learned from; other "
        "dances need others.",
        _threshold_table(check_required(numbers)),
        "## Main table",
        markdown_table(["", *(label for label, _, _ in COLUMNS)], rows),
        f"A dance of {seconds['frames']:.0f} frames took {seconds['mean']:.2f} s.",
        "## The paper's measures",
        paper_table(numbers),
        "## Targets",
        "Reported, not required. `solved` is the skeleton of constant bone lengths that is drawn and exported. BED is "
        "taken above its own chance level. *Told from the truth* is the accuracy of the two-sample test, *seams* the "
        "boundary jitter ratio.",
        _threshold_table(check_targets(numbers)),
    ]


def _threshold_table(results: list[ThresholdResult]) -> str:
    rows = [[r.name, number(r.value), r.limits, "yes" if r.passed else "**no**"] for r in results]
    return markdown_table(["threshold", "value", "limit", "reached"], rows)


def _every_measure(numbers: Numbers) -> Sections:
    rows, clips = numbers["rows"], numbers["clips"]
    measures = list(dict.fromkeys(key for row in rows.values() for key in row["mean"]))

    def cell(row: Numbers, key: str) -> str:
        if key not in row["mean"]:
            return "–"
        low, high = row["interval"][key]
        value = number(row["mean"][key])
        return value if low == high else f"{value} [{number(low)}, {number(high)}]"

    return [
        "## Every measure",
        f"In brackets 95 % bootstrap intervals: over seeds, and for FID and Div over the {clips['count']} clips "
        f"of {clips['frames']} frames (hop {clips['hop']}). `paper` repeats the published features with their "
        "errors, `corrected` has the real up axis and frame rate. Hands are the wrists: the body has no fingers. "
        "`IPR (capsules)` is not the paper's IPR. PFC is of whole dances: it depends on their length and on "
        "their largest root acceleration, by which it is divided.",
        markdown_table(
            ["measure", *rows], [[key, *(cell(row, key) for row in rows.values())] for key in measures]
        ),
    ]


def _per_seed(numbers: Numbers) -> Sections:
    """Every seed of the rows that depend on it, mean over duets."""
    if len(numbers["seeds"]) < 2:
        return []
    table = [
        [f"{name}, seed {seed}", *(number(row.get(key), digits) for _, key, digits in COLUMNS)]
        for name, measured in numbers["rows"].items()
        if len(measured["per_seed"]) > 1
        for seed, row in zip(numbers["seeds"], measured["per_seed"], strict=True)
    ]
    return ["## Per seed", markdown_table(["", *(label for label, _, _ in COLUMNS)], table)]


def _per_duet(numbers: Numbers) -> Sections:
    sections = ["## Per held-out duet"]
    for duet in numbers["trials"]:
        table = [
            [name, *(number(row["trials"][duet]["mean"].get(key), digits) for _, key, digits in DUET_COLUMNS)]
            for name, row in numbers["rows"].items()
        ]
        sections += [f"### {duet}", markdown_table(["", *(label for label, _, _ in DUET_COLUMNS)], table)]
    return sections


def _boundaries_and_responses(numbers: Numbers) -> Sections:
    return [
        "## Seams between blocks",
        "`ratio` is the boundary jitter ratio: velocity change within two frames of a seam over the truth's in the "
        "same frames. `own` compares with the motion's own interior. 1 is seamless.",
        _values(numbers["seams"]),
        "## Responses to conditions",
        "Changes are relative to the movement: 0 is none, unrelated dances come to about 1.4.",
        _values(numbers["responses"]),
    ]


def _values(values: Numbers) -> str:
    return markdown_table(["measure", "value"], [[key, number(value)] for key, value in values.items()])


def _two_sample(numbers: Numbers) -> Sections:
    if "two_sample" not in numbers:
        return []
    table = [[name, number(value)] for name, value in numbers["two_sample"].items()]
    return [
        "## Two-sample test",
        "Told from the truth: share of unseen 2 s windows that a small network assigns rightly to generated or true; "
        "0.5 is chance. The truth's own row tells one half of the true windows from the other.",
        markdown_table(["row", "accuracy"], table),
    ]


def _beat_following(numbers: Numbers) -> Sections:
    if "beat_following" not in numbers:
        return []
    table = [[duet, *(number(v) for v in test.values())] for duet, test in numbers["beat_following"].items()]
    return [
        "## Music half a beat later",
        "p of a permutation test that the motion beats stay; `following` is 1 where they move with the music, -1 where "
        "they stay.",
        markdown_table(["duet", "p", "difference", "following"], table),
    ]


def _guidance(numbers: Numbers) -> Sections:
    if "guidance" not in numbers:
        return []
    keys = list(numbers["guidance"][0])
    return [
        "## Classifier-free guidance at every step, (1+s) cond - s uncond",
        markdown_table(keys, [[number(cell[key]) for key in keys] for cell in numbers["guidance"]]),
    ]


def _controls(numbers: Numbers) -> Sections:
    if "controls" not in numbers:
        return []
    sections = [
        "## Controls over their travel",
        "`moved`: mean distance from the dance at the defaults from the same noise. `slow` and `quick`: energy under "
        "1.5 Hz and over 3 Hz over that dance's. `bed_forward`: how often the reactor's beats follow the leader's.",
    ]
    for control, rows in numbers["controls"].items():
        keys = list(rows[0])
        sections += [
            f"### {control}",
            markdown_table(keys, [[number(row[key]) for key in keys] for row in rows]),
        ]
    return sections


def _long_dance(numbers: Numbers) -> Sections:
    dance = numbers["long_dance"]
    table = [[name, *(number(v) for v in dance[name].values())] for name in ("truth", "generated")]
    return [
        "## Repetition over two minutes",
        f"The duets and their mirror images as one leader, {dance['length']['frames']:.0f} frames: share of 2 s "
        "windows with a near-duplicate at least 4 s away, and the median distance to the nearest.",
        markdown_table(["", *dance["truth"]], table),
    ]


def _role_swap(numbers: Numbers) -> Sections:
    swap = numbers["role_swap"]
    keys = list(swap["generated"]["mean"])
    lines = [(name, duet, row) for name, rows in swap.items() for duet, row in rows["trials"].items()]
    table = [[f"{duet}, {name}", *(number(row["mean"][key]) for key in keys)] for name, duet, row in lines]
    table += [[f"mean, {name}", *(number(rows["mean"][key]) for key in keys)] for name, rows in swap.items()]
    return [
        "## Role swap",
        "The model generates the leader (role input 1) to the true reactor, measured against the true leader. Mean "
        "over seeds.",
        markdown_table(["", *keys], table),
    ]


def _out_of_distribution(numbers: Numbers) -> Sections:
    if "out_of_distribution" not in numbers:
        return []
    sections = [
        "## Out-of-distribution leaders",
        "A reactor passes where everything is finite; in 98 % of frames the lower of the two toe joints is between "
        f"{MIN_TOE_HEIGHT:g} and {MAX_TOE_HEIGHT:g} m above the leader's floor (`toe_low_m` and `toe_high_m` are the "
        "1st and 99th percentile); median and largest distance of the roots are under "
        f"{MAX_DISTANCE:g} m; and the mean joint speed is under {MAX_SPEED_RATIO:g} times the leader's plus "
        f"{MAX_SPEED_EXTRA:g} m/s. First seed; the songs are those of the held-out duets.",
    ]
    for group, heading in (("unseen", "Not seen in training"), ("seen", "Seen in training")):
        rows = numbers["out_of_distribution"][group]
        sections.append(f"### {heading}: {rows['passed']} of {rows['count']} pass")
        if rows["count"]:
            sections.append(_leader_table(rows["leaders"]))
    leaders = [row for group in numbers["out_of_distribution"].values() for row in group["leaders"].values()]
    if all(key in row for key in FAULTS for row in leaders):
        sections += [
            "### Faults as drawn",
            f"Shares of the frames of all {len(leaders)} leaders; a dance should have each in at most "
            f"{MAX_FAULTS:.0%}.",
            _fault_table(leaders),
        ]
    return sections


def _fault_table(leaders: list[Numbers]) -> str:
    table = []
    for key, meaning in FAULTS.items():
        shares = [row[key] for row in leaders]
        within = sum(share <= MAX_FAULTS for share in shares)
        table.append([meaning, f"{sum(shares) / len(shares):.1%}", f"{max(shares):.1%}", str(within)])
    return markdown_table(["", "mean", "worst", "leaders within"], table)


def _leader_table(leaders: Numbers) -> str:
    first = next(iter(leaders.values()))
    keys = [key for key in first if key not in ("frames", "checks", "passed")]
    table = []
    for name, row in leaders.items():
        failed = [check for check, passed in row["checks"].items() if not passed]
        verdict = "yes" if row["passed"] else f"**no**: {', '.join(failed)}"
        table.append([name, str(row["frames"]), *(number(row[key], 2) for key in keys), verdict])
    return markdown_table(["leader", "frames", *keys, "passed"], table)
