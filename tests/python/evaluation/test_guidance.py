"""Guidance of the coarse and the fine layer: the grid, and how far the two are separate controls."""

from __future__ import annotations

import numpy as np
import pytest

from training.data.duet import Duet
from training.evaluation.evaluate import evaluate
from training.evaluation.guidance import separability
from training.evaluation.protocol import HeldOutDuet, Settings


def test_each_guidance_changes_the_energy_of_its_layer(held_out: list[HeldOutDuet], train: list[Duet]):
    def guided(
        leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
    ):
        coarse, fine = guidance or (0.0, 0.0)
        time = np.arange(len(leader))[:, None, None] / 30
        slow, quick = np.sin(2 * np.pi * 0.5 * time), 0.1 * np.sin(2 * np.pi * 6 * time)
        return leader + (1 + coarse) * slow + (1 + fine) * quick

    settings = Settings(
        seeds=(0,), response_seeds=1, seam_starts=(0,), two_sample=False, guidance_grid=(0.0, 1.2)
    )
    numbers = evaluate(guided, held_out[:1], train, settings).numbers
    cells = numbers["guidance"]
    assert [(c["coarse"], c["fine"]) for c in cells] == [(0.0, 0.0), (0.0, 1.2), (1.2, 0.0), (1.2, 1.2)]
    assert cells[2]["slow_energy"] > 2 * cells[0]["slow_energy"]
    assert cells[2]["quick_energy"] == pytest.approx(cells[0]["quick_energy"], rel=0.1)
    assert cells[1]["quick_energy"] > 2 * cells[0]["quick_energy"]
    assert cells[1]["slow_energy"] == pytest.approx(cells[0]["slow_energy"], rel=0.1)
    assert numbers["separability"] == separability(cells)


def test_separability_is_the_change_of_energy_from_no_guidance_to_the_papers():
    cells = [
        {"coarse": c, "fine": f, "slow_energy": 2.0 * (1 + c), "quick_energy": 0.5 * (1 + f) + 0.05 * c}
        for c in (0.0, 0.5, 1.2)
        for f in (0.0, 0.5, 1.2)
    ]
    assert separability(cells) == pytest.approx(
        {"coarse_moves_own": 1.2, "coarse_moves_other": 0.12, "fine_moves_own": 1.2, "fine_moves_other": 0.0}
    )
    assert separability([c for c in cells if c["fine"] < 1]) == pytest.approx(
        {"coarse_moves_own": 1.2, "coarse_moves_other": 0.12}
    )
    assert separability(cells[4:]) == {}
