"""What the page does outside the graphs, by its own code under Node: files in between (tools/solve.mjs)."""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from hashlib import blake2b
from pathlib import Path
from typing import Any

import numpy as np

from export.manifest import quality_rules
from training.evaluation.protocol import ReactorGenerator, Solver
from training.music.recipe import AudioRecipe

ROOT = Path(__file__).parents[1]


def solve_with_node(
    motions: Sequence[np.ndarray], leader: np.ndarray, music: np.ndarray | None, *flags: str
) -> list[np.ndarray]:
    """Motions (T, 22, 3) on the skeleton that the page draws and exports, as a partner of the leader (T, 22, 3) to the
    music (T', 54): web/motion under Node, files in between. flags: of tools/solve.mjs. Raises ValueError with what Node
    says where it fails.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        beside, manifest = _write(folder / "beside", leader), folder / "manifest.json"
        manifest.write_text(json.dumps({"quality": quality_rules(), "audio": AudioRecipe().to_dict()}))
        song = [] if music is None else ["--song", _write(folder / "song", music)]
        files = [_write(folder / str(index), motion) for index, motion in enumerate(motions)]
        _run("--beside", beside, "--manifest", manifest, *song, *flags, *files)
        return [_read(file, motion.shape) for file, motion in zip(files, motions, strict=True)]


SOLVERS: dict[str, Solver] = {
    "solved": solve_with_node,
    "solved, foot lock": lambda motions, leader, music: solve_with_node(
        motions, leader, music, "--foot-lock"
    ),
}


def in_body(motion: np.ndarray, body: Sequence[Sequence[float]]) -> np.ndarray:
    """A motion (T, 22, 3) in another body, scaled to its height. body: rest offsets (22, 3), metres."""
    with tempfile.TemporaryDirectory() as name:
        offsets, file = _write(Path(name) / "body", np.array(body)), _write(Path(name) / "motion", motion)
        _run("--body", offsets, file)
        return _read(file, motion.shape)


def in_training_bodies(
    generate: ReactorGenerator, bodies: Mapping[str, Sequence[Sequence[float]]]
) -> ReactorGenerator:
    """A generator that is given leaders as the page gives them: in the body of the leaders of the training, or of the
    reactors where a leader is wanted.

    bodies: `training_bodies` of a card, by role.
    """
    known: dict[tuple[str, bytes], np.ndarray] = {}

    def generate_in_bodies(
        leader: np.ndarray, music: np.ndarray | None, seed: int, **controls: Any
    ) -> np.ndarray:
        given = controls.get("condition_leader")
        given = leader if given is None else given
        role = "reactor" if controls.get("role") else "leader"
        key = role, blake2b(np.ascontiguousarray(given).tobytes()).digest()
        if key not in known:
            known[key] = in_body(given, bodies[role])
        controls["condition_leader"] = known[key]
        return generate(leader, music, seed, **controls)

    return generate_in_bodies


def _write(path: Path, values: np.ndarray) -> Path:
    path.write_bytes(np.ascontiguousarray(values, dtype="<f4").tobytes())
    return path


def _read(path: Path, shape: tuple[int, ...]) -> np.ndarray:
    return np.frombuffer(path.read_bytes(), dtype="<f4").reshape(shape).astype(np.float32)


def _run(*arguments: str | Path) -> None:
    """Runs tools/solve.mjs. Raises ValueError with what Node says where it fails."""
    done = subprocess.run(
        ["node", "tools/solve.mjs", *arguments], cwd=ROOT, check=False, capture_output=True, text=True
    )
    if done.returncode:
        raise ValueError(f"tools/solve.mjs failed: {done.stderr or done.stdout}")
