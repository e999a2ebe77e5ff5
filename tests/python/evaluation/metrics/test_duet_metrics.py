"""A row has every measure, and the truth measured against itself has no error."""

from __future__ import annotations

import numpy as np
import pytest

from tests.python.support.bodies import swinging_body
from tests.python.support.held_out import made_music
from training.evaluation.metrics.duet import clip_count, duet_metrics, set_metrics


def test_the_truth_measured_against_itself():
    leader, truth = swinging_body(400, 3), swinging_body(400, 4)
    row = duet_metrics(leader, truth, truth, made_music(400, 20))
    zero = {k: v for k, v in row.items() if k.endswith(("error_mm", "_w1_m", "_w1_deg")) or "energy_db" in k}
    assert len(zero) == 8
    assert all(value == pytest.approx(0.0, abs=1e-9) for value in zero.values())
    ratios = {k: v for k, v in row.items() if k.endswith("_ratio")}
    assert len(ratios) == 4
    assert all(value == pytest.approx(1.0) for value in ratios.values())
    further = {"mpjpe_mm", "pfc", "ipr_capsules", "bas", "bas_chance", "skate_share", "bone_variation"}
    assert further | {"repeat_share", "repeat_mm"} <= set(row)
    short = duet_metrics(leader[:150], truth[:150], truth[:150])
    assert set(row) - set(short) == {k for k in row if k.startswith(("bas", "repeat"))}


def test_sets_of_clips():
    leader, truth = (
        swinging_body(600, 3),
        np.cumsum(np.random.default_rng(7).normal(scale=0.01, size=(600, 22, 3)), axis=0),
    )
    assert clip_count([truth, truth]) == 18
    same = set_metrics([(leader, truth)], [(leader, truth)], "corrected", resamples=5)
    assert set(same) == {"fid_k", "fid_g", "fid_cd", "div_k", "div_g", "div_cd"}
    for name in ("k", "g", "cd"):
        assert same[f"fid_{name}"].value == pytest.approx(0.0, abs=1e-6)
        assert same[f"div_{name}"].value > 0
    far = set_metrics([(leader, truth)], [(leader, 1.5 * truth)], "corrected", resamples=5)
    assert far["fid_k"].value > 0.1
    assert far["fid_cd"].value > 0.1
