"""The DD100 reader on a small made copy of its layout."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.python.support.duets import made_duet
from training.data.dd100 import is_test_sequence, read_dd100, split_dd100, y_up
from training.motion.floor import put_on_floor


def z_up(motion: np.ndarray) -> np.ndarray:
    """(T, 22, 3) y up to (T, 55, 3) z up, fingers and face at the root."""
    turned = np.stack([motion[..., 0], -motion[..., 2], motion[..., 1]], axis=-1)
    return np.concatenate([turned, np.repeat(turned[:, :1], 33, axis=1)], axis=1)


def write(root: Path, name: str, frames: int, seed: int, flat: bool = False, song: bool = True) -> None:
    duet = made_duet(frames, seed)
    folder, songs = root / "motion" / "pos3d" / "all", root / "music" / "mp3" / "all"
    folder.mkdir(parents=True, exist_ok=True)
    songs.mkdir(parents=True, exist_ok=True)
    for suffix, motion in (("00", duet.reactor), ("01", duet.leader)):
        joints = z_up(motion)
        np.save(folder / f"{name}_{suffix}.npy", joints.reshape(frames, -1) if flat else joints)
    if song:
        (songs / f"{name}.mp3").write_bytes(b"")


def test_layout_is_read_with_roles_axes_and_songs(tmp_path: Path) -> None:
    write(tmp_path, "Waltz_005_001", 42, seed=1)
    write(tmp_path, "Cha cha_004_002", 40, seed=2, flat=True, song=False)
    cha, waltz = read_dd100(tmp_path)
    assert (cha.name, waltz.name) == ("Cha cha_004_002", "Waltz_005_001")
    assert len(waltz) == 40
    truth = made_duet(42, seed=1)
    np.testing.assert_allclose(waltz.leader, put_on_floor(truth.leader[:40]), atol=1e-6)
    np.testing.assert_allclose(waltz.reactor, put_on_floor(truth.reactor[:40]), atol=1e-6)
    assert waltz.song == tmp_path / "music" / "mp3" / "all" / "Waltz_005_001.mp3"
    assert cha.song is None


def test_y_up_keeps_the_axes_right_handed() -> None:
    x, y, z = np.eye(3)
    np.testing.assert_array_equal(y_up(z), y)
    np.testing.assert_array_equal(y_up(x), x)
    np.testing.assert_array_equal(np.cross(y_up(x), y_up(y)), y_up(z))


@pytest.mark.parametrize(
    ("name", "test"),
    [
        *(("Waltz_005_001", True), ("Waltz_010_003", True), ("Waltz_009_001", False)),
        *(("Ballet_005_001", False), ("Ballet_009_002", True), ("Ballet_010_001", True)),
        ("Paso Doble_015_001", True),
    ],
)
def test_split_rule_of_the_benchmark(name: str, test: bool) -> None:
    assert is_test_sequence(name) == test


@pytest.mark.parametrize("name", ["duo1", "my_own_take"])
def test_names_that_the_benchmark_does_not_have_need_a_test_part(name: str) -> None:
    with pytest.raises(ValueError, match=f"{name} is no GENRE_CHOREO_TAKE.*--test"):
        is_test_sequence(name)


def test_split_takes_validation_from_the_training_part(tmp_path: Path) -> None:
    for index in range(1, 6):
        write(tmp_path, f"Jive_{index:03}_001", 8, seed=index)
    duets = read_dd100(tmp_path)
    parts = split_dd100(duets, val=("Jive_002_001",))
    assert [d.name for d in parts.train] == ["Jive_001_001", "Jive_003_001", "Jive_004_001"]
    assert [d.name for d in parts.val] == ["Jive_002_001"]
    assert [d.name for d in parts.test] == ["Jive_005_001"]
    with pytest.raises(ValueError, match="not in the training part"):
        split_dd100(duets, val=("Jive_005_001",))


def test_missing_parts_are_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="motion/pos3d"):
        read_dd100(tmp_path)
    write(tmp_path, "Jive_001_001", 8, seed=0)
    leader = tmp_path / "motion" / "pos3d" / "all" / "Jive_001_001_01.npy"
    np.save(leader, np.zeros((8, 22, 3)))
    with pytest.raises(ValueError, match="expected \\(T, 55, 3\\), got \\(8, 22, 3\\)"):
        read_dd100(tmp_path)
    leader.unlink()
    with pytest.raises(FileNotFoundError, match="has no leader"):
        read_dd100(tmp_path)
