"""Evaluates a model on held-out duets: generated reactors beside the truth and baselines.

A model is a function (`ReactorGenerator`), so a checkpoint under PyTorch, exported graphs under onnxruntime
and anything else are measured by the same code. `evaluate` returns plain numbers;
`training.evaluation.report.report` writes them down.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from training.data.duet import FPS, Duet, Solo
from training.evaluation.baselines import baselines
from training.evaluation.controls import measure_controls
from training.evaluation.guidance import measure_guidance
from training.evaluation.long_dance import measure_long_dance
from training.evaluation.metrics.duet import CLIP_FRAMES, HOP_FRAMES, clip_count
from training.evaluation.out_of_distribution import OutOfDistributionDance, measure_out_of_distribution
from training.evaluation.probes import measure_beat_following, measure_responses, measure_seams
from training.evaluation.protocol import (
    COARSE_ALONE,
    GENERATED,
    TRUTH,
    ControlledDance,
    HeldOutDuet,
    Motions,
    ReactorGenerator,
    Settings,
    Solver,
    fit_length,
)
from training.evaluation.role_swap import measure_role_swap
from training.evaluation.rows import generate_motions, measure_other_dances, measure_row, measure_two_sample

Log = Callable[[str], None]


@dataclass(frozen=True)
class Evaluation:
    """Numbers for a report, as plain JSON values, and the motions they were taken from."""

    numbers: dict[str, Any]
    motions: dict[str, Motions] = field(repr=False)
    """By row; also the first seed's dances decoded without the fine layer, which are drawn, not measured."""
    swapped: Motions = field(default_factory=dict, repr=False)
    """Leaders (T, 22, 3) that were generated for the held-out reactors, one per seed."""
    out_of_distribution: list[OutOfDistributionDance] = field(default_factory=list, repr=False)


def evaluate(
    generate: ReactorGenerator,
    held_out: Sequence[HeldOutDuet],
    train: Sequence[Duet],
    block: int,
    settings: Settings | None = None,
    given: Mapping[str, Motions] | None = None,
    solvers: Mapping[str, Solver] | None = None,
    out_of_distribution: Sequence[Solo] = (),
    controlled: Sequence[Solo] = (),
    control_defaults: Mapping[str, float] | None = None,
    guided_at_every_step: ReactorGenerator | None = None,
    log: Log = lambda _: None,
) -> Evaluation:
    """Every measure in one run.

    train: duets that the baselines learn from. block: frames of the blocks that the model generates, at whose
    boundaries seams are measured. given: further rows whose motions exist already, such as
    reconstructions. solvers: each gives a row of its name, the generated motions on a skeleton of constant bone
    lengths; the last is what is drawn and exported, and controls are measured on it. out_of_distribution: leaders of
    other dances, without a partner. controlled: further leaders beside whom controls are moved.
    control_defaults: the model's weight of every control, needed where the settings ask for controls.
    guided_at_every_step: the model with the paper's form of guidance, for the settings' grid.
    Raises ValueError without a held-out duet, where the held-out ones are too short for a FID, and without a duet to
    learn from.
    """
    settings = settings or Settings()
    _check_duets(held_out, train)
    drawn = list(solvers.values())[-1] if solvers else None
    log("generating")
    generated, seconds = generate_motions(generate, held_out, settings.seeds)
    rows = _rows(held_out, train, dict(given or {}) | {GENERATED: generated}, solvers or {}, log)

    numbers: dict[str, Any] = {
        "trials": {i.duet.name: len(i.duet) for i in held_out},
        "beats_unknown": list(settings.beats_unknown),
        "seeds": list(settings.seeds),
        "clips": {
            "frames": CLIP_FRAMES,
            "hop": HOP_FRAMES,
            "count": clip_count([i.duet.reactor for i in held_out]),
        },
        "rows": {},
    }
    for name, motions in rows.items():
        log(f"measuring {name}")
        numbers["rows"][name] = measure_row(held_out, motions)
    numbers["other_dances"] = measure_other_dances(held_out, train)
    frames = float(np.mean([len(i.duet) for i in held_out]))
    numbers["seconds"] = {"mean": float(np.mean(seconds)), "frames": frames}
    numbers |= _probes(generate, held_out, rows, block, settings, log)
    if settings.controls:
        log("controls")
        assert control_defaults is not None, "controls need the model's defaults"
        numbers["controls"] = measure_controls(
            generate,
            _controlled(held_out, out_of_distribution, controlled, settings),
            control_defaults,
            settings.seeds,
            block,
            drawn,
        )
    if settings.guidance_grid and guided_at_every_step:
        log("guidance at every step")
        numbers["guidance"] = measure_guidance(guided_at_every_step, held_out, settings)
    log("a long dance")
    numbers["long_dance"] = measure_long_dance(generate, held_out, settings.seeds)
    log("role swap")
    numbers["role_swap"], swapped = measure_role_swap(generate, held_out, train, settings.seeds)

    dances: list[OutOfDistributionDance] = []
    if out_of_distribution:
        log("out-of-distribution leaders")
        numbers["out_of_distribution"], dances = measure_out_of_distribution(
            generate, out_of_distribution, held_out, settings, drawn
        )
    seed = settings.seeds[0]
    coarse = {i.duet.name: [generate(i.duet.leader, i.music, seed, guidance=(0.0, -1.0))] for i in held_out}
    return Evaluation(numbers, {**rows, COARSE_ALONE: coarse}, swapped, dances)


