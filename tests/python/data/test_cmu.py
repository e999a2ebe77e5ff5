"""Archives from ASF and AMC files whose joints are known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from training.config import FPS
from training.data.cmu import Duets, Solos, at_project_rate, main, read_amc, read_asf
from training.data.npz import read_npz, read_solo
from training.motion.skeleton import JOINTS

# name, parent, direction, length in the file's units (0.45 of them an inch), degrees of freedom
BONES = [
    *(
        bone
        for side, x in (("l", 1), ("r", -1))
        for bone in (
            (f"{side}hipjoint", "root", (x, 0, 0), 2.0, ""),
            (f"{side}femur", f"{side}hipjoint", (0, -1, 0), 7.0, "rx ry rz"),
            (f"{side}tibia", f"{side}femur", (0, -1, 0), 7.0, "rx"),
            (f"{side}foot", f"{side}tibia", (0, 0, 1), 2.0, "rx rz"),
        )
    ),
    ("lowerback", "root", (0, 1, 0), 2.0, "rx ry rz"),
    ("upperback", "lowerback", (0, 1, 0), 2.0, "rx ry rz"),
    ("thorax", "upperback", (0, 1, 0), 2.0, "rx ry rz"),
    ("lowerneck", "thorax", (0, 1, 0), 1.0, "rx ry rz"),
    ("upperneck", "lowerneck", (0, 1, 0), 1.0, "rx ry rz"),
    *(
        bone
        for side, x in (("l", 1), ("r", -1))
        for bone in (
            (f"{side}clavicle", "thorax", (x, 0, 0), 3.0, "ry rz"),
            (f"{side}humerus", f"{side}clavicle", (x, 0, 0), 5.0, "rx ry rz"),
            (f"{side}radius", f"{side}humerus", (x, 0, 0), 4.0, "rx"),
        )
    ),
]
UNIT = 0.0254 / 0.45
AXES = {"lfemur": (0, 0, 20), "lhumerus": (90, 0, 0)}


def write_subject(folder: Path, subject: str, motions: dict[str, list[dict[str, list[float]]]]) -> None:
    """A subject's skeleton, and trials of frames that name the bones which turn; the others are at rest."""
    folder.mkdir(parents=True)
    lines = [":version 1.10", ":name made", ":units", "  mass 1.0", "  length 0.45", "  angle deg", ":root"]
    lines += [
        "   order TX TY TZ RX RY RZ",
        "   axis XYZ",
        "   position 0 0 0",
        "   orientation 0 0 0",
        ":bonedata",
    ]
    for i, (name, _, direction, length, dof) in enumerate(reversed(BONES)):
        axis = AXES.get(name, (0, 0, 0))
        lines += ["  begin", f"     id {i}", f"     name {name}"]
        lines += [f"     direction {' '.join(map(str, direction))}", f"     length {length}"]
        lines += [f"     axis {' '.join(map(str, axis))}  XYZ"]
        if dof:
            lines += [
                f"    dof {dof}",
                *(f"    {'limits' if not k else ''} (-180 180)" for k in range(len(dof.split()))),
            ]
        lines += ["  end"]
    lines += [":hierarchy", "  begin"]
    for parent in dict.fromkeys(parent for _, parent, *_ in BONES):
        lines.append(f"    {parent} {' '.join(name for name, of, *_ in BONES if of == parent)}")
    (folder / f"{subject}.asf").write_text("\n".join([*lines, "  end", ""]))
    for trial, frames in motions.items():
        rows = ["#!made", ":FULLY-SPECIFIED", ":DEGREES"]
        for number, frame in enumerate(frames, 1):
            rows += [str(number), f"root {' '.join(map(str, frame.get('root', [0, 17, 0, 0, 0, 0])))}"]
            for name, _, _, _, dof in BONES:
                if dof:
                    rows.append(f"{name} {' '.join(map(str, frame.get(name, [0] * len(dof.split()))))}")
        (folder / f"{subject}_{trial}.amc").write_text("\n".join(rows) + "\n")


def pose(tmp_path: Path, frame: dict[str, list[float]]) -> dict[str, np.ndarray]:
    """The joints of one frame in the file's units."""
    write_subject(tmp_path / "60", "60", {"01": [frame]})
    skeleton = read_asf(tmp_path / "60/60.asf")
    motion = read_amc(tmp_path / "60/60_01.amc", skeleton)
    assert motion.shape == (1, 22, 3)
    return dict(zip(JOINTS, motion[0] / UNIT, strict=True))


