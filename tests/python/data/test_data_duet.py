"""The duet type, the npz reader, floors and splits."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.python.support.duets import made_duet
from tests.python.support.real_data import real_duets, real_file
from training.data.duet import Duet
from training.data.made import made_dancer
from training.data.npz import read_npz, read_solo
from training.data.sources import read_duets
from training.data.splits import Split, split, summary
from training.motion.floor import TOE_REST, floor_height, put_on_floor
from training.motion.skeleton import JOINTS


def save(path: Path, **arrays: Any) -> None:
    """An npz archive; np.savez itself cannot be typed with unpacked names."""
    np.savez(path, **arrays)


TOES = [JOINTS.index("left_foot"), JOINTS.index("right_foot")]


def test_a_duet_of_wrong_shape_type_or_length_is_an_error() -> None:
    good = made_dancer(20, seed=0)
    with pytest.raises(ValueError, match="leader of x: expected"):
        Duet("x", good[:, :21], good)
    with pytest.raises(ValueError, match="reactor of x: expected float32"):
        Duet("x", good, good.astype(np.float64))
    with pytest.raises(ValueError, match="20 frames, the reactor 19"):
        Duet("x", good, good[:19])
    with pytest.raises(ValueError, match="no frames"):
        Duet("x", good[:0], good[:0])
    broken = good.copy()
    broken[7, 3, 1] = np.nan
    with pytest.raises(ValueError, match="reactor of x: 1 frames are not finite, the first is 7"):
        Duet("x", good, broken)


def test_a_frame_that_is_not_finite_is_named(tmp_path: Path) -> None:
    """It alone, not all frames: the floor is found from the others."""
    duet = made_duet(50, seed=1)
    duet.reactor[7, TOES[0], 1] = np.nan
    save(tmp_path / "duets.npz", **{"a/leader": duet.leader, "a/follower": duet.reactor})
    with pytest.raises(ValueError, match="reactor of a: 1 frames are not finite, the first is 7"):
        read_npz(tmp_path / "duets.npz")


def test_an_archive_of_flat_rows_is_refused_by_its_shape(tmp_path: Path) -> None:
    flat = made_dancer(20, 1).reshape(20, 66)
    save(tmp_path / "duets.npz", **{"a/leader": flat, "a/follower": flat})
    with pytest.raises(ValueError, match=r"duets\.npz: a/leader: expected \(T, 22, 3\), got \(20, 66\)"):
        read_npz(tmp_path / "duets.npz")


def test_what_holds_no_duets_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="nowhere does not exist"):
        read_duets(tmp_path / "nowhere")
    np.save(tmp_path / "leader.npy", made_dancer(20, 1))
    with pytest.raises(ValueError, match=r"leader\.npy holds no duets"):
        read_duets(tmp_path / "leader.npy")
    save(tmp_path / "page.npz", leader=made_dancer(20, 1), reactor=made_dancer(20, 2))
    with pytest.raises(ValueError, match=r"page\.npz: no NAME/leader and NAME/follower in it"):
        read_duets(tmp_path / "page.npz")


def test_what_was_read_is_said_in_a_line() -> None:
    song, silent = replace(made_duet(40, 1), song=Path("a.mp3")), made_duet(30, 2)
    assert summary(Split((song, silent), (made_duet(40, 3),), ()), window=40) == (
        "3 duets of 0.1 minutes: 2 to train on, 1 of them with a song of their own, 1 shorter than a window of 1.33 s; "
        "1 for validation, 0 for test"
    )


def test_npz_maps_the_follower_to_the_reactor_and_puts_floors_at_0(tmp_path: Path) -> None:
    duet = made_duet(50, seed=1)
    low = np.array([0, -0.7, 0], dtype=np.float32)
    path = tmp_path / "duets.npz"
    save(
        path,
        **{"b/leader": duet.leader + low, "b/follower": duet.reactor, "a/leader": duet.leader},
        **{"a/follower": duet.reactor, "fps": np.array(30), "joints": np.array(JOINTS)},
    )
    a, b = read_npz(path)
    assert (a.name, b.name) == ("a", "b")
    np.testing.assert_allclose(a.leader, put_on_floor(duet.leader))
    np.testing.assert_allclose(a.reactor, put_on_floor(duet.reactor))
    np.testing.assert_allclose(b.leader, a.leader, atol=1e-6)


def test_npz_errors_name_the_file_and_the_fault(tmp_path: Path) -> None:
    motion = made_dancer(8, seed=0)
    path = tmp_path / "duets.npz"
    save(path, **{"a/leader": motion})
    with pytest.raises(ValueError, match=r"duets\.npz: a has no follower"):
        read_npz(path)
    save(path, **{"a/leader": motion, "a/follower": motion, "fps": np.array(60)})
    with pytest.raises(ValueError, match=r"60\.0 fps, expected 30"):
        read_npz(path)
    save(path, **{"a/leader": motion, "a/follower": motion, "joints": np.array(JOINTS[::-1])})
    with pytest.raises(ValueError, match="SMPL order"):
        read_npz(path)
    np.savez(path, solo=motion)
    with pytest.raises(ValueError, match="no NAME/leader"):
        read_npz(path)


def test_solos_are_read_by_name(tmp_path: Path) -> None:
    np.savez(tmp_path / "solo.npz", b=made_dancer(9, 1), a=made_dancer(5, 2), fps=np.array(30))
    assert [(solo.name, len(solo)) for solo in read_solo(tmp_path / "solo.npz")] == [("a", 5), ("b", 9)]


def test_a_planted_toe_rests_above_the_floor_wherever_the_file_had_it() -> None:
    motion = made_dancer(200, seed=3)
    lifted = put_on_floor(motion + np.array([0, 1.3, 0], dtype=np.float32))
    np.testing.assert_allclose(lifted, put_on_floor(motion), atol=1e-6)
    assert np.percentile(lifted[:, TOES, 1].min(axis=1), 10) == pytest.approx(TOE_REST, abs=1e-6)
    assert floor_height(lifted) == pytest.approx(0, abs=1e-6)


def test_split_puts_every_duet_in_one_part_and_refuses_unknown_names() -> None:
    duets = [made_duet(4, seed, name) for seed, name in enumerate("abcd")]
    parts = split(duets, val=["b"], test=["d"])
    assert [[duet.name for duet in part] for part in (parts.train, parts.val, parts.test)] == [
        ["a", "c"],
        ["b"],
        ["d"],
    ]
    with pytest.raises(ValueError, match="not among the duets"):
        split(duets, val=["e"], test=[])
    with pytest.raises(ValueError, match="both validation and test"):
        split(duets, val=["a"], test=["a"])
    with pytest.raises(ValueError, match="occur twice"):
        split([*duets, duets[0]], val=[], test=[])


def test_real_duets_stand_on_the_floor_and_near_each_other() -> None:
    duets = real_duets()
    assert len(duets) == 12
    for duet in duets:
        for motion in (duet.leader, duet.reactor):
            assert floor_height(motion) == pytest.approx(0, abs=1e-5)
            assert motion[..., 1].min() > -0.06
        apart = np.linalg.norm((duet.leader - duet.reactor)[:, 0, [0, 2]], axis=-1)
        assert 0.55 < np.median(apart) < 0.9
    assert len(read_solo(real_file("cmu_solo/solo.npz"))) == 32
