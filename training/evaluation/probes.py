"""Experiments on a model: what happens at block boundaries, when a condition changes, and when the beat moves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from training.evaluation.metrics import mean_report
from training.evaluation.metrics.errors import root_error
from training.evaluation.metrics.response import (
    beat_phase,
    between_seeds,
    half_beat_later,
    relative_change,
    shift_test,
)
from training.evaluation.metrics.seams import boundaries, paper_jitter, seam_ratio, seam_sample
from training.evaluation.protocol import HeldOutDuet, Motions, ReactorGenerator, Settings, fit_length


def measure_seams(
    generate: ReactorGenerator,
    held_out: Sequence[HeldOutDuet],
    generated: Motions,
    block: int,
    settings: Settings,
) -> dict[str, float]:
    """Boundary jitter ratio (`seam_ratio`) over all duets, seeds and starts, and the paper's boundary jitter
    beside the truth's at the same frames, mm per frame^2.

    generated: the reactors of the whole duets, one per seed of the settings. block: frames of the
    model's blocks. Where the start is cut off, which moves the boundaries, the model generates again.
    """
    samples, jitter, true_jitter = [], [], []
    for item in held_out:
        for start in settings.seam_starts:
            leader, truth = item.duet.leader[start:], item.duet.reactor[start:]
            music = None if item.music is None else item.music[start:]
            seams = boundaries(len(leader), block)
            if len(seams) == 0:
                continue
            for index, seed in enumerate(settings.seeds):
                made = generated[item.duet.name][index] if start == 0 else generate(leader, music, seed)
                samples.append(seam_sample(truth, made, seams))
                jitter.append(paper_jitter(made, seams))
                true_jitter.append(paper_jitter(truth, seams))
    return {
        **seam_ratio(samples),
        "paper_jitter_mm": float(np.mean(jitter)) if jitter else float("nan"),
        "paper_jitter_truth_mm": float(np.mean(true_jitter)) if jitter else float("nan"),
    }


def measure_responses(
    generate: ReactorGenerator, held_out: Sequence[HeldOutDuet], generated: Motions, settings: Settings
) -> dict[str, float]:
    """What changes when a condition does, for each change its mean over duets and seeds.

    `change_*` are relative changes of the motion (metrics.response); another leader and another song are those
    of the next duet, so that a single duet has no such numbers. root_error_other_leader_mm is the relative-root error
    with that leader in the condition, decoded with the right one; other_leader_raises_root_error is its rise, 0.2 is
    20 %. song_over_leader is the change by another song over that by another leader. seeds_apart_* as in
    `between_seeds`, mm.
    """
    seeds = list(enumerate(settings.seeds[: settings.response_seeds]))
    rows: list[dict[str, float]] = []
    for index, item in enumerate(held_out):
        other = held_out[(index + 1) % len(held_out)]
        leader, frames = item.duet.leader, len(item.duet)
        for number, seed in seeds:
            base = generated[item.duet.name][number]
            row = {"root_error_mm": root_error(leader, item.duet.reactor, base)}
            if other is not item:
                other_leader = fit_length(other.duet.leader, frames)
                changed = generate(leader, item.music, seed, condition_leader=other_leader)
                row["change_other_leader"] = relative_change(leader, base, changed)
                row["root_error_other_leader_mm"] = root_error(leader, item.duet.reactor, changed)
            if item.music is not None:
                if other is not item and other.music is not None:
                    song = fit_length(other.music, frames)
                    row["change_other_song"] = relative_change(leader, base, generate(leader, song, seed))
                late = generate(leader, half_beat_later(item.music), seed)
                row["change_half_beat"] = relative_change(leader, base, late)
                row["change_no_song"] = relative_change(leader, base, generate(leader, None, seed))
            rows.append(row)
    result = mean_report(rows)
    if "change_other_leader" in result:
        result["other_leader_raises_root_error"] = (
            _ratio(result["root_error_other_leader_mm"], result["root_error_mm"]) - 1
        )
    if "change_other_song" in result:
        result["song_over_leader"] = _ratio(result["change_other_song"], result["change_other_leader"])
    apart = [between_seeds(generated[i.duet.name]) for i in held_out if len(generated[i.duet.name]) > 1]
    if apart:
        result |= {f"seeds_apart_{key}": value for key, value in mean_report(apart).items()}
    return result


def _ratio(over: float, under: float) -> float:
    return over / under if under else float("nan")


def measure_beat_following(
    generate: ReactorGenerator, held_out: Sequence[HeldOutDuet], seeds: int
) -> dict[str, dict[str, float]]:
    """For each duet with music `shift_test`: do the motion beats move when the music moves by half a beat?

    seeds: how many, from 0 on.
    """
    result = {}
    for item in held_out:
        if item.music is None:
            continue
        late = half_beat_later(item.music)
        phases = [
            [beat_phase(item.music, generate(item.duet.leader, music, seed)) for seed in range(seeds)]
            for music in (item.music, late)
        ]
        result[item.duet.name] = shift_test(phases[0], phases[1])
    return result
