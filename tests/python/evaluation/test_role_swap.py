"""Role swap: the model is asked for the leader, told so by its role, and measured against the true leader."""

from __future__ import annotations

import numpy as np
import pytest

from training.data.made import made_duet
from training.evaluation.metrics import quick_report
from training.evaluation.protocol import Trial
from training.evaluation.role_swap import measure_role_swap, swapped_trials


def test_the_reactor_leads():
    trial = Trial(made_duet(80, 1, "one"), np.ones((80, 54)))
    (swapped,) = swapped_trials([trial])
    assert np.array_equal(swapped.duet.leader, trial.duet.reactor)
    assert np.array_equal(swapped.duet.reactor, trial.duet.leader)
    assert swapped.music is trial.music


def test_a_dancer_that_knows_the_leader():
    """In role 1 it gives the true leader moved by the seed; in role 0 it would give something else."""
    trials = [Trial(made_duet(80, 1, "one"), None), Trial(made_duet(60, 2, "two"), None)]
    heard = []

    def dancer(leader, music, seed, heard_leader=None, guidance=None, coarse_only=False, role=0.0):
        heard.append(leader)
        true = next(t.duet for t in trials if np.array_equal(t.duet.reactor, leader))
        return (true.leader if role == 1.0 else true.reactor) + np.array([0.01 * seed, 0.0, 0.0])

    train = [made_duet(200, seed) for seed in (3, 4)]
    numbers, motions = measure_role_swap(dancer, trials, train, (0, 1, 3))
    generated = numbers["generated"]
    assert len(heard) == 6
    assert [row["root_error_mm"] for row in generated["trials"]["one"]["seeds"]] == pytest.approx(
        [0, 10, 30], abs=0.01
    )
    assert generated["trials"]["two"]["mean"]["root_error_mm"] == pytest.approx(40 / 3, abs=0.01)
    assert generated["mean"]["root_error_mm"] == pytest.approx(40 / 3, abs=0.01)
    assert generated["mean"]["mpjpe_mm"] == pytest.approx(0.0, abs=0.01)
    assert generated["mean"]["speed_ratio"] == pytest.approx(1.0, abs=1e-3)
    assert generated["trials"]["one"]["seeds"][0]["distance_ratio"] == pytest.approx(1.0)
    assert motions["one"][2] == pytest.approx(trials[0].duet.leader + np.array([0.03, 0.0, 0.0]))
    assert numbers["nearest neighbour"]["mean"]["mpjpe_mm"] > 10


def test_nearest_neighbour_is_swapped_too():
    """A training duet that is danced again is found by its reactor, and its leader is the answer."""
    known = made_duet(120, 5, "known")

    def still(leader, music, seed, heard_leader=None, guidance=None, coarse_only=False, role=0.0):
        return np.repeat(leader[:1], len(leader), axis=0)

    numbers, _ = measure_role_swap(still, [Trial(known, None)], [made_duet(120, 6), known], (0,))
    assert numbers["nearest neighbour"]["mean"]["mpjpe_mm"] == pytest.approx(0.0, abs=0.5)
    expected = quick_report(known.reactor, known.leader, still(known.reactor, None, 0))
    assert numbers["generated"]["mean"] == pytest.approx(expected)
