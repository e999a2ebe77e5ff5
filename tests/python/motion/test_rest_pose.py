"""The rest pose of a skeleton: found again in a body that moves, and the same as on the page."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from training.data.made import made_dancer
from training.motion.rest_pose import rest_offsets
from training.motion.skeleton import JOINTS, PARENTS

ROOT = Path(__file__).parents[3]


def test_a_body_in_its_rest_pose_that_turns_and_travels_keeps_its_offsets() -> None:
    offsets = rest_offsets(made_dancer(60, 1))
    pose = offsets.copy()
    for joint in range(1, len(JOINTS)):
        pose[joint] += pose[PARENTS[joint]]
    turns = Rotation.from_euler("y", np.linspace(0, 5, 80)[:, None]).as_matrix()
    moved = np.einsum("tij,kj->tki", turns, pose) + np.linspace(0, 3, 80)[:, None, None]
    moved[..., 1] = pose[:, 1]
    assert np.abs(rest_offsets(moved) - offsets).max() < 1e-6


def test_both_sides_get_the_mean_length_and_feet_never_rise_to_the_toes() -> None:
    offsets = rest_offsets(made_dancer(60, 1)).astype(float)
    shin, foot = JOINTS.index("left_ankle"), JOINTS.index("left_foot")
    offsets[shin] *= 1.2
    for toe in (foot, foot + 1):
        offsets[toe, 1] = 0.05
    pose = offsets.copy()
    for joint in range(1, len(JOINTS)):
        pose[joint] += pose[PARENTS[joint]]
    found = rest_offsets(np.repeat(pose[None], 30, axis=0))
    lengths = np.linalg.norm(offsets, axis=-1)
    assert np.allclose(found[[shin, shin + 1], 1], -(lengths[shin] + lengths[shin + 1]) / 2, atol=1e-6)
    assert np.allclose(found[[foot, foot + 1], 1], 0.0, atol=1e-6)


def test_offsets_are_those_that_the_page_finds(tmp_path: Path) -> None:
    # A dancer whose feet drop otherwise if a percentile more or less counts as standing.
    motion = made_dancer(300, 6).astype("<f4")
    path = tmp_path / "motion.f32"
    path.write_bytes(motion.tobytes())
    node = ["node", str(ROOT / "tests/python/support/rest_offsets.mjs"), str(path)]
    page = json.loads(subprocess.run(node, cwd=ROOT, check=True, capture_output=True, text=True).stdout)
    assert np.abs(rest_offsets(motion) - np.reshape(page, (-1, 3))).max() < 1e-6
