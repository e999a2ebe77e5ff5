"""BVH files in several conventions, units and axes, against joints placed independently."""

from __future__ import annotations

import json
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lightning_fabric import Fabric

from tests.python.support.made_bvh import NAMES, MadeDancer, write_bvh
from tests.python.support.real_data import real_duets, real_file
from tests.python.support.small_training import stage1
from training.data.bvh.body import find_unit
from training.data.bvh.file import frame_rate, parse_bvh
from training.data.bvh.reader import read_bvh, read_bvh_folder
from training.data.bvh.rest_pose import rest_frames
from training.data.sources import read_split
from training.loop.options import read_duets_to_train
from training.motion.floor import put_on_floor
from training.motion.skeleton import JOINTS

ROOT = Path(__file__).parents[3]
TRUNK = ("pelvis", "spine1", "spine2", "spine3")
LIMBS = [JOINTS.index(name) for name in JOINTS if name not in TRUNK]


@pytest.fixture
def dancer() -> MadeDancer:
    return MadeDancer(frames=40, seed=2)


@pytest.mark.parametrize("unit", [1.0, 0.01, 0.0254])
@pytest.mark.parametrize("z_up", [False, True])
def test_own_names_come_back_joint_for_joint(
    tmp_path: Path, dancer: MadeDancer, unit: float, z_up: bool
) -> None:
    path = write_bvh(tmp_path / "a.bvh", dancer, "own", unit=unit, z_up=z_up)
    np.testing.assert_allclose(read_bvh(path).motion, put_on_floor(dancer.positions), atol=1e-4)


def test_the_joints_of_a_file_decide_together_whether_positions_hold_the_offset(
    tmp_path: Path, dancer: MadeDancer
) -> None:
    """The hips dance three metres from where their OFFSET has them, so alone they would have it added."""
    path = write_bvh(tmp_path / "a.bvh", dancer, "own", unit=0.01, hips_offset=(0, 95, 300))
    np.testing.assert_allclose(read_bvh(path).motion, put_on_floor(dancer.positions), atol=1e-4)


@pytest.mark.parametrize("convention", [name for name in NAMES if name != "own"])
def test_other_naming_conventions_find_the_limbs_and_fill_the_trunk(
    tmp_path: Path, dancer: MadeDancer, convention: str
) -> None:
    read = read_bvh(write_bvh(tmp_path / "a.bvh", dancer, convention, unit=0.01)).motion
    truth = put_on_floor(dancer.positions)
    np.testing.assert_allclose(read[:, LIMBS], truth[:, LIMBS], atol=1e-4)
    # The trunk is made by rule along the back; it lies on the line from hips to neck, in order.
    hips = (read[:, 1] + read[:, 2]) / 2
    neck = read[:, JOINTS.index("neck")]
    away = [np.linalg.norm(read[:, JOINTS.index(name)] - hips, axis=-1) for name in TRUNK]
    total = np.linalg.norm(neck - hips, axis=-1)
    assert (np.diff([*away, total], axis=0) > 0.03).all()


def test_missing_toes_are_made_ahead_of_the_ankles(tmp_path: Path, dancer: MadeDancer) -> None:
    read = read_bvh(write_bvh(tmp_path / "a.bvh", dancer, "CMU", unit=0.01, without=("left_foot",))).motion
    toe, ankle = JOINTS.index("left_foot"), JOINTS.index("left_ankle")
    foot = read[:, toe] - read[:, ankle]
    lengths = np.linalg.norm(foot, axis=-1)
    assert np.ptp(lengths) < 1e-4
    assert 0.05 < lengths[0] < 0.15
    left = read[:, 1] - read[:, 2]
    front = np.cross(left, [0, 1, 0])
    assert (np.sum(foot * front, axis=-1) > 0).all()


def test_missing_legs_are_named(tmp_path: Path, dancer: MadeDancer) -> None:
    legs = tuple(name for name in JOINTS if any(part in name for part in ("hip", "knee", "ankle", "foot")))
    path = write_bvh(tmp_path / "arms.bvh", dancer, "CMU", unit=0.01, without=legs)
    with pytest.raises(ValueError, match=r"arms\.bvh: no joint was found for left hip, right hip"):
        read_bvh(path)


