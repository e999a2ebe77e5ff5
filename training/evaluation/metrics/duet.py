"""All measures of one reactor beside its leader and the true reactor, as one flat table row; and those of sets of
clips.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from training.evaluation.metrics.beats import bas, bed, music_beats
from training.evaluation.metrics.contact import foot_skating, physical_foot_contact
from training.evaluation.metrics.distance import (
    cross_distances,
    facing,
    hand_distance,
    hands_held,
    root_distance,
    wasserstein,
)
from training.evaluation.metrics.errors import (
    bone_variation,
    mpjpe,
    mpjve,
    root_error,
    root_error_by_distance,
)
from training.evaluation.metrics.frechet import Interval, clips, div, fid, fid_of_others
from training.evaluation.metrics.geometric import geometric_features
from training.evaluation.metrics.kinetic import kinetic_features
from training.evaluation.metrics.modes import Mode
from training.evaluation.metrics.penetration import penetration
from training.evaluation.metrics.repetition import MIN_FRAMES, repetition
from training.evaluation.metrics.speed import band_decibels, joint_acceleration, joint_speed

CLIP_FRAMES, HOP_FRAMES = 120, 60  # of the clips of FID and Div: 4 s, overlapping by half


def duet_metrics(
    leader: np.ndarray, truth: np.ndarray, made: np.ndarray, music: np.ndarray | None = None
) -> dict[str, float]:
    """Every measure of one generated reactor `made` against the true one, all (T, 22, 3) metres, y up,
    30 fps.

    music: (T, 54) features for BAS; bas_low and bas_high are its 95 % interval over the beats. Names end in
    their unit; `_ratio` is generated over true, `_w1` a Wasserstein distance to the true distribution over
    frames. PFC depends on T.
    """
    feet, echo, real_echo = foot_skating(made), bed(leader, made), bed(leader, truth)
    row = {
        "mpjpe_mm": mpjpe(truth, made),
        "mpjve_mm": mpjve(truth, made),
        "root_error_mm": root_error(leader, truth, made),
        **{
            f"root_error_mm {name}": value
            for name, value in root_error_by_distance(leader, truth, made).items()
        },
        "speed_ratio": joint_speed(made) / joint_speed(truth),
        "acceleration_ratio": joint_acceleration(made) / joint_acceleration(truth),
        **{f"energy_db {band}": value for band, value in band_decibels(truth, made).items()},
        "distance_ratio": float(
            np.median(root_distance(leader, made)) / np.median(root_distance(leader, truth))
        ),
        "distance_w1_m": wasserstein(root_distance(leader, truth), root_distance(leader, made)),
        "hands_w1_m": wasserstein(hand_distance(leader, truth), hand_distance(leader, made)),
        "hands_held": hands_held(leader, made),
        "facing_w1_deg": wasserstein(facing(leader, truth), facing(leader, made)),
        **feet,
        "pfc": physical_foot_contact(made),
        "bed_forward": echo["forward"],
        "bed_forward_chance": echo["forward_chance"],
        "bed_backward": echo["backward"],
        "bed_backward_chance": echo["backward_chance"],
        "beats_ratio": echo["reactor_beats"] / max(real_echo["reactor_beats"], 1.0),
        **penetration(leader, made),
        "bone_variation": bone_variation(made),
    }
    if len(made) >= MIN_FRAMES:
        row |= repetition(made)
    if music is not None:
        aligned = bas(music_beats(music), made)
        row |= {
            "bas": aligned["value"],
            "bas_chance": aligned["chance"],
            "bas_low": aligned["low"],
            "bas_high": aligned["high"],
        }
    return row


def _clips(motion: np.ndarray) -> list[np.ndarray]:
    return clips(motion, CLIP_FRAMES, HOP_FRAMES)


def _features(couples: Sequence[tuple[np.ndarray, np.ndarray]], mode: Mode) -> dict[str, np.ndarray]:
    """Feature vectors of all clips of all couples (leader, reactor), one row per clip."""
    kinetic, geometric, cross = [], [], []
    for leader, reactor in couples:
        for lead, react in zip(_clips(leader), _clips(reactor), strict=True):
            kinetic.append(kinetic_features(react, mode))
            geometric.append(geometric_features(react, mode))
            cross.append(cross_distances(lead, react))
    return {"k": np.array(kinetic), "g": np.array(geometric), "cd": np.array(cross)}


def set_metrics(
    truth: Sequence[tuple[np.ndarray, np.ndarray]],
    made: Sequence[tuple[np.ndarray, np.ndarray]],
    mode: Mode,
    resamples: int = 100,
) -> dict[str, Interval]:
    """FID and Div of couples (leader, reactor), (T, 22, 3) metres each, against the true couples: fid_k, fid_g,
    fid_cd, div_k, div_g, div_cd of kinetic (k), geometric (g) and cross-distance (cd) features of clips of
    `CLIP_FRAMES`, one every `HOP_FRAMES`.

    `mode` says how k and g are computed (see `modes`); cd is the same in both.
    """
    real, fake = _features(truth, mode), _features(made, mode)
    result = {f"fid_{name}": fid(real[name], fake[name], mode, resamples) for name in real}
    return result | {f"div_{name}": div(real[name], fake[name], mode, resamples) for name in real}


def fid_of_other_dances(
    truth: Sequence[tuple[np.ndarray, np.ndarray]], others: Sequence[tuple[np.ndarray, np.ndarray]]
) -> dict[str, Interval]:
    """fid_k, fid_g and fid_cd, `corrected`, between true couples (leader, reactor), (T, 22, 3) metres each, and other
    true couples, see `fid_of_others`: what to read the FID of a generated reactor against.
    """
    real, other = (_features(couples, "corrected") for couples in (truth, others))
    return {f"fid_{name}": fid_of_others(real[name], other[name]) for name in real}


def clip_count(motions: Sequence[np.ndarray]) -> int:
    """How many clips `set_metrics` makes of the motions."""
    return sum(len(_clips(motion)) for motion in motions)
