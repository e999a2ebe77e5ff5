"""Classifier-free guidance of the coarse and the fine layer at every step: a grid of both (the paper's Table 4)."""

from __future__ import annotations

from collections.abc import Sequence

from training.evaluation.controls import QUICK_HZ, SLOW_HZ
from training.evaluation.metrics import mean_report, quick_report
from training.evaluation.metrics.speed import band_power
from training.evaluation.protocol import HeldOutDuet, ReactorGenerator, Settings


def measure_guidance(
    generate: ReactorGenerator, held_out: Sequence[HeldOutDuet], settings: Settings
) -> list[dict[str, float]]:
    """`quick_report` and energy for every pair of coarse and fine guidance of the settings' grid, mean over
    duets and seeds.

    generate: with guidance at every step. slow_energy and quick_energy are powers of joint velocity under 1.5 Hz and
    over 3 Hz, (m/s)^2.
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
