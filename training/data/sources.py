"""Reads duets from a file or folder in any of the three layouts: npz, DD100, pairs of BVH files."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from training.data.bvh.reader import read_bvh_folder
from training.data.dd100 import read_dd100, split_dd100
from training.data.duet import Duet
from training.data.npz import read_npz
from training.data.splits import Split, split


def read_duets(source: Path | str, fps: float | None = None) -> list[Duet]:
    """An .npz archive, a DD100 root (it has motion/pos3d), or a folder of NAME_leader.bvh and NAME_reactor.bvh.

    fps: overrides the frame rate that BVH files state.
    Raises FileNotFoundError, and ValueError for another kind of file, or for fps where there are no BVH files.
    """
    source = Path(source)
    if not source.exists():
        raise FileNotFoundError(f"{source} does not exist")
    bvh = source.is_dir() and not _is_dd100(source)
    if fps is not None and not bvh:
        raise ValueError(
            f"--fps is the frame rate of BVH files, and {source} is no folder of them: leave it out"
        )
    if source.suffix == ".npz":
        return read_npz(source)
    if not source.is_dir():
        raise ValueError(
            f"{source} holds no duets: they are an .npz archive, a DD100 root or a folder of BVH files"
        )
    return read_bvh_folder(source, fps) if bvh else read_dd100(source)


def _is_dd100(source: Path) -> bool:
    return (source / "motion" / "pos3d").is_dir()


def read_split(
    source: Path | str, val: Collection[str], test: Collection[str], fps: float | None = None
) -> Split:
    """Duets of a source, split by name; DD100 without names for a test part gets the benchmark's own. fps: see
    `read_duets`.
    """
    source = Path(source)
    duets = read_duets(source, fps)
    if _is_dd100(source) and not test:
        return split_dd100(duets, tuple(val))
    return split(duets, val, test)
