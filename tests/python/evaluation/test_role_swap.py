"""Role swap: the model generates the leader (role 1), measured against the true leader."""

from __future__ import annotations

import numpy as np
import pytest

from tests.python.support.duets import made_duet
from training.evaluation.metrics import quick_report
from training.evaluation.protocol import HeldOutDuet
from training.evaluation.role_swap import measure_role_swap, swapped_duets


def test_the_dancers_are_exchanged_and_the_music_stays():
    item = HeldOutDuet(made_duet(80, 1, "one"), np.ones((80, 54)))
    (swapped,) = swapped_duets([item])
    assert np.array_equal(swapped.duet.leader, item.duet.reactor)
    assert np.array_equal(swapped.duet.reactor, item.duet.leader)
    assert swapped.music is item.music


def test_a_generator_that_knows_the_leader_has_the_error_of_its_seed():
    """In role 1 it gives the true leader moved by the seed; in role 0 it would give something else."""
    held_out = [HeldOutDuet(made_duet(80, 1, "one"), None), HeldOutDuet(made_duet(60, 2, "two"), None)]
    calls = []

    def generate(
        leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
    ):
        calls.append(leader)
        true = next(i.duet for i in held_out if np.array_equal(i.duet.reactor, leader))
        return (true.leader if role == 1.0 else true.reactor) + np.array([0.01 * seed, 0.0, 0.0])

    train = [made_duet(200, seed) for seed in (3, 4)]
    numbers, motions = measure_role_swap(generate, held_out, train, (0, 1, 3))
    generated = numbers["generated"]
    assert len(calls) == 6
    assert [row["root_error_mm"] for row in generated["trials"]["one"]["seeds"]] == pytest.approx(
        [0, 10, 30], abs=0.01
    )
    assert generated["trials"]["two"]["mean"]["root_error_mm"] == pytest.approx(40 / 3, abs=0.01)
    assert generated["mean"]["root_error_mm"] == pytest.approx(40 / 3, abs=0.01)
    assert generated["mean"]["mpjpe_mm"] == pytest.approx(0.0, abs=0.01)
    assert generated["mean"]["speed_ratio"] == pytest.approx(1.0, abs=1e-3)
    assert generated["trials"]["one"]["seeds"][0]["distance_ratio"] == pytest.approx(1.0)
    assert motions["one"][2] == pytest.approx(held_out[0].duet.leader + np.array([0.03, 0.0, 0.0]))
    assert numbers["nearest neighbour"]["mean"]["mpjpe_mm"] > 10


def test_nearest_neighbour_is_swapped_too():
    """A training duet that is danced again is found by its reactor, and its leader is copied."""
    known = made_duet(120, 5, "known")

    def still(
        leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
    ):
        return np.repeat(leader[:1], len(leader), axis=0)

    numbers, _ = measure_role_swap(still, [HeldOutDuet(known, None)], [made_duet(120, 6), known], (0,))
    assert numbers["nearest neighbour"]["mean"]["mpjpe_mm"] == pytest.approx(0.0, abs=0.5)
    expected = quick_report(known.reactor, known.leader, still(known.reactor, None, 0))
    assert numbers["generated"]["mean"] == pytest.approx(expected)
