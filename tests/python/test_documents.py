"""Links of the documents lead somewhere, and their tables hold the committed measurements."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import pytest

from training.evaluation.report.paper_table import paper_table

ROOT = Path(__file__).parents[2]
METRICS = json.loads((ROOT / "web/public/models/salsa/metrics.json").read_text())
LINK = re.compile(r"\]\(([^)\s]+)\)")
# Columns of the table of controls in docs/results.md, with their digits.
CONTROLS = {
    "pose_moved_mm": 0, "root_moved_mm": 0, "slow_ratio": 2, "quick_ratio": 2, "bed_forward": 2, "mpjpe_mm": 0,
    "root_error_mm": 0, "acceleration_ratio": 2, "skate_ratio": 2, "contact_ratio": 2, "seams_ratio": 2,
    "overlap_points": 1,
}  # fmt: skip


def documents() -> list[Path]:
    names = subprocess.run(
        ["git", "ls-files", "*.md"], cwd=ROOT, check=True, capture_output=True, text=True
    ).stdout
    return [ROOT / name for name in names.split()]


def anchors(document: Path) -> set[str]:
    """As GitHub makes them of headings."""
    headings = re.findall(r"^#+ (.*)$", document.read_text(), re.MULTILINE)
    words = (re.sub(r"[^\w\- ]", "", re.sub(r"\]\([^)]*\)", "", heading).lower()) for heading in headings)
    return {word.replace(" ", "-") for word in words}


@pytest.mark.parametrize("document", documents(), ids=lambda path: str(path.relative_to(ROOT)))
def test_links_inside_the_project_lead_somewhere(document: Path) -> None:
    for link in LINK.findall(document.read_text()):
        if link.startswith("http"):
            continue
        name, _, anchor = link.partition("#")
        target = document.parent / name if name else document
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


def rows(document: str) -> list[list[str]]:
    """The cells of all rows of tables, without emphasis."""
    lines = (ROOT / document).read_text().replace("**", "").splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("|")]


def numbers(cells: list[str]) -> list[float]:
    return [float(number) for cell in cells for number in re.findall(r"-?\d+\.?\d*", cell)]


def same(found: list[float], wanted: list[float], digits: list[int]) -> bool:
    """Whether numbers are equal once rounded; halves may go both ways."""
    near = (abs(a - b) <= 0.5000001 * 10**-places for a, b, places in zip(found, wanted, digits, strict=True))
    return all(near)


@pytest.mark.parametrize("document", ["README.md", "docs/results.md"])
def test_the_papers_measures_are_the_committed_ones(document: str) -> None:
    lines = [
        [cell.strip(" *") for cell in line.strip("|").split("|")]
        for line in paper_table(METRICS).splitlines()
    ]
    wanted = {line[0]: dict(zip(lines[0], line, strict=True)) for line in lines[2:]}
    table = rows(document)
    heads = [row for row in table if row[1:2] == ["FID_k"]]
    (head,) = heads
    first = table.index(head)
    body = [row for row in table[first + 2 :] if row[0] in wanted and len(row) == len(head)]
    assert len(body) >= 5
    columns = [(i, name) for i, name in enumerate(head) if name in lines[0] and name]
    assert len(columns) >= 8
    for row in body:
        for i, name in columns:
            found, known = numbers([row[i]]), numbers([wanted[row[0]][name]])
            # Fewer digits than the report has are enough.
            digits = [len(text.partition(".")[2]) for text in re.findall(r"-?\d+\.?\d*", row[i])]
            assert len(found) == len(known), (row[0], name)
            assert same(found, known, digits), (row[0], name, row[i], wanted[row[0]][name])


def test_the_controls_are_the_committed_ones() -> None:
    known = [values for name in METRICS["controls"] for values in METRICS["controls"][name]]
    table = [row for row in rows("docs/results.md") if len(row) == 13 and re.match(r"-?[\d.]+$", row[1])]
    assert len(table) == 11
    for row in table:
        value, *found = numbers(row[1:])
        digits = list(CONTROLS.values())
        assert any(
            at["value"] == value and same(found, [at[key] for key in CONTROLS], digits) for at in known
        ), row
