"""Controls over their travel, with a made generator whose response to each of them is known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.python.support.bodies import standing, turned
from tests.python.support.duets import made_duet
from tests.python.support.held_out import generate_mirrored
from training.config import CONTROLS
from training.data.duet import Duet, Solo
from training.evaluation.controls import measure_controls, travel
from training.evaluation.evaluate import evaluate
from training.evaluation.limits import at_end
from training.evaluation.metrics.errors import mpjpe, root_error
from training.evaluation.metrics.speed import joint_acceleration
from training.evaluation.protocol import ControlledDance, HeldOutDuet, Settings
from training.evaluation.report.report_text import markdown
from training.motion.skeleton import JOINTS

FRAMES = 120
HEAD = JOINTS.index("head")
OTHERS = len(JOINTS) - 1  # joints beside the root, whose pose is 0
DEFAULTS = {"coarse": 0.2, "fine": -0.1, "music": 0.0, "variety": 1.0}
SECONDS = np.arange(FRAMES) / 30


def swinging(leader, guidance, music_guidance, song: float, variety, seed: int) -> np.ndarray:
    """A body that faces the leader, 0.8 m away, whose head swings sideways slowly and up and down quickly.

    Coarse moves the body away by 0.1 m and scales the slow swing, fine scales the quick one; the song lifts the joints
    by 1 cm for each of its numbers, and variety moves those of seed 0 and 1 to either side by 5 cm.
    """
    coarse, fine = guidance
    made = turned(standing(len(leader)), 180) + leader[:, :1] * [1, 0, 1]
    made[..., 2] += 0.8 + 0.1 * coarse
    made[:, 1:, 1] += 0.01 * music_guidance * song
    made[:, 1:, 0] += 0.05 * variety * (-1) ** seed
    made[:, HEAD, 0] += 0.3 * (1 + coarse) * np.sin(2 * np.pi * 0.5 * SECONDS)
    made[:, HEAD, 1] += 0.05 * (1 + fine) * np.sin(2 * np.pi * 6 * SECONDS)
    return made


def generate(
    leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
):
    return swinging(leader, guidance, music_guidance, music[0, 0], variety, seed)


def song(number: float) -> np.ndarray:
    return np.full((FRAMES, 54), number, np.float32)


def truth() -> np.ndarray:
    """A reactor who slides from side to side, so that the share of skating is known not to be 0."""
    true = turned(standing(FRAMES), 180) + np.array([0.0, 0.0, 0.9])
    true[..., 0] += 0.2 * np.sin(2 * np.pi * 0.5 * SECONDS)[:, None]
    return true


@pytest.fixture(scope="module")
def dances() -> list[ControlledDance]:
    """The second one, elsewhere in the room, has no truth."""
    leader = standing(FRAMES)
    return [
        ControlledDance(leader, song(1), song(4), truth()),
        ControlledDance(leader + np.array([5.0, 0, 5.0]), song(2), song(5), None),
    ]


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
def test_travel_has_both_ends_the_quarters_between_and_the_default(control: str, share: float):
    limits = CONTROLS[control]
    default = limits.low + share * (limits.high - limits.low)
    values = travel(control, default)
    assert (values[0], values[-1]) == (limits.low, limits.high)
    assert values == sorted(set(values))
    assert len(values) == (9 if 0 < share < 1 else 5)
    at = values.index(round(default, 4))
    for part in (values[: at + 1], values[at:]):
        if len(part) > 1:
            assert np.diff(part) == pytest.approx((part[-1] - part[0]) / 4, abs=2e-4)


def test_every_control_moves_what_it_moves_and_the_others_stay_at_their_defaults(
    dances: list[ControlledDance],
):
    found = measure_controls(generate, dances, DEFAULTS, (0, 1), 240)
    assert list(found) == list(CONTROLS)
    pose = 1000 * OTHERS / len(JOINTS)  # mm by which the mean joint moves where the others move by 1 m
    for control, rows in found.items():
        assert [row["value"] for row in rows] == travel(control, DEFAULTS[control])
        for row in rows:
            change = row["value"] - DEFAULTS[control]
            weights = {**DEFAULTS, control: row["value"]}
            expected = {
                "root_moved_mm": 100 * abs(change) if control == "coarse" else 0,
                "distance_m": 0.8 + 0.1 * weights["coarse"],
                "facing_deg": 180,
                "slow_ratio": ((1 + weights["coarse"]) / (1 + DEFAULTS["coarse"])) ** 2,
                "quick_ratio": ((1 + weights["fine"]) / (1 + DEFAULTS["fine"])) ** 2,
            }
            # The mean size of a sine is 2 / pi, and the head is one of 22 joints.
            expected["pose_moved_mm"] = {
                "coarse": 300 * abs(change) * 2 / np.pi / len(JOINTS),
                "fine": 50 * abs(change) * np.abs(np.sin(2 * np.pi * 6 * SECONDS)).mean() / len(JOINTS),
                "music": 0.01 * abs(change) * 1.5 * pose,
                "variety": 0.05 * abs(change) * pose,
            }[control]
            for key, value in expected.items():
                assert row[key] == pytest.approx(value, rel=0.02, abs=0.01), (control, row["value"], key)
            assert ("songs_apart_mm" in row) == (control == "music")
            assert ("seeds_apart_mm" in row) == (control == "variety")
    for row in found["music"]:
        assert row["songs_apart_mm"] == pytest.approx(0.01 * row["value"] * 3 * pose, abs=1e-3)
    for row in found["variety"]:
        assert row["seeds_apart_mm"] == pytest.approx(0.1 * row["value"] * pose, abs=1e-3)


def test_measures_against_the_truth_are_of_the_dances_that_have_one(dances: list[ControlledDance]):
    rows = measure_controls(generate, dances, DEFAULTS, (0,), 240)["coarse"]
    dance, true = dances[0], dances[0].reactor
    assert true is not None
    for row in (rows[0], rows[-1]):
        made = swinging(dance.leader, (row["value"], -0.1), 0.0, 1, 1.0, 0)
        assert row["mpjpe_mm"] == pytest.approx(mpjpe(true, made))
        assert row["root_error_mm"] == pytest.approx(root_error(dance.leader, true, made))
        assert row["acceleration_ratio"] == pytest.approx(joint_acceleration(made) / joint_acceleration(true))
        assert row["skate_ratio"] == 0, "the made one stands"
        assert row["contact_ratio"] == pytest.approx(1)
        assert row["overlap_points"] == 0
        assert "seams_ratio" not in row, "four seconds are one block"
    alone = measure_controls(generate, dances[1:], DEFAULTS, (0,), 240)["coarse"][0]
    assert "mpjpe_mm" not in alone
    inside = replace(dance, reactor=true - np.array([0.0, 0.0, 0.9]))
    (near, *_, far) = measure_controls(generate, [inside], DEFAULTS, (0,), 240)["coarse"]
    assert near["overlap_points"] == far["overlap_points"] == -100


def test_the_echo_of_the_leaders_beats_is_that_of_the_delay():
    """A leader whose beats are 30 frames apart, echoed as many frames late as the weight of the song."""
    leader = standing(600)
    leader[..., 0] += 0.2 * np.sin(2 * np.pi * np.arange(600) / 60)[:, None]

    def late(
        leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
    ):
        return np.roll(leader, round(music_guidance or 0), axis=0) + np.array([0.0, 0.0, 0.8])

    rows = measure_controls(late, [ControlledDance(leader, None, None, None)], DEFAULTS, (0,), 240)["music"]
    for row in rows:
        assert row["bed_forward"] == pytest.approx(np.exp(-(round(row["value"]) ** 2) / 18), abs=0.05)


def test_evaluation_moves_the_controls_beside_held_out_duets_and_named_leaders(
    held_out: list[HeldOutDuet], train: list[Duet]
):
    settings = Settings(
        seeds=(0,),
        response_seeds=1,
        seam_starts=(0,),
        two_sample=False,
        controls=True,
        controlled_leaders=("martial_1",),
        guidance_grid=(0.0,),
    )
    heard = []

    def recorded(
        leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
    ):
        if music_guidance == CONTROLS["music"].high:
            heard.append((len(leader), int(np.flatnonzero(music[:, -1])[1])))
        return generate_mirrored(leader, music, seed, condition_leader)

    def beside(
        leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
    ):
        return generate_mirrored(leader, music, seed) + np.array([0.0, 0.0, 1.0])

    leaders = [Solo("martial_1", made_duet(300, 5).leader), Solo("martial_2", made_duet(90, 6).leader)]
    numbers = evaluate(
        recorded,
        held_out,
        train,
        240,
        settings,
        out_of_distribution=leaders,
        controlled=[Solo("demo", made_duet(240, 7).leader)],
        control_defaults=DEFAULTS,
        guided_at_every_step=beside,
    ).numbers
    # Each dance with its own song, whose beats are 20 and 24 frames apart, and with the next one's.
    assert heard == [(560, 20), (560, 24), (500, 24), (500, 20), (300, 20), (300, 24), (240, 24), (240, 20)]
    # This generator hears the song and no weight.
    assert at_end("coarse", "lower", "pose_moved_mm")(numbers) == 0
    assert (at_end("music", "upper", "songs_apart_mm")(numbers) or 0) > 0.5
    assert at_end("fine", "upper", "acceleration_ratio")(numbers) is not None
    # The grid is of the model with guidance at every step.
    (cell,) = numbers["guidance"]
    assert cell["mpjpe_mm"] == pytest.approx(numbers["rows"]["generated"]["mean"]["mpjpe_mm"])
    assert cell["root_error_mm"] > numbers["rows"]["generated"]["mean"]["root_error_mm"] + 100
    text = markdown(numbers, "made", [], [])
    assert "## Controls over their travel" in text
    assert all(f"### {control}" in text for control in CONTROLS)
    assert "songs_apart_mm" in text
    with pytest.raises(ValueError, match="nobody"):
        evaluate(
            generate_mirrored,
            held_out[:1],
            train,
            240,
            replace(settings, controlled_leaders=("nobody",)),
            out_of_distribution=leaders,
            control_defaults=DEFAULTS,
        )


def test_block_boundaries_are_measured_where_there_are_some():
    """A reactor who is the true one but for a jump of 5 cm where the second block begins."""
    true = np.tile(truth(), (3, 1, 1))

    jumped_motion = true + (np.arange(len(true)) >= 240)[:, None, None] * np.array([0, 0.05, 0])

    dance = ControlledDance(np.tile(standing(FRAMES), (3, 1, 1)), None, None, true)
    (at_rest,), (jumped,) = (
        {
            row["seams_ratio"]
            for row in measure_controls(lambda *_, motion=motion, **__: motion, [dance], DEFAULTS, (0,), 240)[
                "fine"
            ]
        }
        for motion in (true, jumped_motion)
    )
    assert at_rest == pytest.approx(1)
    assert jumped > 2


def test_what_is_drawn_is_measured_where_a_solver_is_given(dances: list[ControlledDance]):
    """The solver gets all seeds of a dance beside its leader and with its song, and what it returns is measured."""
    asked = []

    def lowered(motions, leader, music):
        asked.append((len(motions), (float(leader[0, 0, 0]), float(music[0, 0]))))
        return [motion * np.array([1, 0.5, 1]) for motion in motions]

    raw = measure_controls(generate, dances, DEFAULTS, (0, 1), 240)["fine"][0]
    drawn = measure_controls(generate, dances, DEFAULTS, (0, 1), 240, lowered)["fine"][0]
    assert {count for count, _ in asked} == {2}
    # The other song is danced to where the music is moved.
    assert {place for _, place in asked} == {(0, 1), (0, 4), (5, 2), (5, 5)}
    assert drawn["pose_moved_mm"] == pytest.approx(raw["pose_moved_mm"] / 2)