def test_frame_rate_is_resampled_and_can_be_overridden(tmp_path: Path, dancer: MadeDancer) -> None:
    path = write_bvh(tmp_path / "a.bvh", dancer, "own", unit=1.0, fps=60)
    truth = put_on_floor(dancer.positions[::2])
    read = read_bvh(path).motion
    assert read.shape == truth.shape
    np.testing.assert_allclose(np.diff(read, axis=0), np.diff(truth, axis=0), atol=1e-4)
    assert len(read_bvh(path, fps=30).motion) == 40
    slow = read_bvh(path, fps=15).motion
    assert len(slow) == 79
    middle = (slow[:-2:2] + slow[2::2]) / 2
    np.testing.assert_allclose(slow[1::2], middle, atol=3e-3)
    # Between frames rotations are interpolated, not places: bones keep their lengths.
    knee, ankle = JOINTS.index("left_knee"), JOINTS.index("left_ankle")
    assert np.ptp(np.linalg.norm(slow[:, knee] - slow[:, ankle], axis=-1)) < 1e-5


@pytest.mark.parametrize(
    ("written", "fps"),
    [("0.0333333", 30), ("0.033", 30), ("0.00833333", 120), ("0.0333667", 29.97), ("0.04", 25)],
)
def test_frame_times_mean_usual_rates(written: str, fps: float) -> None:
    assert frame_rate(written) == pytest.approx(fps, rel=1e-4)


@pytest.mark.parametrize(
    ("channels", "problem"),
    [
        ("3 Xrotation Yrotation Xrotation", "hip does not have 3 different channels"),
        ("4 Xrotation Yrotation Zrotation", "hip has unknown channels"),
        ("2 Xrotation Yscale", "hip has unknown channels"),
    ],
)
def test_channels_that_are_not_as_stated_are_named(tmp_path: Path, channels: str, problem: str) -> None:
    path = tmp_path / "odd.bvh"
    path.write_text(f"HIERARCHY ROOT hip {{ OFFSET 0 0 0 CHANNELS {channels} }}\nMOTION")
    with pytest.raises(ValueError, match=rf"odd\.bvh: {problem}"):
        parse_bvh(path)


def test_a_file_of_several_skeletons_is_refused_by_that_name(tmp_path: Path, dancer: MadeDancer) -> None:
    path = write_bvh(tmp_path / "two.bvh", dancer, "own", unit=1.0)
    text = path.read_text()
    skeleton = text[text.index("ROOT") : text.index("MOTION")]
    path.write_text(text.replace("MOTION", f"{skeleton}MOTION"))
    with pytest.raises(ValueError, match=r"two\.bvh: several skeletons in one file"):
        read_bvh(path)


def test_units_by_the_size_of_a_person() -> None:
    assert find_unit(1.4) == 1.0
    assert find_unit(150.0) == 0.01
    assert find_unit(57.0) == 0.0254
    assert find_unit(14.0) == 0.1
    assert 4.0 * find_unit(4.0) == pytest.approx(1.45)
    with pytest.raises(ValueError, match="no size"):
        find_unit(0.0)


def test_units_are_those_that_the_page_finds() -> None:
    sizes = [float(size) for size in np.geomspace(0.05, 5000, 300)]
    node = ["node", str(ROOT / "tests/python/support/units.mjs"), *map(repr, sizes)]
    page = json.loads(subprocess.run(node, cwd=ROOT, check=True, capture_output=True, text=True).stdout)
    np.testing.assert_allclose([find_unit(size) for size in sizes], page)


def test_the_pages_files_are_in_centimetres_however_small_their_dancers(tmp_path: Path) -> None:
    dancer = MadeDancer(frames=8, seed=2)
    for role, height in (("leader", 1.0), ("reactor", 0.3)):
        path = tmp_path / f"rumba_{role}.bvh"
        write_bvh(path, dancer, "own", unit=0.01 / height, hips_offset=(0.0, 0.0, 0.0))
    (duet,) = read_bvh_folder(tmp_path)
    for read, height in ((duet.leader, 1.0), (duet.reactor, 0.3)):
        np.testing.assert_allclose(read, put_on_floor(height * dancer.positions), atol=1e-4)


def test_folder_of_pairs_keeps_the_distance_of_partners(tmp_path: Path) -> None:
    leader, reactor = MadeDancer(frames=40, seed=2), MadeDancer(frames=36, seed=3, aside=0.9)
    write_bvh(tmp_path / "rumba_leader.bvh", leader, "Mixamo", unit=0.01)
    write_bvh(tmp_path / "rumba_reactor.bvh", reactor, "DAZ", unit=0.01)
    (tmp_path / "rumba.ogg").write_bytes(b"")
    (duet,) = read_bvh_folder(tmp_path)
    assert (duet.name, len(duet), duet.song) == ("rumba", 36, tmp_path / "rumba.ogg")
    wrist = JOINTS.index("left_wrist")
    gap = (duet.reactor - duet.leader)[:, wrist, [0, 2]]
    truth = (reactor.positions - leader.positions[:36])[:, wrist, [0, 2]]
    np.testing.assert_allclose(gap, truth, atol=1e-4)


