"""Readers of motion get damaged files: they read a possible dance or refuse it in a sentence that names the file."""

from __future__ import annotations

import io
from pathlib import Path
from random import Random

import numpy as np
import pytest

from tests.python.support.made_bvh import MadeDancer, write_bvh
from tests.python.support.mutations import damaged_bytes, damaged_text, fuzz
from training.data.bvh.reader import read_bvh
from training.data.dd100 import read_dd100
from training.data.duet import Duet, Solo
from training.data.made import made_dancer
from training.data.npz import read_npz, read_solo

FRAMES = 8


def possible(dances: list[Solo] | list[Duet]) -> bool:
    motions = [m for d in dances for m in ((d.motion,) if isinstance(d, Solo) else (d.leader, d.reactor))]
    return all(np.isfinite(m).all() and np.abs(m).max() <= 50 and len(m) > 0 for m in motions)


def archive(arrays: dict[str, np.ndarray]) -> bytes:
    out = io.BytesIO()
    np.savez(out, **arrays)  # pyright: ignore[reportArgumentType]
    return out.getvalue()


def test_bvh(tmp_path: Path) -> None:
    path = write_bvh(tmp_path / "dance.bvh", MadeDancer(6, seed=1), "Mixamo", 0.01)
    text = path.read_text()
    refused = fuzz(
        lambda random: path.write_text(damaged_text(text, random)),
        lambda: [read_bvh(path)],
        path,
        possible,
    )
    assert refused > 0


def test_a_folder_in_the_place_of_a_file_is_no_damaged_file(tmp_path: Path) -> None:
    with pytest.raises(IsADirectoryError):
        read_solo(tmp_path)


@pytest.mark.parametrize("solo", [True, False], ids=["solo", "duet"])
def test_npz(tmp_path: Path, solo: bool) -> None:
    path = tmp_path / "dances.npz"
    leader, reactor = made_dancer(FRAMES, seed=1), made_dancer(FRAMES, seed=2)
    arrays = {"a": leader} if solo else {"a/leader": leader, "a/follower": reactor}
    whole = archive({**arrays, "fps": np.array(30)})

    def write(random: Random) -> None:
        # Half of the damages are in a motion, where no checksum of the archive would find them.
        if random.randrange(2) == 0:
            path.write_bytes(damaged_bytes(whole, random))
        else:
            name = random.choice(list(arrays))
            changed = bytearray(arrays[name].tobytes())
            at = random.randrange(len(changed) // 4) * 4
            changed[at : at + 4] = np.float32(random.choice((np.nan, np.inf, 1e4, 1e30, 0.1))).tobytes()
            motion = np.frombuffer(bytes(changed), np.float32).reshape(arrays[name].shape)
            path.write_bytes(archive({**arrays, name: motion}))

    assert fuzz(write, lambda: read_solo(path) if solo else read_npz(path), path, possible) > 0


def test_dd100(tmp_path: Path) -> None:
    folder = tmp_path / "motion" / "pos3d" / "all"
    folder.mkdir(parents=True)
    joints = np.zeros((FRAMES, 55, 3), dtype=np.float32)
    made = made_dancer(FRAMES, seed=1)
    joints[:, :22] = np.stack([made[..., 0], -made[..., 2], made[..., 1]], axis=-1)
    path = folder / "Ballet_01_001_00.npy"
    for role in ("00", "01"):
        np.save(folder / f"Ballet_01_001_{role}.npy", joints)
    whole = path.read_bytes()
    refused = fuzz(
        lambda random: path.write_bytes(damaged_bytes(whole, random)),
        lambda: read_dd100(tmp_path),
        path,
        possible,
    )
    assert refused > 0


def test_huge_bvh_files_are_refused_at_once(tmp_path: Path) -> None:
    path = tmp_path / "huge.bvh"
    joint = "JOINT a\n{\nOFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
    root = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n"
    for text in (joint * 100_000, (joint + "}\n") * 20_000 + "}\n"):
        path.write_text(f"{root}{text}MOTION\nFrames: 2\nFrame Time: 0.03\n")
        with pytest.raises(ValueError, match=r"huge\.bvh: more than 1000 joints"):
            read_bvh(path)
