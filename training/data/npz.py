"""Readers of joint positions of numpy: npz archives of duets as NAME/leader with NAME/follower, of solos as NAME, and
npy files of one dancer."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from training.data.duet import FPS, Duet, Solo
from training.data.naming import naming
from training.motion.floor import put_on_floor
from training.motion.skeleton import JOINTS


def _open(path: Path) -> np.lib.npyio.NpzFile:
    archive = np.load(path)
    if not isinstance(archive, np.lib.npyio.NpzFile):
        raise ValueError("no npz archive")
    return archive


def _check_header(archive: np.lib.npyio.NpzFile, path: Path) -> None:
    if "fps" in archive and float(archive["fps"]) != FPS:
        raise ValueError(f"{path}: {float(archive['fps'])} fps, expected {FPS}; resample it first")
    if "joints" in archive and tuple(str(name) for name in archive["joints"]) != JOINTS:
        raise ValueError(f"{path}: its joints are not the {len(JOINTS)} SMPL joints in SMPL order")


def _dancer(name: str, motion: np.ndarray) -> np.ndarray:
    """A motion (T, 22, 3) with its floor at 0. Raises ValueError for another shape."""
    if motion.ndim != 3 or motion.shape[1:] != (len(JOINTS), 3):
        raise ValueError(f"{name}: expected (T, {len(JOINTS)}, 3), got {motion.shape}")
    return put_on_floor(motion)


def read_npz(path: Path | str) -> list[Duet]:
    """Duets of an archive with keys NAME/leader and NAME/follower, (T, 22, 3) metres, y up; sorted by name.

    Each dancer's floor is put at 0. Raises ValueError when a partner is missing or the archive holds no duet.
    """
    path = Path(path)
    with naming(path), _open(path) as archive:
        _check_header(archive, path)
        roles = ("leader", "follower")
        keys = [key.rpartition("/") for key in archive.files]
        names = sorted({name for name, _, role in keys if name and role in roles})
        if not names:
            raise ValueError(f"{path}: no NAME/leader and NAME/follower in it")
        duets = []
        for name in names:
            for role in roles:
                if f"{name}/{role}" not in archive:
                    raise ValueError(f"{path}: {name} has no {role}")
            leader, reactor = (_dancer(f"{name}/{role}", archive[f"{name}/{role}"]) for role in roles)
            duets.append(Duet(name, leader, reactor))
    return duets


def read_solo(path: Path | str, prefixes: tuple[str, ...] = ("",)) -> list[Solo]:
    """Solo dances of an archive with keys NAME: (T, 22, 3) metres, y up; sorted by name, floors put at 0.

    prefixes: of the names that are read. Raises ValueError where there is none.
    """
    path = Path(path)
    with naming(path), _open(path) as archive:
        _check_header(archive, path)
        names = sorted(
            key for key in archive.files if key not in ("fps", "joints") and key.startswith(prefixes)
        )
        if not names:
            raise ValueError(f"no dance in it has a name that begins with {' or '.join(prefixes)}")
        return [Solo(name, _dancer(name, archive[name])) for name in names]


def read_npy(path: Path | str) -> Solo:
    """One dancer, (T, 22, 3) metres, y up, 30 fps; the floor is put at 0. Raises ValueError, naming the file."""
    path = Path(path)
    with naming(path):
        return Solo(path.stem, _dancer(path.stem, np.load(path)))
