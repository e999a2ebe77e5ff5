"""Reader of duets kept as BVH files: NAME_leader.bvh and NAME_reactor.bvh, and the song NAME.mp3 or the like if any."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from training.data.bvh.body import PAGE_UNIT, assemble, find_unit, find_up, is_page_size, read_body
from training.data.bvh.file import parse_bvh
from training.data.bvh.names import is_page_file
from training.data.bvh.rest_pose import rest_frames
from training.data.duet import Duet, Solo
from training.data.naming import naming
from training.motion.floor import put_on_floor
from training.music.features import SONG_SUFFIXES

_ROLES = ("leader", "reactor")
_SAME = 1.02
"""Ratio up to which numbers of frames, or frame rates, are the same: 30 and 29.97, but not 24 and 25."""
_MOST_DIFFERENCE = 2.0
"""Of the sizes of two dancers; of metres, inches and centimetres the nearest two are 2.54 apart."""


def read_bvh(path: Path | str, fps: float | None = None) -> Solo:
    """One dancer: metres, y up, 30 fps, floor at 0, without a rest pose before the dance.

    fps: overrides the frame rate that the file states.
    Raises ValueError that names the file when it is not a complete BVH file of a whole body.
    """
    path = Path(path)
    (motion,) = _read_together([path], fps)
    with naming(path):
        return Solo(path.stem, put_on_floor(motion))


def read_bvh_folder(folder: Path | str, fps: float | None = None) -> list[Duet]:
    """All duets of a folder, sorted by name, cut to the shorter dancer; capitals in `_leader.bvh` and the like do not
    matter.

    Unit and up axis are found for both dancers together, so that their distance stays. fps: overrides
    the frame rate that the files state.
    Raises FileNotFoundError when there is no NAME_leader.bvh or a partner is missing, ValueError for a bad file.
    """
    folder = Path(folder)
    pairs, songs = _find_pairs(folder), _find_songs(folder)
    if not pairs:
        raise FileNotFoundError(f"no NAME_leader.bvh in {folder}")
    duets = []
    for name, pair in sorted(pairs.items()):
        for role, other in (_ROLES, _ROLES[::-1]):
            if role not in pair:
                raise FileNotFoundError(f"{pair[other]} has no partner {name}_{role}.bvh")
        leader, reactor = _read_together([pair[role] for role in _ROLES], fps)
        frames = min(len(leader), len(reactor))
        duets.append(
            Duet(name, put_on_floor(leader[:frames]), put_on_floor(reactor[:frames]), songs.get(name))
        )
    return duets


def _find_pairs(folder: Path) -> dict[str, dict[str, Path]]:
    """The BVH files of a folder by the name of the duet and by role."""
    pairs: dict[str, dict[str, Path]] = {}
    for path in folder.iterdir():
        name, _, role = path.stem.rpartition("_")
        if path.suffix.lower() == ".bvh" and role.lower() in _ROLES:
            pairs.setdefault(name, {})[role.lower()] = path
    return pairs


def _find_songs(folder: Path) -> dict[str, Path]:
    """The songs of a folder by name; of several with one name the first in the order of SONG_SUFFIXES."""
    songs = [path for path in folder.iterdir() if path.suffix.lower() in SONG_SUFFIXES]
    songs.sort(key=lambda path: SONG_SUFFIXES.index(path.suffix.lower()), reverse=True)
    return {path.stem: path for path in songs}


def _read_together(paths: list[Path], fps: float | None) -> list[np.ndarray]:
    """Dancers of one world, (T, 22, 3) each; files of one recording have one unit, one up axis and one beginning.

    Raises ValueError for a bad file, for bodies of too different sizes, and where the same number of frames is said to
    be of different rates: one of the two dancers would move too fast.
    """
    files, rests, bodies = [], [], []
    for path in paths:
        with naming(path):
            file = parse_bvh(path)
            rests.append(rest_frames(file))
            files.append(file)
    counts, rates = [len(file.values) for file in files], [file.fps for file in files]
    if fps is None and max(counts) < _SAME * min(counts) and max(rates) > _SAME * min(rates):
        stated = (
            f"{path} has {count} frames at {file.fps:g} fps"
            for path, file, count in zip(paths, files, counts, strict=True)
        )
        raise ValueError(
            f"{' and '.join(stated)}: as many frames at different rates are not one dance; one of the headers is "
            "wrong, so correct its Frame Time, or give the rate of both with --fps"
        )
    for path, file in zip(paths, files, strict=True):
        with naming(path):
            bodies.append(read_body(replace(file, values=file.values[max(rests) :]), fps))
    up = find_up(sum((body.upright() / body.size() for body in bodies), start=np.zeros(3)))
    sizes = [body.size() for body in bodies]
    # The page's dancers may be small, and their files state no unit.
    if all(is_page_file(file.nodes) for file in files) and all(map(is_page_size, sizes)):
        return [assemble(body, up, PAGE_UNIT) for body in bodies]
    if max(sizes) > _MOST_DIFFERENCE * min(sizes) > 0:
        raise ValueError(
            "the bodies of "
            + " and ".join(f"{path} ({size:.3g})" for path, size in zip(paths, sizes, strict=True))
            + " differ too much in size: export both dancers in one unit"
        )
    metres = find_unit(float(np.exp(np.mean(np.log(sizes)))))
    return [assemble(body, up, metres) for body in bodies]
