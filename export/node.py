"""What the page does outside the graphs, by its own code under Node: files in between (tools/solve.mjs)."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Mapping, Sequence
from hashlib import blake2b
from pathlib import Path
from typing import Any

import numpy as np

from export.manifest import quality_rules
from training.evaluation.protocol import ReactorGenerator, Solver
from training.motion.other_body import in_body, read_motion, run_solver, write_floats
from training.music.recipe import AudioRecipe


def solve_with_node(
    motions: Sequence[np.ndarray], leader: np.ndarray, music: np.ndarray | None, *flags: str
) -> list[np.ndarray]:
    """Motions (T, 22, 3) on the skeleton that the page draws and exports, as a partner of the leader (T, 22, 3) to the
    music (T', 54): web/motion under Node, files in between. flags: of tools/solve.mjs. Raises ValueError with what Node
    says where it fails.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        beside, manifest = write_floats(folder / "beside", leader), folder / "manifest.json"
        manifest.write_text(json.dumps({"quality": quality_rules(), "audio": AudioRecipe().to_dict()}))
        song = [] if music is None else ["--song", write_floats(folder / "song", music)]
        files = [write_floats(folder / str(index), motion) for index, motion in enumerate(motions)]
        run_solver("--beside", beside, "--manifest", manifest, *song, *flags, *files)
        return [read_motion(file, motion.shape) for file, motion in zip(files, motions, strict=True)]


SOLVERS: dict[str, Solver] = {
    "solved": solve_with_node,
    "solved, foot lock": lambda motions, leader, music: solve_with_node(
        motions, leader, music, "--foot-lock"
    ),
}


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
