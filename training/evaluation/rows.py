"""Rows of the main table: motions of one method on all held-out duets, measured against the truth."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from training.data.duet import Duet
from training.evaluation.metrics.duet import clip_count, duet_metrics, fid_of_other_dances, set_metrics
from training.evaluation.metrics.modes import MODES
from training.evaluation.metrics.twosample import truth_against_truth, two_sample_accuracy
from training.evaluation.protocol import TRUTH, HeldOutDuet, Motions, ReactorGenerator

RESAMPLES = 1000  # of the bootstrap over seeds


def generate_motions(
    generate: ReactorGenerator, held_out: Sequence[HeldOutDuet], seeds: Sequence[int]
) -> tuple[Motions, list[float]]:
    """A reactor for every held-out duet and seed, and the seconds that each took."""
    motions: Motions = {}
    seconds: list[float] = []
    for item in held_out:
        motions[item.duet.name] = []
        for seed in seeds:
            started = time.perf_counter()
            motions[item.duet.name].append(generate(item.duet.leader, item.music, seed))
            seconds.append(time.perf_counter() - started)
    return motions, seconds


def measure_row(held_out: Sequence[HeldOutDuet], motions: Motions) -> dict[str, Any]:
    """Every measure of `duet_metrics` and `set_metrics` of one row.

    Returns `trials`: by held-out duet every seed's measures and their mean; `per_seed`: each seed's mean over
    the duets; `mean`: over both; `interval`: 95 % bootstrap limits, over seeds, and for FID and Div, which
    exist only for all clips of a seed together, over clips.
    """
    by_duet = {item.duet.name: _measure_duet(item, motions[item.duet.name]) for item in held_out}
    count = len(next(iter(by_duet.values()))["seeds"])
    # A duet that is too short for the measures of repetition lacks them.
    keys = dict.fromkeys(key for row in by_duet.values() for key in row["mean"])
    per_seed = [
        {key: _known_mean([row["seeds"][i].get(key, np.nan) for row in by_duet.values()]) for key in keys}
        for i in range(count)
    ]
    sets = [_measure_set(held_out, motions, i) for i in range(count)]
    numbers = [a | {k: v[0] for k, v in b.items()} for a, b in zip(per_seed, sets, strict=True)]
    mean = {key: float(np.mean([n[key] for n in numbers])) for key in numbers[0]}
    interval = {key: bootstrap_interval([n[key] for n in numbers]) for key in numbers[0]}
    for key in sets[0]:  # clips, not seeds, are what FID and Div depend on most
        interval[key] = (float(np.mean([s[key][1] for s in sets])), float(np.mean([s[key][2] for s in sets])))
    return {"mean": mean, "interval": interval, "per_seed": numbers, "trials": by_duet}


def _measure_duet(item: HeldOutDuet, motions: Sequence[np.ndarray]) -> dict[str, Any]:
    """Measures of each motion and their mean; a motion may be shorter than the duet."""
    duet = item.duet
    seeds = [
        duet_metrics(
            duet.leader[: len(motion)],
            duet.reactor[: len(motion)],
            motion,
            None if item.music is None else item.music[: len(motion)],
        )
        for motion in motions
    ]
    mean = {key: float(np.mean([s[key] for s in seeds])) for key in seeds[0]}
    return {"mean": mean, "seeds": seeds}


def _measure_set(
    held_out: Sequence[HeldOutDuet], motions: Motions, seed: int
) -> dict[str, tuple[float, float, float]]:
    """FID and Div of one seed (its index) of all duets, `NAME mode`: value, lower and upper limit."""
    made = [(i.duet.leader[: len(motions[i.duet.name][seed])], motions[i.duet.name][seed]) for i in held_out]
    true = [(leader, i.duet.reactor[: len(leader)]) for i, (leader, _) in zip(held_out, made, strict=True)]
    result: dict[str, tuple[float, float, float]] = {}
    for mode in MODES:
        for name, value in set_metrics(true, made, mode).items():
            if not (name.endswith("_cd") and mode == "paper"):  # the same in both modes
                label = name if name.endswith("_cd") else f"{name} {mode}"
                result[label] = (value.value, value.low, value.high)
    return result


def measure_other_dances(held_out: Sequence[HeldOutDuet], train: Sequence[Duet]) -> dict[str, list[float]]:
    """FID of the training dances as captured against the held-out ones: value, lower and upper limit by its name.
    Empty where they have fewer than two clips.
    """
    if clip_count([duet.reactor for duet in train]) < 2:
        return {}
    true = [(item.duet.leader, item.duet.reactor) for item in held_out]
    others = fid_of_other_dances(true, [(duet.leader, duet.reactor) for duet in train])
    return {name: [value.value, value.low, value.high] for name, value in others.items()}


def bootstrap_interval(values: Sequence[float]) -> tuple[float, float]:
    """95 % bootstrap interval of the mean over seeds."""
    sample = np.array(values)
    if len(sample) < 2:
        return float(sample.mean()), float(sample.mean())
    random = np.random.default_rng(0)
    means = sample[random.integers(len(sample), size=(RESAMPLES, len(sample)))].mean(axis=1)
    low, high = np.percentile(means, [2.5, 97.5])
    return float(low), float(high)


def _known_mean(values: Sequence[float]) -> float:
    """Mean of the values that are numbers: a duet may have no frame in one bin of distance."""
    known = [value for value in values if np.isfinite(value)]
    return float(np.mean(known)) if known else float("nan")


def measure_two_sample(held_out: Sequence[HeldOutDuet], rows: Mapping[str, Motions]) -> dict[str, float]:
    """Accuracy of the classifier two-sample test ("told from the truth") of the first seed of each row; for the
    truth, between two halves of itself.
    """
    result: dict[str, float] = {}
    for name, motions in rows.items():
        made = [(i.duet.leader[: len(m)], m) for i in held_out for m in motions[i.duet.name][:1]]
        true = [
            (leader, i.duet.reactor[: len(leader)]) for i, (leader, _) in zip(held_out, made, strict=True)
        ]
        result[name] = truth_against_truth(true) if name == TRUTH else two_sample_accuracy(true, made)
    return result
