"""From the files of the CMU motion capture database (ASF skeletons, AMC motions) to the archives that training reads.

    python -m training.data.cmu duets --root cmu --leader 60 --reactor 61 --fps 60 --name salsa --out duets.npz
    python -m training.data.cmu solos --root cmu --subjects modern=5 indian=94 --fps 120 --out solo.npz

ROOT holds the database's folders as they are unpacked: ROOT/60/60.asf and ROOT/60/60_01.amc. AMC files do not say their
frame rate; the database's index does.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import tyro
from scipy.spatial.transform import Rotation

from training.config import FPS
from training.data.naming import naming
from training.motion.skeleton import JOINTS

METRES_PER_INCH = 0.0254
MAX_FRAMES = 120 * 60 * 30
"""Half an hour at 120 frames a second; a longer file is damaged."""

BONE_ENDS: Mapping[str, str] = {
    "left_hip": "lhipjoint",
    "right_hip": "rhipjoint",
    "left_knee": "lfemur",
    "right_knee": "rfemur",
    "left_ankle": "ltibia",
    "right_ankle": "rtibia",
    "left_foot": "lfoot",
    "right_foot": "rfoot",
    "spine1": "lowerback",
    "spine2": "upperback",
    "neck": "lowerneck",
    "head": "upperneck",
    "left_shoulder": "lclavicle",
    "right_shoulder": "rclavicle",
    "left_elbow": "lhumerus",
    "right_elbow": "rhumerus",
    "left_wrist": "lradius",
    "right_wrist": "rradius",
}
"""The bone whose far end a joint is."""
ALONG_BONES: Mapping[str, tuple[str, str, float]] = {
    "spine3": ("upperback", "thorax", 0.5),
    "left_collar": ("thorax", "lclavicle", 0.4),
    "right_collar": ("thorax", "rclavicle", 0.4),
}
"""Joints between the far ends of two bones, at a share of the way; its trunk has fewer joints than SMPL's."""


@dataclass(frozen=True)
class Bone:
    name: str
    parent: str
    direction: np.ndarray  # (3,) unit vector at rest
    length: float  # metres
    axis: Rotation  # the frame in which the bone turns
    degrees_of_freedom: tuple[str, ...]  # rx, ry, rz as the AMC file lists them


@dataclass(frozen=True)
class Skeleton:
    bones: tuple[Bone, ...]  # parents before children
    metres: float  # of one unit of the root's translation
    root_order: tuple[str, ...]  # TX TY TZ RX RY RZ in the order of the AMC file


def read_asf(path: Path) -> Skeleton:
    """Raises ValueError, naming the file, where it is no ASF skeleton."""
    with naming(path):
        sections = _sections(path.read_text(encoding="latin-1").splitlines())
        units = dict(line.split(maxsplit=1) for line in sections["units"])
        if units.get("angle", "deg") != "deg":
            raise ValueError("its angles are not in degrees")
        metres = METRES_PER_INCH / float(units["length"])
        root = dict(line.split(maxsplit=1) for line in sections["root"])
        parents = {
            child: words[0]
            for words in (line.split() for line in sections["hierarchy"] if line not in ("begin", "end"))
            for child in words[1:]
        }
        known, bones = {"root"}, []
        for entry in _entries(sections["bonedata"]):
            name = entry["name"][0]
            axis, order = np.array(entry["axis"][:3], float), entry["axis"][3]
            if order.upper() != "XYZ":
                raise ValueError(f"the bone {name} turns in the order {order}; XYZ is read")
            direction = np.array(entry["direction"], float)
            length = float(entry["length"][0]) * metres
            turns = Rotation.from_euler("xyz", axis, degrees=True)
            bones.append(Bone(name, parents[name], direction, length, turns, tuple(entry.get("dof", ()))))
        ordered = []
        while bones:
            ready = [bone for bone in bones if bone.parent in known]
            if not ready:
                raise ValueError(f"the bone {bones[0].name} hangs on no other")
            ordered += ready
            known |= {bone.name for bone in ready}
            bones = [bone for bone in bones if bone.name not in known]
        return Skeleton(tuple(ordered), metres, tuple(root["order"].split()))


def _sections(lines: Sequence[str]) -> dict[str, list[str]]:
    sections: dict[str, list[str]] = {}
    name = ""
    for line in (line.strip() for line in lines):
        if line.startswith(":"):
            name = line[1:].split()[0]
            sections[name] = []
        elif line and not line.startswith("#") and name:
            sections[name].append(line)
    return sections


def _entries(lines: Sequence[str]) -> Iterator[dict[str, list[str]]]:
    """The bones of the section bonedata, each the words of its lines by their first word."""
    entry: dict[str, list[str]] = {}
    for words in (line.split() for line in lines):
        if words[0] == "begin":
            entry = {}
        elif words[0] == "end":
            yield entry
        else:
            entry[words[0]] = words[1:]


def read_amc(path: Path, skeleton: Skeleton) -> np.ndarray:
    """(T, 22, 3) metres, y up, at the frame rate of the capture; joints as `BONE_ENDS` and `ALONG_BONES` say.

    Raises ValueError, naming the file, where a frame lacks a bone or has a value that is no number.
    """
    with naming(path):
        frames = _frames(path.read_text(encoding="latin-1").splitlines())
        if not frames:
            raise ValueError("no frames in it")
        if len(frames) > MAX_FRAMES:
            raise ValueError(f"{len(frames)} frames, more than {MAX_FRAMES}")
        return _joints(frames, skeleton)


def _frames(lines: Sequence[str]) -> list[dict[str, list[float]]]:
    frames: list[dict[str, list[float]]] = []
    for words in (line.split() for line in lines):
        if not words or words[0][0] in "#:":
            continue
        if len(words) == 1 and words[0].isdigit():
            frames.append({})
        else:
            frames[-1][words[0]] = [float(word) for word in words[1:]]
    return frames


