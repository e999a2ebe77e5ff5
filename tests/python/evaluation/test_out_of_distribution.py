"""Out-of-distribution leaders: each demand fails for a partner that breaks it, and for no other."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.python.support.duets import made_duet
from tests.python.support.made_bvh import MadeDancer, write_bvh
from training.data.duet import Solo
from training.data.made import made_dancer
from training.evaluation.out_of_distribution import (
    FAULTS,
    measure_faults,
    measure_out_of_distribution,
    measure_partner,
    read_leaders,
)
from training.evaluation.protocol import HeldOutDuet, Settings
from training.motion.floor import put_on_floor
from training.motion.skeleton import JOINTS

TOES = (JOINTS.index("left_foot"), JOINTS.index("right_foot"))


@pytest.fixture(scope="module")
def leader() -> np.ndarray:
    return put_on_floor(made_dancer(200, 1))


def failed(leader: np.ndarray, reactor: np.ndarray) -> set[str]:
    row = measure_partner(leader, reactor)
    assert row["passed"] == all(row["checks"].values())
    return {name for name, passed in row["checks"].items() if not passed}


def near(leader: np.ndarray) -> np.ndarray:
    return leader + np.array([0.0, 0.0, 0.8])


def test_a_good_partner_passes(leader: np.ndarray):
    row = measure_partner(leader, near(leader))
    assert row["passed"]
    assert row["distance_median_m"] == pytest.approx(0.8)
    assert row["distance_max_m"] == pytest.approx(0.8)
    assert row["speed"] == pytest.approx(row["leader_speed"])


def test_a_coordinate_that_is_not_a_number_fails(leader: np.ndarray):
    reactor = near(leader)
    reactor[50, 3, 1] = np.nan
    assert "finite" in failed(leader, reactor)


def test_feet_have_to_be_on_the_floor(leader: np.ndarray):
    for shift, bad in ((0.08, False), (0.14, True), (-0.03, False), (-0.09, True)):
        reactor = near(leader)
        reactor[:, TOES, 1] = 0.03 + shift
        assert ("on the floor" in failed(leader, reactor)) == bad, shift
    # One raised foot is a step; both raised in a tenth of the dance is flying, in a hundredth it is not.
    step = near(leader)
    step[:, TOES, 1] = 0.03, 0.5
    assert "on the floor" not in failed(leader, step)
    for frames, bad in ((20, True), (1, False)):
        jump = near(leader)
        jump[:, TOES, 1] = 0.03
        jump[:frames, TOES, 1] = 0.5
        assert ("on the floor" in failed(leader, jump)) == bad, frames


def test_the_roots_have_to_be_near(leader: np.ndarray):
    assert failed(leader, leader + np.array([2.9, 0.0, 0.0])) == set()
    assert failed(leader, leader + np.array([3.1, 0.0, 0.0])) == {"near"}
    once = near(leader)
    once[100] += np.array([3.0, 0.0, 0.0])  # one frame is enough
    assert "near" in failed(leader, once)


def test_the_reactor_may_not_be_much_faster_than_the_leader():
    still = np.repeat(put_on_floor(made_dancer(1, 1)), 121, axis=0)
    slow, fast = (still.astype(np.float64) for _ in range(2))
    slow[:, :, 0] += np.linspace(0, 4 * 0.29, 121)[:, None]  # m/s over 4 s
    fast[:, :, 0] += np.linspace(0, 4 * 0.31, 121)[:, None]
    assert failed(still, slow) == set()
    assert failed(still, fast) == {"speed"}
    # A leader at 0.29 m/s lets the partner have 0.88.
    assert failed(slow, still + 3.0 * (slow - still)) == set()
    assert failed(slow, still + 3.1 * (slow - still)) == {"speed"}


def faults(leader: np.ndarray, reactor: np.ndarray) -> dict[str, float]:
    """The faults that were found and their shares."""
    shares = measure_faults(leader, reactor)
    assert list(shares) == list(FAULTS)
    return {name: share for name, share in shares.items() if share}


@pytest.fixture
def still() -> np.ndarray:
    return np.repeat(put_on_floor(made_dancer(1, 1)), 121, axis=0).astype(np.float64)


def test_a_partner_who_stands_has_no_faults(still: np.ndarray):
    assert faults(still, near(still)) == {}


def test_a_root_glides_that_is_much_faster_than_the_leader(still: np.ndarray):
    def moving(speed: float, frames: slice) -> np.ndarray:
        """A body that is carried at this speed, m/s, in some of the frames."""
        steps = np.zeros(121)
        steps[frames] = speed / 30
        return still + np.cumsum(steps)[:, None, None] * np.array([1.0, 0.0, 0.0])

    always = slice(None)
    assert "gliding_share" not in faults(still, near(moving(1.45, always)))
    assert faults(still, near(moving(1.6, always)))["gliding_share"] == 1
    # Beside a leader at 2 m/s it may have 3, and for half a second before and after.
    leader = moving(2.0, slice(60, 61))
    assert "gliding_share" not in faults(leader, near(moving(2.9, slice(46, 75))))
    assert faults(leader, near(moving(3.1, slice(46, 75))))["gliding_share"] == pytest.approx(29 / 120)
    assert faults(leader, near(moving(2.9, slice(30, 31))))["gliding_share"] == pytest.approx(1 / 120)


def test_a_joint_snaps_that_accelerates_by_more_than_a_body_can(still: np.ndarray):
    for metres, share in ((0.05, 0.0), (0.12, 3 / 119)):  # 45 and 108 m/s^2, and twice that at the top
        reactor = near(still)
        reactor[60, JOINTS.index("left_wrist"), 0] += metres
        assert faults(still, reactor).get("snapping_share", 0.0) == pytest.approx(share), metres


def test_a_partner_floats_or_stands_on_tiptoe_inside_the_leader(still: np.ndarray):
    def lifted(metres: float, away: float) -> np.ndarray:
        return still + np.array([0.0, metres, away])

    assert faults(still, lifted(0.1, away=0.8)) == {}
    assert faults(still, lifted(0.13, away=0.8)) == {"floating_share": 1}
    assert faults(still, lifted(0.03, away=0.1)) == {}
    assert faults(still, lifted(0.07, away=0.1)) == {"tiptoe_share": 1}


def test_a_partner_slides_on_both_feet_unless_one_of_them_stands_or_both_are_in_the_air(still: np.ndarray):
    way = np.arange(121)[:, None, None] / 30 * np.array([1.0, 0.0, 0.0])  # 1 m/s
    assert "sliding_share" not in faults(still, near(still + 0.55 * way))
    carried = near(still + 0.65 * way)
    assert faults(still, carried) == {"sliding_share": 1}
    standing = carried.copy()
    standing[:60, TOES[0]] = standing[0, TOES[0]]
    assert faults(still, standing)["sliding_share"] == pytest.approx(61 / 120)
    assert "sliding_share" not in faults(still, carried + np.array([0.0, 0.06, 0.0]))


def test_leaders_are_reported_apart_by_whether_they_were_seen_in_training(tmp_path: Path):
    held_out = [
        HeldOutDuet(made_duet(60, 1, "a"), np.full((60, 54), 1.0)),
        HeldOutDuet(made_duet(60, 2, "b"), np.full((60, 54), 2.0)),
    ]
    names = ("martial_0", "martial_1", "modern_2")
    leaders = [Solo(name, put_on_floor(made_dancer(50 + 40 * i, i))) for i, name in enumerate(names)]
    calls = []

    def generate(
        leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
    ):
        calls.append((len(leader), music.shape, float(music.mean()), seed, role))
        return near(leader) + (10.0 if len(leader) == 90 else 0.0)

    groups, dances = measure_out_of_distribution(
        generate, leaders, held_out, Settings(seeds=(7, 8), seen_leaders=("indian", "modern"))
    )
    assert calls == [(50, (50, 54), 1.0, 7, 0.0), (90, (90, 54), 2.0, 7, 0.0), (130, (130, 54), 1.0, 7, 0.0)]
    seen, unseen = groups["seen"], groups["unseen"]
    assert (seen["count"], seen["passed"], list(seen["leaders"])) == (1, 1, ["modern_2"])
    assert (unseen["count"], unseen["passed"]) == (2, 1)
    assert [unseen["leaders"][name]["passed"] for name in ("martial_0", "martial_1")] == [True, False]
    assert [(d.name, len(d.reactor)) for d in dances] == [
        ("martial_0", 50),
        ("martial_1", 90),
        ("modern_2", 130),
    ]
    assert "overlap_share_solved" not in unseen["leaders"]["martial_0"]

    # What is drawn is the fitted skeleton; overlaps are reported before and after.
    def inside(leader, music, seed, **_):
        return leader.copy()

    def step_aside(motions, leader, music):
        assert len(music) == len(leader)
        return [motion + np.array([3, 0, 0], np.float32) for motion in motions]

    groups, dances = measure_out_of_distribution(inside, leaders[:1], held_out, Settings(), step_aside)  # pyright: ignore[reportArgumentType]
    row = groups["unseen"]["leaders"]["martial_0"]
    assert row["overlap_share"] == 1.0
    assert row["overlap_share_solved"] == 0.0
    assert set(FAULTS) <= set(row)
    assert np.array_equal(dances[0].reactor, leaders[0].motion + np.array([3, 0, 0], np.float32))
    without_music, _ = measure_out_of_distribution(
        lambda leader, music, seed: near(leader) if music is None else leader,  # pyright: ignore[reportArgumentType]
        leaders[:1], [HeldOutDuet(held_out[0].duet, None)], Settings(),
    )  # fmt: skip
    row = without_music["unseen"]["leaders"]["martial_0"]
    assert row["distance_max_m"] == pytest.approx(0.8)


def test_leaders_are_read_from_archives_and_files(tmp_path: Path):
    np.savez(tmp_path / "solo.npz", martial_1=made_dancer(40, 1), modern_1=made_dancer(50, 2))
    write_bvh(tmp_path / "waltz.bvh", MadeDancer(30, seed=3), "own", unit=0.01)
    leaders = read_leaders([tmp_path / "solo.npz", tmp_path / "waltz.bvh"])
    assert [leader.name for leader in leaders] == ["martial_1", "modern_1", "waltz"]
    with pytest.raises(ValueError, match="waltz"):
        read_leaders([tmp_path / "waltz.bvh", tmp_path / "waltz.bvh"])
