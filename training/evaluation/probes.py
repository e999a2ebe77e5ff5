"""Experiments on a dancer: what happens at block boundaries, when a condition changes, and when guidance
does.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from training.evaluation.metrics import mean_report, quick_report
from training.evaluation.metrics.errors import root_error
from training.evaluation.metrics.response import (
    beat_phase,
    between_seeds,
    half_beat_later,
    relative_change,
    shift_test,
)
from training.evaluation.metrics.seams import boundaries, paper_jitter, seam_ratio, seam_sample
from training.evaluation.metrics.speed import band_power
from training.evaluation.protocol import Dancer, Motions, Settings, Trial, fit_length

# Hz: what guidance of the coarse layer should move, and what that of the fine layer should.
SLOW, QUICK = (0.0, 1.5), (3.0, 15.0)


def measure_seams(
    dancer: Dancer, trials: Sequence[Trial], whole: Motions, settings: Settings
) -> dict[str, float]:
    """Seams over all trials, seeds and starts; the paper's jitter beside the truth's at the same frames."""
    samples, jitter, true_jitter = [], [], []
    for trial in trials:
        for start in settings.seam_starts:
            leader, truth = trial.duet.leader[start:], trial.duet.reactor[start:]
            music = None if trial.music is None else trial.music[start:]
            seams = boundaries(len(leader), settings.seam_spacing)
            if len(seams) == 0:
                continue
            for index, seed in enumerate(settings.seeds):
                made = whole[trial.duet.name][index] if start == 0 else dancer(leader, music, seed)
                samples.append(seam_sample(truth, made, seams))
                jitter.append(paper_jitter(made, seams))
                true_jitter.append(paper_jitter(truth, seams))
    return {
        **seam_ratio(samples),
        "paper_jitter_mm": float(np.mean(jitter)) if jitter else float("nan"),
        "paper_jitter_truth_mm": float(np.mean(true_jitter)) if jitter else float("nan"),
    }


def _ratio(over: float, under: float) -> float:
    return over / under if under else float("nan")


def measure_responses(
    dancer: Dancer, trials: Sequence[Trial], whole: Motions, settings: Settings
) -> dict[str, float]:
    """What changes when a condition does, for each change its mean over trials and seeds.

    `change_*` are relative changes of the motion (metrics.response); the others' leader and music come from
    the next trial. root_error_other_leader_mm is the relative-root error with that leader in the condition,
    decoded with the right one.
    """
    seeds = list(enumerate(settings.seeds[: settings.response_seeds]))
    rows: list[dict[str, float]] = []
    for index, trial in enumerate(trials):
        other = trials[(index + 1) % len(trials)]
        leader, frames = trial.duet.leader, len(trial.duet)
        wrong = fit_length(other.duet.leader, frames)
        for number, seed in seeds:
            base = whole[trial.duet.name][number]
            swapped = dancer(leader, trial.music, seed, heard_leader=wrong)
            row = {
                "change_other_leader": relative_change(leader, base, swapped),
                "root_error_mm": root_error(leader, trial.duet.reactor, base),
                "root_error_other_leader_mm": root_error(leader, trial.duet.reactor, swapped),
            }
            if trial.music is not None and other.music is not None:
                song = fit_length(other.music, frames)
                row["change_other_song"] = relative_change(leader, base, dancer(leader, song, seed))
                late = dancer(leader, half_beat_later(trial.music), seed)
                row["change_half_beat"] = relative_change(leader, base, late)
                row["change_no_song"] = relative_change(leader, base, dancer(leader, None, seed))
            rows.append(row)
    result = mean_report(rows)
    result["other_leader_raises_root_error"] = (
        _ratio(result["root_error_other_leader_mm"], result["root_error_mm"]) - 1
    )
    if "change_other_song" in result:
        result["song_over_leader"] = _ratio(result["change_other_song"], result["change_other_leader"])
    apart = [between_seeds(whole[t.duet.name]) for t in trials if len(whole[t.duet.name]) > 1]
    if apart:
        result |= {f"seeds_apart_{k}": value for k, value in mean_report(apart).items()}
    return result


def measure_beat_following(
    dancer: Dancer, trials: Sequence[Trial], seeds: int
) -> dict[str, dict[str, float]]:
    """For each trial with music: do the motion beats move when the music moves by half a beat?"""
    result = {}
    for trial in trials:
        if trial.music is None:
            continue
        late = half_beat_later(trial.music)
        phases = [
            [beat_phase(trial.music, dancer(trial.duet.leader, music, seed)) for seed in range(seeds)]
            for music in (trial.music, late)
        ]
        result[trial.duet.name] = shift_test(phases[0], phases[1])
    return result


def measure_guidance(dancer: Dancer, trials: Sequence[Trial], settings: Settings) -> list[dict[str, float]]:
    """A grid of coarse and fine guidance (the paper's Table 4): errors, liveliness and energy, mean over
    trials and seeds.

    slow_energy and quick_energy are powers of joint velocity under 1.5 Hz and over 3 Hz, (m/s)^2.
    """
    cells = []
    for coarse in settings.guidance_grid:
        for fine in settings.guidance_grid:
            rows = []
            for trial in trials:
                for seed in settings.seeds[: settings.response_seeds]:
                    made = dancer(trial.duet.leader, trial.music, seed, guidance=(coarse, fine))
                    slow, quick = band_power(made, (SLOW, QUICK))
                    energy = {"slow_energy": float(slow), "quick_energy": float(quick)}
                    rows.append(quick_report(trial.duet.leader, trial.duet.reactor, made) | energy)
            cells.append({"coarse": coarse, "fine": fine} | mean_report(rows))
    return cells
