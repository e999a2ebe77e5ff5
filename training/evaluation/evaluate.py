"""Evaluates a dancer on held-out duets: generated dances beside the truth and beside what needs no model.

A dancer is a function, so a checkpoint under PyTorch, exported graphs under onnxruntime and anything else
are measured by the same code. `evaluate` returns plain numbers; `training.evaluation.report.report` writes them down.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from training.data.duet import Duet, Solo
from training.evaluation.baselines import mean_pose, median_distance, mirrored_leader, nearest_neighbour
from training.evaluation.long_dance import measure_long_dance
from training.evaluation.metrics.duet import CLIP, HOP, clip_count, duet_metrics, set_metrics
from training.evaluation.metrics.modes import MODES
from training.evaluation.metrics.twosample import truth_against_truth, two_sample_accuracy
from training.evaluation.out_of_distribution import Elsewhere, measure_elsewhere
from training.evaluation.probes import (
    measure_beat_following,
    measure_guidance,
    measure_responses,
    measure_seams,
)
from training.evaluation.protocol import Dancer, Motions, Settings, Solver, Trial
from training.evaluation.report.spectra import COARSE
from training.evaluation.role_swap import measure_role_swap
from training.evaluation.separability import separability

Log = Callable[[str], None]


@dataclass(frozen=True)
class Evaluation:
    """Numbers for a report, as plain JSON values, and the motions they were taken from."""

    numbers: dict[str, Any]
    motions: dict[str, Motions] = field(repr=False)
    """By row; also the first seed's dances decoded without the fine layer, which are drawn, not measured."""
    swapped: Motions = field(default_factory=dict, repr=False)
    """Leaders that were generated for the trials' reactors, one per seed."""
    elsewhere: list[Elsewhere] = field(default_factory=list, repr=False)


def generate(dancer: Dancer, trials: Sequence[Trial], seeds: Sequence[int]) -> tuple[Motions, list[float]]:
    """A motion for every trial and seed, and the seconds that each took."""
    motions: Motions = {}
    seconds: list[float] = []
    for trial in trials:
        motions[trial.duet.name] = []
        for seed in seeds:
            started = time.perf_counter()
            motions[trial.duet.name].append(dancer(trial.duet.leader, trial.music, seed))
            seconds.append(time.perf_counter() - started)
    return motions, seconds


def _interval(values: Sequence[float], resamples: int = 1000) -> tuple[float, float]:
    """95 % bootstrap interval of the mean over seeds."""
    sample = np.array(values)
    if len(sample) < 2:
        return float(sample.mean()), float(sample.mean())
    random = np.random.default_rng(0)
    means = sample[random.integers(len(sample), size=(resamples, len(sample)))].mean(axis=1)
    low, high = np.percentile(means, [2.5, 97.5])
    return float(low), float(high)


def _known_mean(values: Sequence[float]) -> float:
    """Mean of the values that are numbers: a trial may have no frame in one bin of distance."""
    known = [value for value in values if np.isfinite(value)]
    return float(np.mean(known)) if known else float("nan")


def measure_row(trials: Sequence[Trial], motions: Motions) -> dict[str, Any]:
    """One row of the table: every measure per trial and seed, the mean over trials of each seed (`per_seed`),
    and the mean over both.

    Also FID and Div of the clips of all trials, for each seed, in both modes.
    """
    by_trial: dict[str, Any] = {}
    for trial in trials:
        duet = trial.duet
        seeds = [
            duet_metrics(
                duet.leader[: len(m)],
                duet.reactor[: len(m)],
                m,
                None if trial.music is None else trial.music[: len(m)],
            )
            for m in motions[duet.name]
        ]
        mean = {key: float(np.mean([s[key] for s in seeds])) for key in seeds[0]}
        by_trial[duet.name] = {"mean": mean, "seeds": seeds}
    first = next(iter(by_trial.values()))
    count = len(first["seeds"])
    per_seed = [
        {k: _known_mean([t["seeds"][i][k] for t in by_trial.values()]) for k in first["mean"]}
        for i in range(count)
    ]
    sets = [_set_row(trials, motions, i) for i in range(count)]
    numbers = [a | {k: v[0] for k, v in b.items()} for a, b in zip(per_seed, sets, strict=True)]
    mean = {key: float(np.mean([n[key] for n in numbers])) for key in numbers[0]}
    interval = {key: _interval([n[key] for n in numbers]) for key in numbers[0]}
    for key in sets[0]:  # clips, not seeds, are what FID and Div depend on most
        interval[key] = (float(np.mean([s[key][1] for s in sets])), float(np.mean([s[key][2] for s in sets])))
    return {"mean": mean, "interval": interval, "per_seed": numbers, "trials": by_trial}


