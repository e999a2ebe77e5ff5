"""What the page's downloads hold, as other people's readers see it."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from bvh import Bvh

from training.data.bvh.reader import read_bvh
from training.motion.floor import put_on_floor
from training.motion.skeleton import JOINTS, PARENTS

# The joints by the names that BVH and GLB give them.
NAMES = [
    "Hips",
    "LeftUpLeg",
    "RightUpLeg",
    "Spine",
    "LeftLeg",
    "RightLeg",
    "Spine1",
    "LeftFoot",
    "RightFoot",
    "Spine2",
    "LeftToeBase",
    "RightToeBase",
    "Neck",
    "LeftShoulder",
    "RightShoulder",
    "Head",
    "LeftArm",
    "RightArm",
    "LeftForeArm",
    "RightForeArm",
    "LeftHand",
    "RightHand",
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("downloads")
    node = shutil.which("node")
    assert node is not None
    script = Path(__file__).parent / "support" / "write_downloads.mjs"
    subprocess.run([node, str(script), str(folder)], check=True, cwd=script.parents[2])
    return folder


def truth(folder: Path, role: str) -> np.ndarray:
    return np.fromfile(folder / f"{role}.f32", "<f4").reshape(-1, 22, 3)


def turn(axis: str, degrees: float) -> np.ndarray:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    if axis == "X":
        return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    if axis == "Y":
        return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def joints(mocap: Bvh, frame: int, added: bool) -> np.ndarray:
    """Metres; channels are taken in the order in which the file lists them.

    added: whether position channels are added to a joint's offset (as three.js does) or replace it (as Blender does).
    """
    turns: dict[str, np.ndarray] = {}
    places: dict[str, np.ndarray] = {}
    for name in mocap.get_joints_names():
        parent = mocap.joint_parent(name)
        place, local = np.array(mocap.joint_offset(name)), np.eye(3)
        for channel in mocap.joint_channels(name):
            value = mocap.frame_joint_channel(frame, name, channel)
            if channel.endswith("rotation"):
                local = local @ turn(channel[0], value)
            else:
                axis = "XYZ".index(channel[0])
                place[axis] = value + added * mocap.joint_offset(name)[axis]
        if parent is not None and parent.name in turns:
            place = places[parent.name] + turns[parent.name] @ place
            local = turns[parent.name] @ local
        places[name], turns[name] = place, local
    return np.array([places[name] for name in NAMES]) / 100


@pytest.mark.parametrize("added", [False, True])
@pytest.mark.parametrize("role", ["leader", "reactor"])
def test_bvh_by_a_reader_that_is_not_ours(folder: Path, role: str, added: bool):
    mocap = Bvh((folder / f"{role}.bvh").read_text())
    expected = truth(folder, role)
    assert mocap.nframes == len(expected)
    assert mocap.frame_time == pytest.approx(1 / 30, abs=1e-7)
    assert sorted(mocap.get_joints_names()) == sorted([*NAMES, "Reference"])
    for frame in (0, len(expected) // 2, len(expected) - 1):
        np.testing.assert_allclose(joints(mocap, frame, added), expected[frame], atol=1e-4)


@pytest.mark.parametrize("role", ["leader", "reactor"])
def test_bvh_by_the_reader_of_training(folder: Path, role: str):
    np.testing.assert_allclose(
        read_bvh(folder / f"{role}.bvh").motion, put_on_floor(truth(folder, role)), atol=1e-4
    )


def test_npz_by_numpy(folder: Path):
    with np.load(folder / "both.npz") as saved:
        assert set(saved) == {"leader", "reactor", "fps", "joints", "metadata"}
        for role in ("leader", "reactor"):
            assert saved[role].dtype == np.float32
            np.testing.assert_array_equal(saved[role], truth(folder, role))
        assert saved["fps"] == 30
        assert tuple(saved["joints"]) == tuple(JOINTS)
        metadata = json.loads(str(saved["metadata"]))
    assert metadata["song"] == "Señor “Patio” 舞💃.mp3"
    assert metadata["leader"] == "lead_0412.bvh"
    assert metadata["settings"] == {"guidance": {"coarse": 1.2, "fine": 0.6}, "steps": 5, "seed": 1204}
    assert metadata["model"]["id"] == "salsa"
    assert metadata["footLock"] is True
    assert tuple(metadata["parents"]) == tuple(PARENTS)
    with np.load(folder / "reactor.npz") as saved:
        assert "leader" not in saved


def test_json(folder: Path):
    saved = json.loads((folder / "both.json").read_text())
    assert saved["units"] == {"position": "metres", "time": "seconds"}
    assert saved["joints"] == list(JOINTS)
    for role in ("leader", "reactor"):
        np.testing.assert_allclose(saved["positions"][role], truth(folder, role), atol=5.1e-5)
