"""Reads BVH text into joints and their motion in the world, in the file's own unit and axes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

_CHANNELS = ("xposition", "yposition", "zposition", "xrotation", "yrotation", "zrotation")
# Limits of a file: joints and end sites, values of all frames together, and the size of one.
_MAX_NODES = 1000
_MAX_VALUES = 10_000_000
_MAX_VALUE = 1e7
# Most frames in which it is looked what position channels hold.
_COMPARED_FRAMES = 200
# As on the page, the word alone: joints may have it in their names.
_MOTION_LINE = re.compile(r"^[ \t]*MOTION[ \t]*$", re.IGNORECASE | re.MULTILINE)
FRAME_RATES = (5.0, 1000.0)
"""Least and greatest frames per second of a recording of a dance."""
_USUAL_RATES = (
    24, 25, 30, 48, 50, 60, 72, 75, 90, 100, 120, 144, 150, 180, 200, 240, 250, 300, 360, 480, 500
)  # fmt: skip


@dataclass(frozen=True)
class Node:
    """One joint or end site, in the order of the file. channels: lower case; parent: -1 for the root."""

    name: str
    parent: int
    offset: tuple[float, float, float]
    channels: tuple[str, ...]
    end_site: bool


@dataclass(frozen=True, eq=False)
class BvhFile:
    """The skeleton, the channel values (frames, channels) and the frame rate as stated.

    with_offsets: whether position channels below the root hold the OFFSET.
    """

    nodes: list[Node]
    values: np.ndarray
    fps: float
    with_offsets: bool


def _read_channels(words: list[str], at: int, name: str, path: Path) -> tuple[str, ...]:
    """The channels of joint `name`, whose CHANNELS is words[at]; their number follows it."""
    count = int(words[at + 1])
    channels = tuple(word.lower() for word in words[at + 2 : at + 2 + count])
    if unknown := set(channels) - set(_CHANNELS):
        raise ValueError(f"{path}: {name} has unknown channels {sorted(unknown)}")
    if count != len(set(channels)):
        raise ValueError(f"{path}: {name} does not have {count} different channels")
    return channels


def _read_hierarchy(words: list[str], path: Path) -> list[Node]:
    nodes: list[Node] = []
    parents = [-1]
    at = 1
    while at < len(words):
        kind = words[at].upper()
        if kind == "}":
            parents.pop()
            at += 1
            if len(parents) == 1 and at < len(words) and words[at].upper() == "ROOT":
                raise ValueError(f"{path}: several skeletons in one file; one dancer per file")
            continue
        if kind not in ("ROOT", "JOINT", "END"):
            raise ValueError(
                f"{path}: expected ROOT, JOINT, End Site or }} in the skeleton, found {words[at]!r}"
            )
        if len(nodes) == _MAX_NODES:
            raise ValueError(f"{path}: more than {_MAX_NODES} joints")
        opening = words.index("{", at)
        name = " ".join(words[at + 1 : opening])
        at = opening + 1
        if words[at].upper() != "OFFSET":
            raise ValueError(f"{path}: {name} has no OFFSET")
        x, y, z = (float(word) for word in words[at + 1 : at + 4])
        if not max(abs(x), abs(y), abs(z)) < _MAX_VALUE or x != x or y != y or z != z:
            raise ValueError(f"{path}: the OFFSET of {name} is no place of a joint")
        at += 4
        channels: tuple[str, ...] = ()
        if words[at].upper() == "CHANNELS":
            channels = _read_channels(words, at, name, path)
            at += 2 + len(channels)
        nodes.append(Node(name, parents[-1], (x, y, z), channels, kind == "END"))
        parents.append(len(nodes) - 1)
    if not nodes or len(parents) != 1:
        raise ValueError(f"{path}: the skeleton is cut off")
    return nodes


def frame_rate(frame_time: str) -> float:
    """Frames per second from a frame time in seconds as written; 0.0333 means 30, but 0.0333667 is 29.97."""
    seconds = float(frame_time)
    low, high = FRAME_RATES
    if not 1 / high <= seconds <= 1 / low:
        raise ValueError(f"no recording of a dance has a frame time of {frame_time} seconds")
    last_decimal = 10.0 ** -len(frame_time.partition(".")[2])
    rate = min(_USUAL_RATES, key=lambda usual: abs(1 / usual - seconds))
    return float(rate) if abs(1 / rate - seconds) <= min(last_decimal, 0.02 * seconds) else 1 / seconds


def parse_bvh(path: Path | str) -> BvhFile:
    """Reads a BVH file. Raises ValueError, naming the file, when it is no complete BVH file of one skeleton."""
    path = Path(path)
    text = path.read_text(encoding="utf-8-sig", errors="replace")
    skeleton, *motion = _MOTION_LINE.split(text, maxsplit=1)
    words = skeleton.replace("{", " { ").replace("}", " } ").split()
    if not motion or not words or words[0].upper() != "HIERARCHY":
        raise ValueError(f"{path}: not a BVH file: it must begin with HIERARCHY and hold MOTION")
    try:
        nodes = _read_hierarchy(words, path)
        lines = [line.strip() for line in motion[0].splitlines() if line.strip()]
        frames = int(lines[0].split()[-1])
        if frames < 1:
            raise ValueError(f"it states {frames} frames")
        fps = frame_rate(lines[1].split()[-1])
        rows = [line.split() for line in lines[2 : 2 + frames]]
        channels = sum(len(node.channels) for node in nodes)
        if len(rows) * channels > _MAX_VALUES:
            raise ValueError(f"{len(rows)} frames of {channels} values; up to {_MAX_VALUES} values are read")
        whole = sum(len(row) == channels for row in rows)
        if whole != frames:
            raise ValueError(f"expected {frames} frames of {channels} values, found {whole}")
        values = np.array(rows, dtype=np.float64)
        if not np.isfinite(values).all():
            raise ValueError(f"frame {int((~np.isfinite(values)).any(axis=1).argmax()) + 1} is not finite")
        if (np.abs(values) >= _MAX_VALUE).any():
            raise ValueError(f"a value is {_MAX_VALUE:g} or larger")
    except IndexError as error:
        raise ValueError(f"{path}: the file is cut off") from error
    except ValueError as error:
        raise ValueError(f"{path}: {str(error).removeprefix(f'{path}: ')}") from error
    return BvhFile(nodes, values, fps, _with_offsets(nodes, values))


def _resample_times(frames: int, fps: float, to_fps: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """For every output frame the two frames of the file around it, and its place between them (0 to 1)."""
    count = int(np.floor((frames - 1) / fps * to_fps + 1e-6)) + 1
    at = np.minimum(np.arange(count) * fps / to_fps, frames - 1)
    at = np.where(np.abs(at - np.round(at)) < 1e-6, np.round(at), at)
    before = at.astype(int)
    return before, np.minimum(before + 1, frames - 1), at - before


def _columns(nodes: list[Node]) -> Iterator[tuple[Node, slice]]:
    """Each node with its columns of the channel values."""
    first = 0
    for node in nodes:
        yield node, slice(first, first + len(node.channels))
        first += len(node.channels)


def _has_position(node: Node) -> bool:
    return any(channel.endswith("position") for channel in node.channels)


def _positions(node: Node, values: np.ndarray) -> np.ndarray:
    """(frames, 3) of the position channels, 0 along an axis without one. values: (frames, channels) of the node."""
    given = np.zeros((len(values), 3))
    for k, channel in enumerate(node.channels):
        if channel.endswith("position"):
            given[:, "xyz".index(channel[0])] = values[:, k]
    return given


def _with_offsets(nodes: list[Node], values: np.ndarray) -> bool:
    """Whether position channels below the root hold the whole translation, instead of what is added to each OFFSET.

    Programs disagree. As on the page (web/motion/import/bvh/poses.ts) every joint votes for the reading that stays
    nearer to its OFFSET, since a joint hardly moves against its parent; hips that walk away are outvoted.
    """
    some = values[:: -(-len(values) // _COMPARED_FRAMES)]
    votes = 0.0
    for node, columns in _columns(nodes):
        if node.parent >= 0 and _has_position(node):
            given = _positions(node, some[:, columns])
            votes += np.sign(np.sum(given**2) - np.sum((given - node.offset) ** 2))
    return votes > 0


def _translations(node: Node, values: np.ndarray, with_offsets: bool) -> np.ndarray:
    """(frames, 3) translation from the parent. values: (frames, channels) of the node."""
    given = _positions(node, values)
    # The place of a root is the channels' own.
    whole = _has_position(node) and (node.parent < 0 or with_offsets)
    return given if whole else given + node.offset


def _rotations(node: Node, values: np.ndarray) -> Rotation:
    """Local rotations over time: the node's rotation channels, in the order of the file."""
    total = Rotation.identity(len(values))
    for k, channel in enumerate(node.channels):
        if channel.endswith("rotation"):
            total = total * Rotation.from_euler(channel[0], values[:, k, None], degrees=True)
    return total


def world_motion(file: BvhFile, to_fps: float, fps: float | None = None) -> tuple[np.ndarray, list[Rotation]]:
    """Forward kinematics at `to_fps`: positions (T, nodes, 3) in the file's unit, and each node's world rotations.

    fps: overrides the stated frame rate, which is wrong in many files. Rotations are interpolated before the joints
    are placed, so that limbs keep their lengths between frames.
    """
    before, after, share = _resample_times(len(file.values), fps or file.fps, to_fps)
    positions: list[np.ndarray] = []
    rotations: list[Rotation] = []
    for node, columns in _columns(file.nodes):
        values = file.values[:, columns]
        translation, rotation = _translations(node, values, file.with_offsets), _rotations(node, values)
        first, second = (Rotation.from_quat(rotation.as_quat()[frames]) for frames in (before, after))
        local = first * Rotation.from_rotvec((first.inv() * second).as_rotvec() * share[:, None])
        offset = translation[before] + (translation[after] - translation[before]) * share[:, None]
        if node.parent < 0:
            positions.append(offset)
            rotations.append(local)
        else:
            positions.append(positions[node.parent] + rotations[node.parent].apply(offset))
            rotations.append(rotations[node.parent] * local)
    return np.stack(positions, axis=1), rotations