def test_a_folder_with_wrong_frame_times_can_be_trained_on(tmp_path: Path) -> None:
    """By an option of the training, and of nothing but BVH files."""
    for role in ("leader", "reactor"):
        write_bvh(tmp_path / f"rumba_{role}.bvh", MadeDancer(frames=40, seed=2), "own", unit=1.0, fps=60)
    options = stage1(tmp_path, tmp_path / "out", val=("rumba",), test=(), learn_all=True)
    for fps, frames in ((None, 20), (30.0, 40)):
        duets = read_duets_to_train(replace(options, fps=fps), Fabric(accelerator="cpu"), window=240)
        assert [len(duet) for duet in duets.train] == [frames]
    with pytest.raises(ValueError, match="--fps is the frame rate of BVH files"):
        read_split(tmp_path / "rumba_leader.bvh", (), (), fps=30.0)


def test_partners_of_as_many_frames_at_different_rates_are_refused(tmp_path: Path) -> None:
    """A header is wrong: at its rate that dancer would move twice as fast as the other."""
    dancer = MadeDancer(frames=80, seed=2)
    for role, fps in (("leader", 60), ("reactor", 30)):
        write_bvh(tmp_path / f"rumba_{role}.bvh", dancer, "own", unit=1.0, fps=fps)
    with pytest.raises(ValueError, match=r"leader\.bvh has 80 frames at 60 fps and .* at 30 fps: .* --fps"):
        read_bvh_folder(tmp_path)
    assert len(read_bvh_folder(tmp_path, fps=60)[0]) == 40
    write_bvh(tmp_path / "rumba_reactor.bvh", MadeDancer(frames=40, seed=2), "own", unit=1.0, fps=30)
    assert len(read_bvh_folder(tmp_path)[0]) == 40, "a recording at another rate"


def test_no_file_of_a_folder_is_passed_over_silently(tmp_path: Path) -> None:
    """Capitals in endings do not matter, and a dancer without a partner is named."""
    for name in ("rumba_Leader.BVH", "rumba_reactor.bvh"):
        write_bvh(tmp_path / name, MadeDancer(frames=8, seed=2), "own", unit=1.0)
    (tmp_path / "rumba.WAV").write_bytes(b"")
    (tmp_path / "rumba.mp3").write_bytes(b"")
    (duet,) = read_bvh_folder(tmp_path)
    assert (duet.name, duet.song) == ("rumba", tmp_path / "rumba.WAV")
    for name, partner in (("tango_leader", "tango_reactor"), ("tango_reactor", "tango_leader")):
        alone = write_bvh(tmp_path / f"{name}.bvh", MadeDancer(frames=8, seed=2), "own", unit=1.0)
        with pytest.raises(FileNotFoundError, match=rf"{name}\.bvh has no partner {partner}\.bvh"):
            read_bvh_folder(tmp_path)
        alone.unlink()


def test_partners_in_different_units_are_named(tmp_path: Path) -> None:
    for role, unit in (("leader", 0.01), ("reactor", 1.0)):
        write_bvh(tmp_path / f"rumba_{role}.bvh", MadeDancer(frames=8, seed=2), "own", unit=unit)
    with pytest.raises(ValueError, match=r"rumba_leader\.bvh .*rumba_reactor\.bvh .*in one unit"):
        read_bvh_folder(tmp_path)


def test_a_rest_pose_before_the_dance_is_left_out(tmp_path: Path, dancer: MadeDancer) -> None:
    plain = write_bvh(tmp_path / "plain.bvh", dancer, "CMU", unit=0.01)
    begun = tmp_path / "begun.bvh"
    begun.write_text(_with_rest_pose(plain.read_text()))
    assert rest_frames(parse_bvh(plain)) == 0
    assert rest_frames(parse_bvh(begun)) == 1
    np.testing.assert_array_equal(read_bvh(begun).motion, read_bvh(plain).motion)