def _set_row(trials: Sequence[Trial], motions: Motions, seed: int) -> dict[str, tuple[float, float, float]]:
    """FID and Div of one seed of all trials, `NAME mode`: value and interval."""
    made = [(t.duet.leader[: len(motions[t.duet.name][seed])], motions[t.duet.name][seed]) for t in trials]
    true = [(lead, t.duet.reactor[: len(lead)]) for t, (lead, _) in zip(trials, made, strict=True)]
    result: dict[str, tuple[float, float, float]] = {}
    for mode in MODES:
        for name, value in set_metrics(true, made, mode).items():
            if not (name.endswith("_cd") and mode == "paper"):  # the same in both modes
                label = name if name.endswith("_cd") else f"{name} {mode}"
                result[label] = (value.value, value.low, value.high)
    return result


def baselines(trials: Sequence[Trial], train: Sequence[Duet]) -> dict[str, Motions]:
    """Rows that need no model: nearest neighbour, mean pose and mirrored leader, learned from the training
    duets.
    """
    distance = median_distance(train)
    return {
        "nearest neighbour": {t.duet.name: [nearest_neighbour(train, t.duet.leader)] for t in trials},
        "mean pose": {t.duet.name: [mean_pose(train, t.duet.leader)] for t in trials},
        "mirrored leader": {t.duet.name: [mirrored_leader(t.duet.leader, distance)] for t in trials},
    }


def measure_two_sample(trials: Sequence[Trial], rows: Mapping[str, Motions]) -> dict[str, float]:
    """Accuracy with which the first seed of each row is told from the truth; for the truth, from its own
    other half.
    """
    result: dict[str, float] = {}
    for name, motions in rows.items():
        made = [(t.duet.leader[: len(m)], m) for t in trials for m in motions[t.duet.name][:1]]
        true = [(lead, t.duet.reactor[: len(lead)]) for t, (lead, _) in zip(trials, made, strict=True)]
        result[name] = truth_against_truth(true) if name == "truth" else two_sample_accuracy(true, made)
    return result


def evaluate(
    dancer: Dancer,
    trials: Sequence[Trial],
    train: Sequence[Duet],
    settings: Settings | None = None,
    given: Mapping[str, Motions] | None = None,
    solvers: Mapping[str, Solver] | None = None,
    elsewhere: Sequence[Solo] = (),
    log: Log = lambda _: None,
) -> Evaluation:
    """Everything in one run.

    given: further rows whose motions exist already, such as reconstructions. solvers: each puts a motion
    on a skeleton of constant bone lengths beside its leader, for a row of its name: what is drawn and exported.
    elsewhere: leaders of other dances, without a partner.
    """
    settings = settings or Settings()
    if not trials:
        raise ValueError("no trial to evaluate on")
    log("generating")
    generated, seconds = generate(dancer, trials, settings.seeds)
    rows: dict[str, Motions] = {"truth": {t.duet.name: [t.duet.reactor] for t in trials}}
    rows |= dict(given or {}) | {"generated": generated}
    for row, solve in (solvers or {}).items():
        log(row)
        rows[row] = {
            t.duet.name: [solve(motion, t.duet.leader) for motion in generated[t.duet.name]] for t in trials
        }
    log("baselines")
    rows |= baselines(trials, train)
    numbers: dict[str, Any] = {
        "trials": {t.duet.name: len(t.duet) for t in trials},
        "seeds": list(settings.seeds),
        "clips": {"frames": CLIP, "hop": HOP, "count": clip_count([t.duet.reactor for t in trials])},
        "rows": {},
    }
    for name, motions in rows.items():
        log(f"measuring {name}")
        numbers["rows"][name] = measure_row(trials, motions)
    numbers["seconds"] = {
        "mean": float(np.mean(seconds)),
        "frames": float(np.mean([len(t.duet) for t in trials])),
    }
    log("seams")
    numbers["seams"] = measure_seams(dancer, trials, generated, settings)
    log("responses")
    numbers["responses"] = measure_responses(dancer, trials, generated, settings)
    if settings.two_sample:
        log("two-sample test")
        numbers["two_sample"] = measure_two_sample(trials, rows)
    if settings.phase_seeds:
        log("beat following")
        numbers["beat_following"] = measure_beat_following(dancer, trials, settings.phase_seeds)
    if settings.guidance_grid:
        log("guidance")
        numbers["guidance"] = measure_guidance(dancer, trials, settings)
        numbers["separability"] = separability(numbers["guidance"])
    log("a long dance")
    numbers["long_dance"] = measure_long_dance(dancer, trials, settings.seeds)
    log("role swap")
    numbers["role_swap"], swapped = measure_role_swap(dancer, trials, train, settings.seeds)
    strangers: list[Elsewhere] = []
    if elsewhere:
        log("leaders from elsewhere")
        solve = next(iter((solvers or {}).values()), None)
        numbers["elsewhere"], strangers = measure_elsewhere(
            dancer, elsewhere, trials, settings.seeds[0], solve
        )
    coarse = {
        t.duet.name: [dancer(t.duet.leader, t.music, settings.seeds[0], coarse_only=True)] for t in trials
    }
    return Evaluation(numbers, {**rows, COARSE: coarse}, swapped, strangers)
