"""Real recordings for tests; they are not part of the project, and tests that need them are skipped without them."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from training.data.duet import Duet
from training.data.npz import read_npz

ROOT = Path(__file__).parents[3] / ".." / "shared" / "data"


def real_file(name: str) -> Path:
    """A file or folder of the real data; skips the test when it is not there."""
    path = ROOT / name
    if not path.exists():
        pytest.skip("real data not present")
    return path


@cache
def _duets(path: Path) -> list[Duet]:
    return read_npz(path)


def real_duets() -> list[Duet]:
    """All salsa duets; skips the test when they are not there."""
    return _duets(real_file("cmu_salsa/duets.npz"))
