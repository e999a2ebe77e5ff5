"""Role swap (paper 6.10): the reactor leads, and the model dances the leader's part."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from training.data.augment import swap_roles
from training.data.duet import Duet
from training.evaluation.baselines import nearest_neighbour
from training.evaluation.metrics import mean_report, quick_report
from training.evaluation.protocol import Dancer, Motions, Trial

LEADER = 1.0  # the role input of a model that dances the leader's part


def swapped_trials(trials: Sequence[Trial]) -> list[Trial]:
    """The same dances and music with the reactor in the leader's place; what is true is then the leader."""
    return [replace(trial, duet=swap_roles(trial.duet)) for trial in trials]


def _rows(trials: Sequence[Trial], motions: Motions) -> dict[str, Any]:
    by_trial = {}
    for trial in trials:
        duet = trial.duet
        seeds = [quick_report(duet.leader, duet.reactor, made) for made in motions[duet.name]]
        by_trial[duet.name] = {"mean": mean_report(seeds), "seeds": seeds}
    return {"mean": mean_report([row["mean"] for row in by_trial.values()]), "trials": by_trial}


def measure_role_swap(
    dancer: Dancer, trials: Sequence[Trial], train: Sequence[Duet], seeds: Sequence[int]
) -> tuple[dict[str, Any], Motions]:
    """MPJPE, root error, speed and distance ratio of generated leaders against the true ones; and the dances.

    Beside them the nearest neighbour among the training duets, swapped too. Each has its mean over trials, and
    per trial the mean and every seed. The motions (T, 22, 3) are the leaders that were generated.
    """
    swapped = swapped_trials(trials)
    made = {
        t.duet.name: [dancer(t.duet.leader, t.music, seed, role=LEADER) for seed in seeds] for t in swapped
    }
    library = [swap_roles(duet) for duet in train]
    copied = {t.duet.name: [nearest_neighbour(library, t.duet.leader)] for t in swapped}
    return {"generated": _rows(swapped, made), "nearest neighbour": _rows(swapped, copied)}, made
