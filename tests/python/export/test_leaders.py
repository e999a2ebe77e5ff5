"""The leaders that ship: the composed ones are bodies of constant bones that stand on the floor; the demo's tempo."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from export.demo import on_the_beat
from export.leaders.dances import DANCES
from export.leaders.steps import Dance
from export.leaders.write import FIRST, leader
from training.config import FPS
from training.data.bvh.reader import read_bvh
from training.motion.floor import TOE_REST, floor_height
from training.motion.foot_contact import contacts
from training.motion.heading import heading
from training.motion.skeleton import JOINTS, PARENTS
from training.music.demo import Options as Song
from training.music.tempo import CYCLE, Tempo

SHIPPED = Path(__file__).parents[3] / "web" / "public" / "leaders"


@pytest.fixture(scope="module", params=sorted(DANCES))
def name(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture(scope="module")
def motion(name: str) -> np.ndarray:
    return leader(name)


def speed(motion: np.ndarray) -> np.ndarray:
    """(T - 1, 22) m/s."""
    return np.linalg.norm(np.diff(motion, axis=0), axis=-1) * FPS


def turned(motion: np.ndarray) -> float:
    """Radians by which the body turns in all, smaller swings left out."""
    ahead = heading(motion)
    angles = np.unwrap(np.arctan2(ahead[:, 0], ahead[:, 1]))
    return float(np.abs(np.diff(angles[:: round(2.9 * FPS)])).sum())


def test_bones_keep_their_lengths(motion: np.ndarray) -> None:
    bones = motion - motion[:, [max(parent, 0) for parent in PARENTS]]
    lengths = np.linalg.norm(bones, axis=-1)
    assert np.ptp(lengths, axis=0).max() < 2e-3
    left, right = (
        [joint for joint, name in enumerate(JOINTS) if name.startswith(side)] for side in ("left", "right")
    )
    assert np.abs(lengths[:, left].mean(0) - lengths[:, right].mean(0)).max() < 1e-3


def test_feet_stand_without_sliding(motion: np.ndarray) -> None:
    assert floor_height(motion) == pytest.approx(0, abs=2e-3)
    assert motion[..., 1].min() > 0.5 * TOE_REST
    planted, slide = contacts(motion)
    toes = planted[:, 2:]
    assert toes.mean() > 0.45, "both feet are in the air too long"
    assert np.median(slide[:, 2:][toes]) < 0.02
    assert (slide[:, 2:][toes] > 0.3).mean() < 0.12


def test_nothing_jumps(motion: np.ndarray) -> None:
    fast = speed(motion)
    assert fast.max() < 7
    assert np.linalg.norm(np.diff(motion, n=2, axis=0), axis=-1).max() * FPS**2 < 200


def test_knees_and_elbows_bend_the_way_they_do(motion: np.ndarray) -> None:
    at = {name: motion[:, joint] for joint, name in enumerate(JOINTS)}
    across = at["left_hip"] - at["right_hip"]
    ahead = np.cross(across, [0.0, 1.0, 0.0])
    ahead /= np.linalg.norm(ahead, axis=-1, keepdims=True)
    for side in ("left", "right"):
        straight = (at[f"{side}_hip"] + at[f"{side}_ankle"]) / 2
        assert ((at[f"{side}_knee"] - straight) * ahead).sum(-1).min() > -0.05


def test_steps_land_on_the_beat() -> None:
    """In the quick dance feet are slowest at the beats, when they land."""
    motion = leader("quick")
    toes = speed(motion)[:, [JOINTS.index("left_foot"), JOINTS.index("right_foot")]].max(axis=1)
    counts = (np.arange(len(toes)) / FPS + 0.5 / FPS - FIRST) * Song.bpm / 60
    dancing = (counts > 0) & (counts < 80)
    phase = counts % 1
    near = toes[dancing & ((phase < 0.15) | (phase > 0.85))].mean()
    between = toes[dancing & (np.abs(phase - 0.5) < 0.2)].mean()
    assert between > 1.6 * near


def test_the_dances_differ_as_their_names_say() -> None:
    toes = {name: speed(leader(name))[:, [10, 11]].mean() for name in DANCES}
    assert min(toes, key=lambda name: toes[name]) == "slow"
    turns = {name: turned(leader(name)) for name in DANCES}
    assert turns["turning"] > 1.7 * max(turns[name] for name in turns if name != "turning")
    highest = {name: float(leader(name)[:, [10, 11], 1].max()) for name in DANCES}
    assert highest["playful"] > 0.25
    assert max(highest[name] for name in highest if name != "playful") < 0.15


def test_the_shipped_files_are_these(name: str, motion: np.ndarray) -> None:
    shipped = read_bvh(SHIPPED / f"{name}.bvh").motion
    assert len(shipped) == len(motion)
    level = np.array([1.0, 0.0, 1.0])
    assert np.abs((shipped - motion) * level).max() < 0.01
    assert np.ptp((shipped - motion)[..., 1]) < 0.01


def test_easing_keeps_between_its_keys() -> None:
    dance = Dance()
    dance.key(dance.crouch, (0, 0.0), (2, 1.0), (4, 0.5))
    values = dance.crouch.at(np.array([-5.0, 0.0, 1.0, 2.0, 3.0, 9.0]))[:, 0]
    assert values == pytest.approx([0, 0, 0.5, 1.0, 0.75, 0.5])


@pytest.mark.parametrize("skip", [0, 2])
@pytest.mark.parametrize("first", [0.1, 2.9])
def test_the_dance_of_the_demo_is_brought_to_the_counts_of_its_song(first: float, skip: int) -> None:
    dance, song = Tempo(180, first), Tempo(200, 0.35)
    # A motion whose places are the seconds of the dance.
    motion = np.repeat(np.arange(40 * FPS) / FPS, 22 * 3).reshape(-1, 22, 3)
    cut = on_the_beat(motion, dance, song, skip, seconds=12.0)
    assert len(cut) == 12 * FPS
    seconds = np.arange(len(cut)) / FPS
    apart = dance.counts(cut[:, 0, 0]) - song.counts(seconds)
    half_a_frame = 0.5 / FPS * song.bpm / 60
    assert np.abs((apart + CYCLE / 2) % CYCLE - CYCLE / 2).max() < 1.1 * half_a_frame
    # Nothing is left out but the cycles that were asked for, and what begins one.
    cycle = CYCLE * 60 / dance.bpm
    assert skip * cycle - 1 / FPS <= cut[0, 0, 0] < (skip + 1) * cycle + 1 / FPS
