"""What the programs of stage 2 share: how they validate."""

from __future__ import annotations

import numpy as np
import pytest

from export.tiny import tiny_model
from tests.python.support.duets import made_duet
from training.config import STRIDE
from training.data.music_pairing import Variant
from training.diffusion.react import Request, react
from training.evaluation.metrics import quick_report
from training.music.recipe import MUSIC_FEATURES
from training.stage2 import validate


def test_validation_is_the_mean_over_duets_and_seeds_beside_the_leader_to_the_first_music() -> None:
    model, random = tiny_model(), np.random.default_rng(0)
    duets = [made_duet(frames, seed, f"{seed}") for frames, seed in ((122, 1), (160, 2))]
    bank = {
        duet.name: {
            Variant(1.0, "synth", seed): random.normal(size=(len(duet), MUSIC_FEATURES)).astype(np.float32)
            for seed in range(2)
        }
        for duet in duets
    }
    report = validate(model, bank, duets, seeds=2)
    rows = []
    for duet in duets:
        frames = len(duet) // STRIDE * STRIDE
        leader, music = duet.leader[:frames], bank[duet.name][Variant(1.0, "synth", 0)][:frames]
        for seed in range(2):
            made = react(model, Request(leader, music, seed))
            rows.append(quick_report(leader, duet.reactor[:frames], made))
    assert set(report) == {f"val/{name}" for name in rows[0]}
    for name in rows[0]:
        values = [row[name] for row in rows]
        assert report[f"val/{name}"] == pytest.approx(np.mean(values)), name
        assert len(set(values)) == len(values)