def test_the_rest_pose(tmp_path: Path) -> None:
    joints = pose(tmp_path, {})
    expected = {
        "pelvis": (0, 17, 0), "left_hip": (2, 17, 0), "left_knee": (2, 10, 0), "right_ankle": (-2, 3, 0),
        "left_foot": (2, 3, 2), "spine1": (0, 19, 0), "spine3": (0, 22, 0), "neck": (0, 24, 0), "head": (0, 25, 0),
        "left_collar": (1.2, 23, 0), "left_shoulder": (3, 23, 0), "right_elbow": (-8, 23, 0), "left_wrist": (12, 23, 0),
    }  # fmt: skip
    for name, place in expected.items():
        assert joints[name] == pytest.approx(place, abs=1e-4), name


def test_turns_are_about_x_then_y_then_z_in_the_bones_own_frame(tmp_path: Path) -> None:
    """By hand: a thigh forward, a frame turned by 20 degrees, two angles one after the other, and the whole body."""
    joints = pose(tmp_path, {"rfemur": [-90, 0, 0], "lfemur": [-90, 0, 0], "rhumerus": [0, 90, 90]})
    assert joints["right_knee"] == pytest.approx((-2, 17, 7), abs=1e-4)
    tilted = np.radians(20)
    # The left thigh turns about an axis 20 degrees off x: what of it points along that axis stays.
    along = np.array([np.cos(tilted), np.sin(tilted), 0])
    down = np.array([0.0, -1, 0])
    stays = along * (along @ down)
    turned = np.cross(along, down) * np.sin(np.radians(-90)) + stays
    assert joints["left_knee"] == pytest.approx(np.array([2, 17, 0]) + 7 * turned, abs=1e-4)
    # (-1, 0, 0) about y by 90 degrees is (0, 0, 1); about z it stays.
    assert joints["right_elbow"] == pytest.approx((-3, 23, 5), abs=1e-4)


def test_the_root_turns_and_moves_everything(tmp_path: Path) -> None:
    joints = pose(tmp_path, {"root": [10, 20, 30, 0, 90, 0]})
    assert joints["pelvis"] == pytest.approx((10, 20, 30), abs=1e-4)
    assert joints["left_hip"] == pytest.approx((10, 20, 28), abs=1e-4)


def test_archives_are_those_that_training_reads(tmp_path: Path) -> None:
    """Two subjects, two trials in common at 60 frames a second, one of them shorter for one dancer."""
    walk = [{"root": [0.1 * t, 17, 0, 0, 0, 0]} for t in range(121)]
    write_subject(tmp_path / "cmu/60", "60", {"01": walk, "02": walk, "07": walk})
    write_subject(tmp_path / "cmu/61", "61", {"01": walk[:101], "02": walk})
    out = tmp_path / "out/duets.npz"
    main(Duets(root=tmp_path / "cmu", leader=60, reactor=61, fps=60, name="salsa", out=out))
    duets = read_npz(out)
    assert [duet.name for duet in duets] == ["salsa_01", "salsa_02"]
    assert [len(duet) for duet in duets] == [51, 61]
    assert np.diff(duets[1].leader[:, 0, 0]) == pytest.approx(0.2 * UNIT, abs=1e-5)
    solo = tmp_path / "solo.npz"
    main(Solos(root=tmp_path / "cmu", subjects=("modern=60", "indian=61"), fps=60, out=solo))
    assert [s.name for s in read_solo(solo)] == [
        "indian_01",
        "indian_02",
        "modern_01",
        "modern_02",
        "modern_07",
    ]


def test_another_frame_rate_is_interpolated() -> None:
    ramp = np.arange(101)[:, None, None] * np.ones((1, 22, 3))
    assert at_project_rate(ramp, 120)[:, 0, 0] == pytest.approx(np.arange(0, 101, 4))
    assert at_project_rate(ramp, 50)[:, 0, 0] == pytest.approx(np.arange(61) * 50 / FPS)


def test_errors_name_the_file(tmp_path: Path) -> None:
    write_subject(tmp_path / "60", "60", {"01": [{}]})
    asf, amc = tmp_path / "60/60.asf", tmp_path / "60/60_01.amc"
    skeleton = read_asf(asf)
    amc.write_text(amc.read_text().replace("lowerback 0 0 0\n", ""))
    with pytest.raises(ValueError, match=r"60_01\.amc"):
        read_amc(amc, skeleton)
    amc.write_text("#!made\n")
    with pytest.raises(ValueError, match="no frames"):
        read_amc(amc, skeleton)
    asf.write_text(asf.read_text().replace("root lhipjoint", "nothing lhipjoint"))
    with pytest.raises(ValueError, match=r"60\.asf: the bone \w+ hangs on no other"):
        read_asf(asf)
    with pytest.raises(ValueError, match="no trial in common"):
        write_subject(tmp_path / "a/60", "60", {"01": [{}]})
        write_subject(tmp_path / "a/61", "61", {"02": [{}]})
        Duets(root=tmp_path / "a", leader=60, reactor=61, fps=60, name="x", out=tmp_path / "x.npz").arrays()