@pytest.mark.parametrize(("way", "left_out"), [((0.8, 0.93, 0.99), 3), ((0.93, 0.99), 2), ((), 1)])
def test_the_fast_frames_in_which_a_solver_moves_out_of_the_rest_pose_are_left_out_too(
    tmp_path: Path, dancer: MadeDancer, way: tuple[float, ...], left_out: int
) -> None:
    path = write_bvh(tmp_path / "a.bvh", dancer, "CMU", unit=0.01)
    plain = parse_bvh(path)
    rest = np.zeros_like(plain.values[0])
    rest[:3] = 90, 95, 100
    between = [rest + share * (plain.values[0] - rest) for share in way]
    assert rest_frames(replace(plain, values=np.stack([rest, *between, *plain.values]))) == left_out


def test_partners_begin_together_where_one_has_a_rest_pose(tmp_path: Path) -> None:
    for role, seed in (("leader", 2), ("reactor", 3)):
        write_bvh(tmp_path / f"rumba_{role}.bvh", MadeDancer(frames=40, seed=seed), "CMU", unit=0.01)
    (whole,) = read_bvh_folder(tmp_path)
    path = tmp_path / "rumba_leader.bvh"
    path.write_text(_with_rest_pose(path.read_text(), instead=True))
    (late,) = read_bvh_folder(tmp_path)
    assert len(late) == 39
    np.testing.assert_allclose(late.reactor[:, :, [0, 2]], whole.reactor[1:, :, [0, 2]], atol=1e-4)
    np.testing.assert_allclose(late.leader[:, :, [0, 2]], whole.leader[1:, :, [0, 2]], atol=1e-4)


def _with_rest_pose(text: str, instead: bool = False) -> str:
    """A file that begins with its rest pose over the origin, before its own first frame or instead of it."""
    head, time, frames = text.partition("Frame Time:")
    first, *rest = frames.splitlines()
    pose = " ".join(["0"] + ["95"] + ["0"] * (len(rest[0].split()) - 2))
    if instead:
        return "\n".join([head + time + first, pose, *rest[1:], ""])
    count = len(rest)
    return "\n".join(
        [head.replace(f"Frames: {count}", f"Frames: {count + 1}") + time + first, pose, *rest, ""]
    )


def test_motion_begins_at_a_line_of_that_word_alone(tmp_path: Path, dancer: MadeDancer) -> None:
    plain = write_bvh(tmp_path / "plain.bvh", dancer, "own", unit=1.0)
    text = plain.read_text()
    odd = tmp_path / "odd.bvh"
    odd.write_text(text.replace("Hips", "MOTION_root", 1).replace("\nMOTION\n", "\n\tMotion \n"))
    assert parse_bvh(odd).nodes[0].name == "MOTION_root"
    np.testing.assert_array_equal(parse_bvh(odd).values, parse_bvh(plain).values)


def test_broken_files_are_named(tmp_path: Path, dancer: MadeDancer) -> None:
    path = write_bvh(tmp_path / "a.bvh", dancer, "own", unit=1.0)
    text = path.read_text()
    for broken, message in (
        ("not motion at all", "not a BVH file"),
        (text[: len(text) // 2], "expected 40 frames"),
        (text.replace("OFFSET", "OFSET", 1), "has no OFFSET"),
        (text.replace("Frames: 40", "Frames: 41"), "expected 41 frames"),
        (text[:300], "not a BVH file"),
        (f"{text.rsplit(maxsplit=1)[0]} nan\n", "frame 40 is not finite"),
    ):
        path.write_text(broken)
        with pytest.raises(ValueError, match=message) as caught:
            parse_bvh(path)
        assert "a.bvh" in str(caught.value)


def test_real_daz_file_is_the_dance_of_the_archive() -> None:
    path = real_file("bvh/cmu_60_10_daz.bvh")
    truth = next(duet for duet in real_duets() if duet.name == "salsa_10").leader
    assert parse_bvh(path).fps == 120
    # The file states twice its true rate.
    read = read_bvh(path, fps=60).motion[: len(truth)]
    truth = truth[: len(read)]
    # Both were put on other bodies (arms most of all), so trunk and legs are compared, after the best fit.
    joints = [JOINTS.index(name) for name in JOINTS if name in TRUNK or "knee" in name or "ankle" in name]
    a, b = (motion[:, joints].reshape(-1, 3).astype(np.float64) for motion in (read, truth))
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    left, stretch, right = np.linalg.svd(a.T @ b)
    fitted = a @ left @ right * stretch.sum() / np.sum(a**2)
    assert np.linalg.norm(fitted - b, axis=-1).mean() < 0.05


def test_real_character_creator_file_is_a_standing_person() -> None:
    motion = read_bvh(real_file("bvh/cmu_005_01_charactercreator.bvh")).motion
    head = motion[:, JOINTS.index("head"), 1]
    assert 1.4 < head.max() < 1.8
