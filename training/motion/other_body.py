"""A motion in another body, by the page's own code under Node: files in between (tools/solve.mjs)."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]


def in_body(motion: np.ndarray, body: Sequence[Sequence[float]]) -> np.ndarray:
    """A motion (T, 22, 3) in another body, scaled to its height. body: rest offsets (22, 3), metres.

    Raises ValueError as `run_solver`.
    """
    with tempfile.TemporaryDirectory() as name:
        offsets, file = write_floats(Path(name) / "body", np.array(body)), Path(name) / "motion"
        run_solver("--body", offsets, write_floats(file, motion))
        return read_motion(file, motion.shape)


def write_floats(path: Path, values: np.ndarray) -> Path:
    path.write_bytes(np.ascontiguousarray(values, dtype="<f4").tobytes())
    return path


def read_motion(path: Path, shape: tuple[int, ...]) -> np.ndarray:
    return np.frombuffer(path.read_bytes(), dtype="<f4").reshape(shape).astype(np.float32)


def run_solver(*arguments: str | Path) -> None:
    """Runs tools/solve.mjs. Raises ValueError without Node, and with what Node says where it fails."""
    if shutil.which("node") is None:
        raise ValueError(
            "Node was not found, which runs the page's own code (tools/solve.mjs); training.generate needs none with "
            "--leader-as-is"
        )
    done = subprocess.run(
        ["node", "tools/solve.mjs", *arguments], cwd=ROOT, check=False, capture_output=True, text=True
    )
    if done.returncode:
        raise ValueError(f"tools/solve.mjs failed: {done.stderr or done.stdout}")
