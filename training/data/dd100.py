"""Reader of DD100 (Duolando, ICLR 2024): duets of ten genres with music, prepared as joint positions.

    ROOT/motion/pos3d/FOLDER/GENRE_CHOREO_TAKE_00.npy   reactor, (T, 55, 3) or (T, 165) SMPL-X joints, metres, z up
    ROOT/motion/pos3d/FOLDER/GENRE_CHOREO_TAKE_01.npy   leader
    ROOT/music/mp3/FOLDER/GENRE_CHOREO_TAKE.mp3

FOLDER is all, train or test; all three are read.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from training.config import STRIDE
from training.data.duet import Duet
from training.data.naming import naming
from training.data.splits import Split
from training.motion.floor import put_on_floor
from training.motion.skeleton import JOINTS

_SMPLX_JOINTS = 55


def y_up(motion: np.ndarray) -> np.ndarray:
    """(..., 3) coordinates with z up turned to y up, right-handed still: x stays, z becomes y, y becomes -z."""
    return np.stack([motion[..., 0], motion[..., 2], -motion[..., 1]], axis=-1)


def _read_motion(path: Path) -> np.ndarray:
    """(T, 22, 3) float32, y up. The first 22 SMPL-X joints are the SMPL body in the same order."""
    with naming(path):
        joints = np.load(path)
        if not isinstance(joints, np.ndarray) or joints.dtype.kind != "f":
            raise ValueError("no array of coordinates")
    if joints.ndim == 2 and joints.shape[1] == _SMPLX_JOINTS * 3:
        joints = joints.reshape(-1, _SMPLX_JOINTS, 3)
    if joints.ndim != 3 or joints.shape[1:] != (_SMPLX_JOINTS, 3):
        raise ValueError(f"{path}: expected (T, {_SMPLX_JOINTS}, 3), got {joints.shape}")
    return y_up(joints[:, : len(JOINTS)]).astype(np.float32)


def read_dd100(root: Path | str) -> list[Duet]:
    """All duets under ROOT, sorted by name, cut to a multiple of 4 frames, floors put at 0; with their songs.

    Raises FileNotFoundError when there is no duet or a partner is missing. A missing song leaves Duet.song empty.
    """
    root = Path(root)
    reactors = {path.stem[:-3]: path for path in sorted(root.glob("motion/pos3d/*/*_00.npy"))}
    songs = {path.stem: path for path in sorted(root.glob("music/mp3/*/*.mp3"))}
    if not reactors:
        raise FileNotFoundError(f"no motion/pos3d/FOLDER/GENRE_CHOREO_TAKE_00.npy under {root}")
    duets = []
    for name, reactor_path in sorted(reactors.items()):
        leader_path = reactor_path.with_name(f"{name}_01.npy")
        if not leader_path.exists():
            raise FileNotFoundError(f"{reactor_path} has no leader {leader_path.name} beside it")
        leader, reactor = _read_motion(leader_path), _read_motion(reactor_path)
        frames = min(len(leader), len(reactor)) // STRIDE * STRIDE
        with naming(reactor_path):
            duets.append(
                Duet(name, put_on_floor(leader[:frames]), put_on_floor(reactor[:frames]), songs.get(name))
            )
    return duets


def is_test_sequence(name: str) -> bool:
    """Does the benchmark test on GENRE_CHOREO_TAKE? Every fifth choreography; of Ballet the ninth and tenth.

    Raises ValueError for another name.
    """
    parts = name.rsplit("_", 2)
    if len(parts) < 3 or not parts[1].isdecimal():
        raise ValueError(
            f"{name} is no GENRE_CHOREO_TAKE, by which the benchmark splits: name the duets for test with --test"
        )
    genre, index = parts[0], int(parts[1])
    return index in (9, 10) if genre == "Ballet" else index % 5 == 0


def split_dd100(duets: list[Duet], val: tuple[str, ...] = ()) -> Split:
    """The benchmark's split. It has no validation part: `val` names sequences taken from its training part.

    Raises ValueError when a name of `val` is not in the training part.
    """
    train = [duet for duet in duets if not is_test_sequence(duet.name)]
    if unknown := set(val) - {duet.name for duet in train}:
        raise ValueError(f"not in the training part: {sorted(unknown)}")
    return Split(
        train=tuple(duet for duet in train if duet.name not in val),
        val=tuple(duet for duet in train if duet.name in val),
        test=tuple(duet for duet in duets if is_test_sequence(duet.name)),
    )
