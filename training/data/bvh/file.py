"""Reads BVH text into joints and their motion in the world, in the file's own unit and axes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

_CHANNELS = ("xposition", "yposition", "zposition", "xrotation", "yrotation", "zrotation")
_USUAL_RATES = (
    24,
    25,
    30,
    48,
    50,
    60,
    72,
    75,
    90,
    100,
    120,
    144,
    150,
    180,
    200,
    240,
    250,
    300,
    360,
    480,
    500,
)


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
    """The skeleton, the channel values (frames, channels) and the frame rate as stated."""

    nodes: list[Node]
    values: np.ndarray
    fps: float


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
        opening = words.index("{", at)
        name = " ".join(words[at + 1 : opening])
        at = opening + 1
        if words[at].upper() != "OFFSET":
            raise ValueError(f"{path}: {name} has no OFFSET")
        x, y, z = (float(word) for word in words[at + 1 : at + 4])
        at += 4
        channels: tuple[str, ...] = ()
        if words[at].upper() == "CHANNELS":
            count = int(words[at + 1])
            channels = tuple(word.lower() for word in words[at + 2 : at + 2 + count])
            if unknown := set(channels) - set(_CHANNELS):
                raise ValueError(f"{path}: {name} has unknown channels {sorted(unknown)}")
            at += 2 + count
        nodes.append(Node(name, parents[-1], (x, y, z), channels, kind == "END"))
        parents.append(len(nodes) - 1)
    if not nodes or len(parents) != 1:
        raise ValueError(f"{path}: the skeleton is cut off")
    return nodes


def frame_rate(frame_time: str) -> float:
    """Frames per second from a frame time in seconds as written; 0.0333 means 30, but 0.0333667 is 29.97."""
    seconds = float(frame_time)
    if not 1e-3 <= seconds <= 0.2:
        raise ValueError(f"no dance is recorded with a frame time of {frame_time} seconds")
    last_decimal = 10.0 ** -len(frame_time.partition(".")[2])
    rate = min(_USUAL_RATES, key=lambda usual: abs(1 / usual - seconds))
    return float(rate) if abs(1 / rate - seconds) <= min(last_decimal, 0.02 * seconds) else 1 / seconds


def parse_bvh(path: Path | str) -> BvhFile:
    """Reads a BVH file. Raises ValueError, naming the file, when it is no complete BVH file of one skeleton."""
    path = Path(path)
    text = path.read_text(encoding="utf-8-sig", errors="replace")
    skeleton, found, motion = text.partition("MOTION")
    words = skeleton.replace("{", " { ").replace("}", " } ").split()
    if not found or not words or words[0].upper() != "HIERARCHY":
        raise ValueError(f"{path}: not a BVH file: it must begin with HIERARCHY and hold MOTION")
    try:
        nodes = _read_hierarchy(words, path)
        lines = [line.strip() for line in motion.splitlines() if line.strip()]
        frames = int(lines[0].split()[-1])
        fps = frame_rate(lines[1].split()[-1])
        rows = [line.split() for line in lines[2 : 2 + frames]]
        channels = sum(len(node.channels) for node in nodes)
        whole = sum(len(row) == channels for row in rows)
        if whole != frames or not frames:
            raise ValueError(f"expected {frames} frames of {channels} values, found {whole}")
        values = np.array(rows, dtype=np.float64)
        if not np.isfinite(values).all():
            raise ValueError(f"frame {int((~np.isfinite(values)).any(axis=1).argmax()) + 1} is not finite")
    except (IndexError, ValueError) as error:
        raise ValueError(f"{path}: {str(error).removeprefix(f'{path}: ')}") from error
    return BvhFile(nodes, values, fps)


def _moments(frames: int, fps: float, to_fps: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Frames before and after every output frame, and its share of the way between them."""
    count = int(np.floor((frames - 1) / fps * to_fps + 1e-6)) + 1
    at = np.minimum(np.arange(count) * fps / to_fps, frames - 1)
    at = np.where(np.abs(at - np.round(at)) < 1e-6, np.round(at), at)
    before = at.astype(int)
    return before, np.minimum(before + 1, frames - 1), at - before


def _step(node: Node, values: np.ndarray) -> np.ndarray:
    """(frames, 3) way from the parent. values: the node's channels over time."""
    step = np.tile(np.array(node.offset), (len(values), 1))
    moving = [k for k, channel in enumerate(node.channels) if channel.endswith("position")]
    if not moving:
        return step
    given = np.zeros_like(step)
    for k in moving:
        given[:, "xyz".index(node.channels[k][0])] = values[:, k]
    # Programs disagree whether a joint's position channels hold the whole way or what is added to its OFFSET. A joint
    # hardly moves against its parent, so the reading that stays nearer to the offset is meant.
    if node.parent >= 0 and np.sum((given - step) ** 2) < np.sum(given**2):
        return given
    return step + given


def _turn(node: Node, values: np.ndarray) -> Rotation:
    """Local rotations over time: the node's rotation channels, applied in the order of the file."""
    turning = [k for k, channel in enumerate(node.channels) if channel.endswith("rotation")]
    if not turning:
        return Rotation.identity(len(values))
    total = Rotation.identity(len(values))
    for k in turning:
        total = total * Rotation.from_euler(node.channels[k][0], values[:, k, None], degrees=True)
    return total


def world_motion(file: BvhFile, to_fps: float, fps: float | None = None) -> tuple[np.ndarray, list[Rotation]]:
    """Forward kinematics at `to_fps`: positions (T, nodes, 3) in the file's unit, and each node's world rotations.

    fps: overrides the stated frame rate, which is wrong in many files. Rotations are interpolated before the joints
    are placed, so that limbs keep their lengths between frames.
    """
    before, after, share = _moments(len(file.values), fps or file.fps, to_fps)
    places: list[np.ndarray] = []
    turns: list[Rotation] = []
    column = 0
    for node in file.nodes:
        values = file.values[:, column : column + len(node.channels)]
        column += len(node.channels)
        step, turn = _step(node, values), _turn(node, values)
        here, there = (Rotation.from_quat(turn.as_quat()[moment]) for moment in (before, after))
        between = (here.inv() * there).as_rotvec() * share[:, None]
        local = here * Rotation.from_rotvec(between)
        way = step[before] + (step[after] - step[before]) * share[:, None]
        if node.parent < 0:
            places.append(way)
            turns.append(local)
        else:
            places.append(places[node.parent] + turns[node.parent].apply(way))
            turns.append(turns[node.parent] * local)
    return np.stack(places, axis=1), turns
