"""Role swap (paper 6.10): the model generates the leader, to a reactor in the leader's place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from training.data.augment import swap_roles
from training.data.duet import Duet
from training.evaluation.baselines import nearest_neighbour
from training.evaluation.metrics import mean_report, quick_report
from training.evaluation.protocol import HeldOutDuet, Motions, ReactorGenerator

LEADER = 1.0  # role input of a model that generates the leader


def swapped_duets(held_out: Sequence[HeldOutDuet]) -> list[HeldOutDuet]:
    """The same duets and music with the two dancers exchanged; the true reactor is then the leader."""
    return [replace(item, duet=swap_roles(item.duet)) for item in held_out]


def _measure(held_out: Sequence[HeldOutDuet], motions: Motions) -> dict[str, Any]:
    """`quick_report` of every motion, its mean by duet, and the mean over duets."""
    by_duet = {}
    for item in held_out:
        duet = item.duet
        seeds = [quick_report(duet.leader, duet.reactor, made) for made in motions[duet.name]]
        by_duet[duet.name] = {"mean": mean_report(seeds), "seeds": seeds}
    return {"mean": mean_report([row["mean"] for row in by_duet.values()]), "trials": by_duet}


def measure_role_swap(
    generate: ReactorGenerator,
    held_out: Sequence[HeldOutDuet],
    train: Sequence[Duet],
    seeds: Sequence[int],
) -> tuple[dict[str, Any], Motions]:
    """`quick_report` of generated leaders against the true ones, and the generated leaders (T, 22, 3) metres.

    Beside them the nearest neighbour among the training duets, swapped too. Each has its mean over the held-out
    duets and, in `trials`, by duet the mean and every seed.
    """
    swapped = swapped_duets(held_out)
    made = {
        i.duet.name: [generate(i.duet.leader, i.music, seed, role=LEADER) for seed in seeds] for i in swapped
    }
    library = [swap_roles(duet) for duet in train]
    nearest = {i.duet.name: [nearest_neighbour(library, i.duet.leader)] for i in swapped}
    return {"generated": _measure(swapped, made), "nearest neighbour": _measure(swapped, nearest)}, made