def _check_duets(held_out: Sequence[HeldOutDuet], train: Sequence[Duet]) -> None:
    """Raises ValueError where there is too little to measure on or to learn from, see `evaluate`."""
    if not held_out:
        raise ValueError("no held-out duet to evaluate on")
    if (count := clip_count([i.duet.reactor for i in held_out])) < 2:
        raise ValueError(
            f"the held-out duets have {count} clips of {CLIP_FRAMES / FPS:g} s, one every {HOP_FRAMES / FPS:g} s, and "
            "a FID needs two: hold out more or longer duets"
        )
    if not train:
        raise ValueError(
            "all duets are held out, and baselines learn from the others: name fewer with --val and --test"
        )


def _rows(
    held_out: Sequence[HeldOutDuet],
    train: Sequence[Duet],
    made: Mapping[str, Motions],
    solvers: Mapping[str, Solver],
    log: Log,
) -> dict[str, Motions]:
    """Motions of every row of the report: the truth, those that were made, the generated ones as each solver draws
    them, and the baselines.
    """
    rows: dict[str, Motions] = {TRUTH: {i.duet.name: [i.duet.reactor] for i in held_out}, **made}
    for name, solve in solvers.items():
        log(name)
        rows[name] = {
            i.duet.name: solve(made[GENERATED][i.duet.name], i.duet.leader, i.music) for i in held_out
        }
    log("baselines")
    return rows | baselines(held_out, train)


def _probes(
    generate: ReactorGenerator,
    held_out: Sequence[HeldOutDuet],
    rows: Mapping[str, Motions],
    block: int,
    settings: Settings,
    log: Log,
) -> dict[str, Any]:
    """Block boundaries, responses to conditions and, where the settings ask for them, the longer experiments."""
    generated = rows[GENERATED]
    log("block boundaries")
    numbers: dict[str, Any] = {"seams": measure_seams(generate, held_out, generated, block, settings)}
    log("responses to conditions")
    numbers["responses"] = measure_responses(generate, held_out, generated, settings)
    if settings.two_sample:
        log("two-sample test")
        numbers["two_sample"] = measure_two_sample(held_out, rows)
    if settings.phase_seeds:
        log("beat following")
        numbers["beat_following"] = measure_beat_following(generate, held_out, settings.phase_seeds)
    return numbers


def _controlled(
    held_out: Sequence[HeldOutDuet], leaders: Sequence[Solo], further: Sequence[Solo], settings: Settings
) -> list[ControlledDance]:
    """The held-out duets, the leaders that the settings name and further ones; the other song is that of the next
    duet, none where there is one duet.
    """
    songs = [item.music for item in held_out]

    def dance(index: int, leader: np.ndarray, reactor: np.ndarray | None) -> ControlledDance:
        next_song = songs[(index + 1) % len(songs)] if len(songs) > 1 else None
        music, other = (
            None if song is None else fit_length(song, len(leader))
            for song in (songs[index % len(songs)], next_song)
        )
        return ControlledDance(leader, music, other, reactor)

    named = [leader for leader in leaders if leader.name in settings.controlled_leaders]
    if missing := set(settings.controlled_leaders) - {leader.name for leader in named}:
        raise ValueError(f"no out-of-distribution leader is called {', '.join(sorted(missing))}")
    return [
        *(dance(i, item.duet.leader, item.duet.reactor) for i, item in enumerate(held_out)),
        *(dance(i, leader.motion, None) for i, leader in enumerate([*named, *further])),
    ]
