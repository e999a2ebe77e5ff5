"""What each control of the page does over its travel: how far it moves the dance, and what of the motion it changes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from training.config import CONTROLS
from training.evaluation.metrics import mean_report
from training.evaluation.metrics.beats import beat_alignment, motion_beats
from training.evaluation.metrics.contact import foot_skating
from training.evaluation.metrics.distance import facing, root_distance
from training.evaluation.metrics.errors import mpjpe, root_error
from training.evaluation.metrics.penetration import penetration
from training.evaluation.metrics.response import between_seeds
from training.evaluation.metrics.seams import boundaries, seam_ratio, seam_sample
from training.evaluation.metrics.speed import band_power, joint_acceleration
from training.evaluation.protocol import ControlledDance, ReactorGenerator, Solver

SLOW_HZ, QUICK_HZ = (0.0, 1.5), (3.0, 15.0)
QUARTERS = (1.0, 0.75, 0.5, 0.25)  # shares of the way from the default to an end


def travel(control: str, default: float) -> list[float]:
    """Nine values of a control, or five where the default is an end: both ends, the quarters between, the default."""
    low, high = CONTROLS[control].low, CONTROLS[control].high
    below = [default + (low - default) * share for share in QUARTERS if low < default]
    above = [default + (high - default) * share for share in reversed(QUARTERS) if high > default]
    return [round(value, 4) for value in (*below, default, *above)]


def measure_controls(
    generate: ReactorGenerator,
    dances: Sequence[ControlledDance],
    defaults: Mapping[str, float],
    seeds: Sequence[int],
    block: int,
    solve: Solver | None = None,
) -> dict[str, list[dict[str, float]]]:
    """For each control the rows of its `travel`, means over dances and seeds; the other controls at their defaults.
    What is measured against the truth is the mean over the dances that have one. block: frames of the model's
    blocks. solve: the skeleton that is drawn, to measure that in place of the generated joints.

    `value` and everything of `_measure`; for music also songs_apart_mm (pose, beside the same dance to another song
    where there is one), for variety seeds_apart_mm (pose, between the seeds).
    """

    def make(
        dance: ControlledDance, changed: Mapping[str, float], other_song: bool = False
    ) -> list[np.ndarray]:
        weights = {**defaults, **changed}
        music = dance.other_music if other_song else dance.music
        made = [
            generate(
                dance.leader,
                music,
                seed,
                guidance=(weights["coarse"], weights["fine"]),
                music_guidance=weights["music"],
                variety=weights["variety"],
            )
            for seed in seeds
        ]
        return solve(made, dance.leader, music) if solve else made

    before = [make(dance, {}) for dance in dances]
    result: dict[str, list[dict[str, float]]] = {}
    for control in CONTROLS:
        result[control] = []
        for value in travel(control, defaults[control]):
            rows = []
            for dance, usual in zip(dances, before, strict=True):
                made = make(dance, {control: value})
                row = mean_report([_measure(dance, *pair, block) for pair in zip(usual, made, strict=True)])
                if control == "music" and dance.other_music is not None:
                    other = make(dance, {control: value}, other_song=True)
                    pairs = [between_seeds(pair)["pose_mm"] for pair in zip(made, other, strict=True)]
                    row["songs_apart_mm"] = float(np.mean(pairs))
                if control == "variety" and len(seeds) > 1:
                    row["seeds_apart_mm"] = between_seeds(made)["pose_mm"]
                rows.append(row)
            result[control].append({"value": value} | _mean_where_measured(rows))
    return result


def _mean_where_measured(rows: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """The mean of every measure over the rows that have it."""
    keys = dict.fromkeys(key for row in rows for key in row)
    return {key: float(np.mean([row[key] for row in rows if key in row])) for key in keys}


def _measure(dance: ControlledDance, usual: np.ndarray, made: np.ndarray, block: int) -> dict[str, float]:
    """A dance beside the one at the defaults, both (T, 22, 3) metres, and beside the truth where there is one.

    pose_moved_mm and root_moved_mm: mean distance from the usual dance, of joints relative to the root and of the
    root. slow_ratio and quick_ratio: energy under 1.5 Hz and over 3 Hz over the usual dance's. bed_forward: beat echo
    degree, how often beats of the reactor follow the leader's. facing_deg: between the two headings, 180 is face to
    face. Against the truth: mpjpe_mm, root_error_mm, acceleration_ratio, skate_ratio, contact_ratio, overlap_points
    (percentage points of overlapping frames) and, in a dance of more than one block, seams_ratio (`seam_ratio`).
    """
    leader, truth = dance.leader, dance.reactor
    moved = between_seeds([usual, made])
    slow, quick = (
        float(now / then)
        for now, then in zip(
            band_power(made, (SLOW_HZ, QUICK_HZ)), band_power(usual, (SLOW_HZ, QUICK_HZ)), strict=True
        )
    )
    row = {
        "pose_moved_mm": moved["pose_mm"],
        "root_moved_mm": moved["place_mm"],
        "slow_ratio": slow,
        "quick_ratio": quick,
        "distance_m": float(np.median(root_distance(leader, made))),
        "facing_deg": float(facing(leader, made).mean()),
        "bed_forward": beat_alignment(motion_beats(leader), motion_beats(made)),
    }
    if truth is None:
        return row
    feet, true_feet = foot_skating(made), foot_skating(truth)
    overlap, true_overlap = (penetration(leader, motion)["ipr_capsules"] for motion in (made, truth))
    if len(seams := boundaries(len(made), block)):
        row["seams_ratio"] = seam_ratio([seam_sample(truth, made, seams)])["ratio"]
    return row | {
        "mpjpe_mm": mpjpe(truth, made),
        "root_error_mm": root_error(leader, truth, made),
        "acceleration_ratio": joint_acceleration(made) / joint_acceleration(truth),
        "skate_ratio": feet["skate_share"] / true_feet["skate_share"]
        if true_feet["skate_share"]
        else float("nan"),
        "contact_ratio": feet["contact_share"] / true_feet["contact_share"],
        "overlap_points": (overlap - true_overlap) * 100,
    }
