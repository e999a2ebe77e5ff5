"""The measures of the paper's Table 1 as one table: the truth, what was generated, and what needs no model."""

from __future__ import annotations

from typing import Any

from training.evaluation.protocol import GENERATED, TRUTH
from training.evaluation.report.tables import markdown_table, number

ROWS: tuple[tuple[str, str], ...] = (
    (TRUTH, TRUTH),
    (GENERATED, "**generated**"),
    ("solved, foot lock", "as the page draws it"),
    ("no-latent baseline", "no-latent baseline"),
    ("nearest neighbour", "baseline: nearest neighbour"),
    ("mean pose", "baseline: mean pose"),
    ("mirrored leader", "baseline: mirrored leader"),
)
"""Rows of an evaluation and how they are called; those that were not measured are left out."""
OTHER_DANCES = "the training dances, as captured"
"""The FID of true motion that is not the held-out one, to read the others against."""
COLUMNS: tuple[tuple[str, str, int], ...] = (
    ("FID_k", "fid_k corrected", 0),
    ("FID_g", "fid_g corrected", 0),
    ("FID_cd", "fid_cd", 1),
    ("Div_k", "div_k corrected", 1),
    ("Div_g", "div_g corrected", 1),
    ("Div_cd", "div_cd", 1),
    ("MPJPE, mm", "mpjpe_mm", 0),
    ("MPJVE, mm a frame", "mpjve_mm", 1),
    ("root error, mm", "root_error_mm", 0),
    ("PFC", "pfc", 2),
    ("IPR (capsules)", "ipr_capsules", 2),
    ("BED (chance)", "bed_forward", 2),
    ("feet in contact", "contact_share", 2),
)


def paper_table(numbers: dict[str, Any]) -> str:
    """The table in Markdown, with the seconds that a dance took. BAS is left out: where the truth is at its chance
    level, it says nothing; the main table has it.
    """
    table = []
    for name, label in ROWS:
        if name in numbers["rows"]:
            mean = numbers["rows"][name]["mean"]
            cells = [number(mean.get(key), digits) for _, key, digits in COLUMNS]
            bed = [label for label, _, _ in COLUMNS].index("BED (chance)")
            cells[bed] += f" ({number(mean.get('bed_forward_chance'), 2)})"
            seconds = number(numbers["seconds"]["mean"], 1) if name == GENERATED else ""
            table.append([label, *cells, seconds])
        if name == TRUTH and (others := numbers.get("other_dances")):
            known = [others.get(key.removesuffix(" corrected")) for _, key, _ in COLUMNS]
            digits_of = [digits for _, _, digits in COLUMNS]
            cells = [number(v[0], d) if v else "" for v, d in zip(known, digits_of, strict=True)]
            table.append([OTHER_DANCES, *cells, ""])
    return markdown_table(["", *(label for label, _, _ in COLUMNS), "seconds"], table)
