"""Runs a program with the options of its command line."""

from __future__ import annotations

import inspect
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import tyro

ROOT = Path(__file__).parents[1]


def run_program(main: Callable[[Any], object], options: Any) -> None:
    """Calls `main` with `options`, a dataclass filled in from the command line. `--help` begins with how the program is
    called and with the first paragraph of its module.

    What the project itself finds wrong with options or files, and files that cannot be opened, end the program with
    that sentence alone. All other errors keep their traceback.
    """
    try:
        main(tyro.cli(options, prog=f"python -m {_module(main)}", description=_description(main, options)))
    except (OSError, RuntimeError, ValueError) as error:
        where = traceback.extract_tb(error.__traceback__)[-1]
        folder = Path(where.filename).resolve().parent
        ours = any(folder.is_relative_to(ROOT / part) for part in ("training", "export"))
        if isinstance(error, OSError) or (ours and (where.line or "").startswith("raise ")):
            raise SystemExit(str(error)) from None
        raise


def _module(main: Callable[[Any], object]) -> str:
    """The name by which `python -m` finds the module of a function, which is `__main__` while it runs."""
    file = Path(inspect.getfile(main)).resolve()
    return ".".join(file.relative_to(ROOT).with_suffix("").parts).removesuffix(".__main__")


def _description(main: Callable[[Any], object], options: Any) -> str:
    """What the module says of itself in its first paragraph, and what the options do if they say anything."""
    purpose = (inspect.getdoc(sys.modules[main.__module__]) or "").partition("\n\n")[0]
    own = vars(options).get("__doc__") if inspect.isclass(options) else None
    # A dataclass without a docstring is given its signature.
    return purpose if own is None or own.startswith(f"{options.__name__}(") else f"{purpose}\n\n{own}"