def _joints(frames: Sequence[Mapping[str, list[float]]], skeleton: Skeleton) -> np.ndarray:
    def values(name: str, count: int) -> np.ndarray:
        return np.array([frame[name] for frame in frames], float).reshape(len(frames), count)

    root = dict(zip(skeleton.root_order, values("root", 6).T, strict=True))
    turns = {"root": _turn({axis.lower(): root[axis] for axis in ("RX", "RY", "RZ")})}
    ends = {"root": np.stack([root["TX"], root["TY"], root["TZ"]], axis=-1) * skeleton.metres}
    for bone in skeleton.bones:
        turn = turns[bone.parent]
        if bone.degrees_of_freedom:
            angles = values(bone.name, len(bone.degrees_of_freedom)).T
            own = _turn(dict(zip(bone.degrees_of_freedom, angles, strict=True)))
            turn = turn * bone.axis * own * bone.axis.inv()
        turns[bone.name] = turn
        ends[bone.name] = ends[bone.parent] + turn.apply(bone.direction * bone.length)
    joints = {"pelvis": ends["root"]} | {joint: ends[bone] for joint, bone in BONE_ENDS.items()}
    joints |= {
        joint: ends[near] + share * (ends[far] - ends[near])
        for joint, (near, far, share) in ALONG_BONES.items()
    }
    motion = np.stack([joints[name] for name in JOINTS], axis=1).astype(np.float32)
    if not np.isfinite(motion).all():
        raise ValueError("a value that is not a finite number")
    return motion


def _turn(angles: Mapping[str, np.ndarray]) -> Rotation:
    """Rotations about x, then y, then z, all fixed axes; angles (T,) in degrees, those that are missing are 0."""
    frames = len(next(iter(angles.values())))
    missing = np.zeros(frames)
    return Rotation.from_euler(
        "xyz", np.stack([angles.get(axis, missing) for axis in ("rx", "ry", "rz")], axis=-1), degrees=True
    )


def at_project_rate(motion: np.ndarray, fps: float) -> np.ndarray:
    """A motion (T, 22, 3) of `fps` at the project's frame rate, joints interpolated linearly."""
    times = np.arange(int((len(motion) - 1) / fps * FPS + 1e-6) + 1) / FPS * fps
    before = np.minimum(times.astype(int), len(motion) - 1)
    after = np.minimum(before + 1, len(motion) - 1)
    share = (times - before)[:, None, None]
    return (motion[before] * (1 - share) + motion[after] * share).astype(np.float32)


def read_subject(root: Path, subject: int, fps: float) -> dict[str, np.ndarray]:
    """All trials of a subject by their number ("01"), (T, 22, 3) at the project's frame rate.

    Raises FileNotFoundError without the skeleton or without a trial.
    """
    folder = root / f"{subject:02d}"
    skeleton = read_asf(folder / f"{subject:02d}.asf")
    paths = sorted(folder.glob(f"{subject:02d}_*.amc"))
    if not paths:
        raise FileNotFoundError(f"{folder} has no {subject:02d}_TRIAL.amc")
    return {path.stem.split("_")[1]: at_project_rate(read_amc(path, skeleton), fps) for path in paths}


@dataclass(frozen=True, kw_only=True)
class Duets:
    """Duets of two subjects that were captured together."""

    root: Path
    """Folder with the subjects' folders."""
    leader: int
    reactor: int
    """Numbers of the subjects."""
    fps: float
    """Of the capture."""
    name: str
    """Duets are called NAME_TRIAL."""
    out: Path
    """The npz archive."""

    def arrays(self) -> dict[str, np.ndarray]:
        leader, reactor = (
            read_subject(self.root, subject, self.fps) for subject in (self.leader, self.reactor)
        )
        arrays: dict[str, np.ndarray] = {}
        for trial in sorted(leader.keys() & reactor.keys()):
            frames = min(len(leader[trial]), len(reactor[trial]))
            arrays[f"{self.name}_{trial}/leader"] = leader[trial][:frames]
            arrays[f"{self.name}_{trial}/follower"] = reactor[trial][:frames]
        if not arrays:
            raise ValueError(f"subjects {self.leader} and {self.reactor} have no trial in common")
        return arrays


@dataclass(frozen=True, kw_only=True)
class Solos:
    """Dances of single subjects."""

    root: Path
    """Folder with the subjects' folders."""
    subjects: tuple[str, ...]
    """NAME=NUMBER each; dances are called NAME_TRIAL."""
    fps: float
    """Of the capture."""
    out: Path
    """The npz archive."""

    def arrays(self) -> dict[str, np.ndarray]:
        named = (subject.partition("=") for subject in self.subjects)
        return {
            f"{name}_{trial}": motion
            for name, _, number in named
            for trial, motion in read_subject(self.root, int(number), self.fps).items()
        }


Options = Annotated[Duets, tyro.conf.subcommand("duets")] | Annotated[Solos, tyro.conf.subcommand("solos")]


def main(options: Duets | Solos) -> None:
    arrays = options.arrays()
    options.out.parent.mkdir(parents=True, exist_ok=True)
    np.savez_compressed(options.out, fps=np.float32(FPS), joints=np.array(JOINTS), **arrays)  # pyright: ignore[reportArgumentType]
    seconds = sum(len(motion) for motion in arrays.values()) / FPS
    print(f"wrote {options.out}: {len(arrays)} motions, {seconds / 60:.1f} minutes in all")


if __name__ == "__main__":
    main(tyro.cli(Options))  # pyright: ignore[reportArgumentType]
