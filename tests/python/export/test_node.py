"""What the page does under Node: solving, and leaders in the bodies of the training."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from export.evaluate import reactor_generator
from export.node import SOLVERS, in_training_bodies, solve_with_node
from export.runtime import open_model
from tests.python.support.bodies import rest_pose, standing
from tests.python.support.duets import made_duet
from tests.python.support.real_data import real_file
from training.data.bvh.reader import read_bvh
from training.data.made import made_dancer
from training.evaluation.metrics.contact import foot_skating
from training.evaluation.metrics.errors import bone_variation
from training.evaluation.metrics.penetration import depth as overlap_depth
from training.motion.other_body import in_body
from training.motion.rest_pose import rest_offsets
from training.motion.skeleton import JOINTS, PARENTS, body_height
from training.music.features import features, load_audio
from training.music.recipe import AudioRecipe

PUBLIC = Path(__file__).parents[3] / "web/public"
pytestmark = pytest.mark.skipif(shutil.which("node") is None, reason="Node is not installed")


def test_the_pages_solver_keeps_bones_rigid():
    """A body whose bones change length gets constant ones, near where it was."""
    motion = made_duet(60, 1).leader
    breathing = motion[:, :1] + (motion - motion[:, :1]) * (1 + 0.05 * np.sin(np.arange(60)))[:, None, None]
    far = motion + np.array([3, 0, 0], np.float32)
    (solved,) = solve_with_node([breathing], far, None)
    assert bone_variation(breathing) > 0.02
    assert bone_variation(solved) < 1e-4
    assert np.linalg.norm(solved - breathing, axis=-1).mean() < 0.05


def test_what_node_says_of_a_failure_is_said():
    motion = made_duet(60, 1).leader
    with pytest.raises(ValueError, match=r"(?s)tools/solve\.mjs failed: .*--no-such-flag"):
        solve_with_node([motion], motion, None, "--no-such-flag")


def test_the_pages_solver_keeps_the_dancer_out_of_the_leader():
    """A dancer inside the leader is moved aside over the floor, no farther than needed; only arms, which hold the
    leader's hands, leave their height.
    """
    motion = np.repeat(made_duet(90, 1).leader[:1], 90, axis=0)
    inside = motion + np.array([0.1, 0, 0], np.float32)
    free, solved = (
        solve_with_node([inside], motion + np.array([x, 0, 0], np.float32), None)[0] for x in (3, 0)
    )
    aside = solved - free
    assert np.median(overlap_depth(motion, inside)) > 0.1
    body = [j for j, joint in enumerate(JOINTS) if "elbow" not in joint and "wrist" not in joint]
    assert np.abs(aside[:, body, 1]).max() < 1e-6  # legs are computed again from where they are
    assert 0.05 < np.linalg.norm(aside[:, body], axis=-1).max() < 0.64
    trunk = [JOINTS.index(joint) for joint in ("pelvis", "spine1", "spine2", "spine3", "neck", "head")]
    assert np.linalg.norm(solved[:, trunk] - motion[:, trunk], axis=-1).min() > 0.2


def test_the_row_with_foot_lock_has_less_skating() -> None:
    motion = made_duet(120, 1).leader
    far = motion + np.array([3, 0, 0], np.float32)
    free, locked = (solve([motion], far, None)[0] for solve in SOLVERS.values())
    assert foot_skating(locked)["skate_share"] < 0.5 * foot_skating(free)["skate_share"]


def test_a_drawn_dancer_who_would_slide_steps_to_the_beats_of_the_music() -> None:
    frames, gap, recipe = 240, 13, AudioRecipe()
    clicks = np.zeros(frames * recipe.hop)
    for beat in range(0, frames, gap):
        clicks[beat * recipe.hop :][:800] = np.random.default_rng(0).normal(size=800) * np.geomspace(
            1, 0.01, 800
        )
    music = features(clicks, recipe)[:frames]
    there_and_back = 2 - np.abs(np.arange(frames) * 1.4 / 30 % 4 - 2)
    travel = there_and_back[:, None, None] * np.array([1, 0, 0], np.float32)
    standing = np.repeat(made_duet(frames, 1).leader[:1], frames, axis=0)
    (danced,) = solve_with_node([standing + travel], standing + travel + np.array([0, 0, 1]), music)
    speed = np.linalg.norm(np.diff(danced[:, JOINTS.index("left_ankle")], axis=0), axis=-1)
    step = np.arange(frames - 1) // gap
    inner = (step > 1) & (step < 16)
    # The foot stands during every second beat; during which is told by the first beat that is found.
    stands, flies = sorted(speed[inner & (step % 2 == half)].mean() for half in (0, 1))
    assert flies > 1.4 * stands


def bones(motion: np.ndarray) -> np.ndarray:
    """Mean lengths (21,) of the bones of a motion (T, 22, 3)."""
    return np.linalg.norm(motion[:, 1:] - motion[:, PARENTS[1:]], axis=-1).mean(0)


def test_a_dance_in_another_body_turns_the_same_joints_and_goes_as_far_in_proportion() -> None:
    motion = made_dancer(90, 1)
    own = rest_offsets(motion)
    assert np.abs(in_body(motion, own.tolist()) - motion).max() < 0.01
    other = own * np.linspace(0.8, 1.2, 22)[:, None]
    made = in_body(motion, other.tolist())
    assert bones(made) == pytest.approx(np.linalg.norm(other[1:], axis=-1), abs=1e-4)
    elbow, wrist = JOINTS.index("left_elbow"), JOINTS.index("left_wrist")
    forearms = [m[:, wrist] - m[:, elbow] for m in (motion, made)]
    cosine = np.sum(forearms[0] * forearms[1], axis=-1) / np.prod(
        [np.linalg.norm(f, axis=-1) for f in forearms], axis=0
    )
    assert cosine.min() > 0.995
    way = [(m[-1, 0] - m[0, 0])[[0, 2]] for m in (motion, made)]
    assert way[1] == pytest.approx(way[0] * body_height(made) / body_height(motion), abs=1e-3)


def test_a_generator_is_given_leaders_in_the_body_of_their_role_and_all_else_as_it_is() -> None:
    given: list[tuple[np.ndarray, dict]] = []

    def generate(leader, music, seed, **controls):
        given.append((leader, controls))
        return leader

    pose = rest_pose()
    own = (pose - pose[[0, *PARENTS[1:]]]).tolist()
    wide = (np.array(own) * np.where(np.arange(22) == JOINTS.index("left_collar"), 2, 1)[:, None]).tolist()
    wrapped = in_training_bodies(generate, {"leader": own, "reactor": wide})
    leader = standing(8).astype(np.float32)
    wrapped(leader, None, 0)
    wrapped(leader, None, 0, role=1.0, variety=0.5)
    wrapped(leader, None, 0, condition_leader=1.5 * leader)
    (plain, of_plain), (_, of_role), (_, of_other) = given
    assert plain is leader
    assert of_plain["condition_leader"] == pytest.approx(leader, abs=0.01)
    assert np.abs(of_role["condition_leader"] - leader).max() > 0.05
    assert (of_role["role"], of_role["variety"]) == (1.0, 0.5)
    assert of_other["condition_leader"] == pytest.approx(leader, abs=0.01), "at the height of that body"


def test_the_partner_of_a_salsa_leader_on_another_rig_stays_upright() -> None:
    """Its shoulders are where no dancer of the training has them: given as it is, the partner falls to 0.5 m."""
    leader = read_bvh(real_file("bvh/cmu_60_10_daz.bvh"), fps=60).motion[:240]
    recipe = AudioRecipe()
    song = features(load_audio(PUBLIC / "demo/song.mp3", recipe), recipe)
    model = open_model(PUBLIC / "models/salsa")
    bodies = json.loads((PUBLIC / "models/salsa/manifest.json").read_text())["skeleton"]["training_bodies"]
    plain = reactor_generator(model)
    head = JOINTS.index("head")

    def lowest(motion: np.ndarray) -> float:
        return float((motion[:, head, 1] - motion[..., 1].min(axis=1)).min())

    assert lowest(in_training_bodies(plain, bodies)(leader, song, 0)) > 1.15
    assert lowest(plain(leader, song, 0)) < 0.9
