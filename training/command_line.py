"""Runs a program with the options of its command line."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import tyro

ROOT = Path(__file__).parents[1]


def run_program(main: Callable[[Any], object], options: Any) -> None:
    """Calls `main` with `options`, a dataclass filled in from the command line.

    What the project itself finds wrong with options or files, and files that cannot be opened, end the program with
    that sentence alone. All other errors keep their traceback.
    """
    try:
        main(tyro.cli(options))
    except (OSError, RuntimeError, ValueError) as error:
        where = traceback.extract_tb(error.__traceback__)[-1]
        folder = Path(where.filename).resolve().parent
        ours = any(folder.is_relative_to(ROOT / part) for part in ("training", "export"))
        if isinstance(error, OSError) or (ours and (where.line or "").startswith("raise ")):
            raise SystemExit(str(error)) from None
        raise
