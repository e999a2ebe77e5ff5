"""The grid of coarse and fine guidance at every step."""

from __future__ import annotations

import numpy as np
import pytest

from training.evaluation.guidance import measure_guidance
from training.evaluation.protocol import HeldOutDuet, Settings


def test_each_guidance_changes_the_energy_of_its_layer(held_out: list[HeldOutDuet]):
    def guided(
        leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
    ):
        coarse, fine = guidance or (0.0, 0.0)
        time = np.arange(len(leader))[:, None, None] / 30
        slow, quick = np.sin(2 * np.pi * 0.5 * time), 0.1 * np.sin(2 * np.pi * 6 * time)
        return leader + (1 + coarse) * slow + (1 + fine) * quick + 0.1 * seed

    settings = Settings(seeds=(0, 1, 2), response_seeds=2, guidance_grid=(0.0, 1.2))
    cells = measure_guidance(guided, held_out[:1], settings)
    assert [(c["coarse"], c["fine"]) for c in cells] == [(0.0, 0.0), (0.0, 1.2), (1.2, 0.0), (1.2, 1.2)]
    power = 2.2**2
    assert cells[2]["slow_energy"] == pytest.approx(power * cells[0]["slow_energy"], rel=0.2)
    assert cells[2]["quick_energy"] == pytest.approx(cells[0]["quick_energy"], rel=0.01)
    assert cells[1]["quick_energy"] == pytest.approx(power * cells[0]["quick_energy"], rel=0.01)
    assert cells[1]["slow_energy"] == pytest.approx(cells[0]["slow_energy"], rel=0.01)
    (duet,) = (item.duet for item in held_out[:1])
    errors = [
        np.linalg.norm((made - duet.leader)[:, 0] - (duet.reactor - duet.leader)[:, 0], axis=-1).mean()
        for made in (guided(duet.leader, None, seed, guidance=(0.0, 0.0)) for seed in (0, 1))
    ]
    assert cells[0]["root_error_mm"] == pytest.approx(1000 * np.mean(errors))
