"""Numbers and tables in Markdown."""

from __future__ import annotations

import math


def number(value: float | None, digits: int = 3) -> str:
    """The value as text; a dash where it was not measured or is not finite."""
    return "–" if value is None or not math.isfinite(value) else f"{value:.{digits}f}"


def markdown_table(head: list[str], rows: list[list[str]]) -> str:
    """A table with the first column to the left and all others to the right."""
    lines = [head, ["---", *["--:"] * (len(head) - 1)], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
