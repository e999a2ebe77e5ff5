"""Classifier-free guidance of the coarse and the fine layer: a grid of both (the paper's Table 4), and how separate the
two are: coarse guidance should change low frequencies only, fine guidance high ones only.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from training.evaluation.metrics import mean_report, quick_report
from training.evaluation.metrics.speed import band_power
from training.evaluation.protocol import HeldOutDuet, ReactorGenerator, Settings

# What guidance of the coarse layer should change, and what that of the fine layer should.
SLOW_HZ, QUICK_HZ = (0.0, 1.5), (3.0, 15.0)
PAPER_GUIDANCE = 1.2  # compared with none

# Which energy of `measure_guidance` a layer's guidance is meant for, and which it should leave alone.
OWN = {"coarse": "slow_energy", "fine": "quick_energy"}
OTHER = {"coarse": "quick_energy", "fine": "slow_energy"}


def measure_guidance(
    generate: ReactorGenerator, held_out: Sequence[HeldOutDuet], settings: Settings
) -> list[dict[str, float]]:
    """`quick_report` and energy for every pair of coarse and fine guidance of the settings' grid, mean over
    duets and seeds.

    slow_energy and quick_energy are powers of joint velocity under 1.5 Hz and over 3 Hz, (m/s)^2.
    """
    cells = []
    for coarse in settings.guidance_grid:
        for fine in settings.guidance_grid:
            rows = []
            for item in held_out:
                for seed in settings.seeds[: settings.response_seeds]:
                    made = generate(item.duet.leader, item.music, seed, guidance=(coarse, fine))
                    slow, quick = band_power(made, (SLOW_HZ, QUICK_HZ))
                    energy = {"slow_energy": float(slow), "quick_energy": float(quick)}
                    rows.append(quick_report(item.duet.leader, item.duet.reactor, made) | energy)
            cells.append({"coarse": coarse, "fine": fine} | mean_report(rows))
    return cells


def separability(cells: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """Relative change of energy when one layer's guidance rises from 0 to 1.2 and the other's stays 0.

    cells: of `measure_guidance`. `LAYER_moves_own` is taken under 1.5 Hz for coarse and over 3 Hz for fine,
    `LAYER_moves_other` at the opposite end; 0.05 is 5 % more energy. Layers whose cells are not in the grid
    are left out.
    """
    by_guidance = {(cell["coarse"], cell["fine"]): cell for cell in cells}
    none = by_guidance.get((0.0, 0.0))
    raised = {
        "coarse": by_guidance.get((PAPER_GUIDANCE, 0.0)),
        "fine": by_guidance.get((0.0, PAPER_GUIDANCE)),
    }
    result: dict[str, float] = {}
    for layer, cell in raised.items():
        if none is not None and cell is not None:
            for name, energy in (("own", OWN[layer]), ("other", OTHER[layer])):
                result[f"{layer}_moves_{name}"] = cell[energy] / none[energy] - 1
    return result
