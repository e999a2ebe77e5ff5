"""Tempo and phase from foot plants."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.python.support.real_data import real_duets
from tests.python.support.salsa import salsa_duet, salsa_steps
from training.data.step_tempo import duet_tempo, foot_plants, plant_errors, plant_fit
from training.music.tempo import Tempo


def cyclic_beats(a: Tempo, b: Tempo) -> float:
    """Distance in beats between the count 1 of two tempi, in the circle of eight."""
    away = (a.first - b.first) * b.bpm / 60
    return abs((away + 4) % 8 - 4)


@pytest.mark.parametrize(("bpm", "first"), [(150.0, 0.3), (171.5, 1.9), (195.0, 1.1)])
def test_tempo_and_phase_of_made_steps_are_found(bpm: float, first: float) -> None:
    truth = Tempo(bpm, first)
    duet = salsa_duet(900, truth)
    found = duet_tempo(duet, leader_only=False)
    assert abs(found.bpm - bpm) < 0.6
    assert cyclic_beats(found, truth) < 0.35
    errors = [
        plant_errors(foot_plants(m), found, begins) for begins, m in enumerate((duet.leader, duet.reactor))
    ]
    assert abs(np.median(np.concatenate(errors))) < 0.02


def test_plants_of_made_steps_lie_on_their_counts() -> None:
    truth = Tempo(165.0, 0.5)
    plants = foot_plants(salsa_steps(900, truth, begins=0))
    fit = plant_fit(plants, truth, begins=0)
    # A step is half as fast as at its fastest a quarter of its duration before it ends.
    assert np.abs(plant_errors(plants, truth, 0)).max() < 0.5
    assert fit.concentration > 0.78
    assert fit.plants == pytest.approx(900 / 30 * 165 / 60 * 6 / 8, abs=4)
    wrong = plant_fit(plants, Tempo(165.0, 0.5 + 4 * 60 / 165), begins=0)
    assert wrong.on_count < 0.5 * fit.on_count


def test_leader_only_does_not_look_at_the_reactor() -> None:
    duet = salsa_duet(600, Tempo(165.0, 0.5))
    other = replace(duet, reactor=salsa_steps(600, Tempo(190.0, 1.3), begins=1))
    assert duet_tempo(duet, leader_only=True) == duet_tempo(other, leader_only=True)
    assert duet_tempo(duet, leader_only=False) != duet_tempo(other, leader_only=False)


def test_beats_count_from_one_and_cover_the_duration() -> None:
    tempo = Tempo(120.0, 1.25)
    seconds, counts = tempo.beats(3.0)
    np.testing.assert_allclose(seconds, [0.25, 0.75, 1.25, 1.75, 2.25, 2.75])
    assert counts.tolist() == [6, 7, 0, 1, 2, 3]
    np.testing.assert_allclose(tempo.counts(seconds), counts, atol=1e-9)
    warped, _ = tempo.warped(1.25).beats(3.0 / 1.25)
    np.testing.assert_allclose(warped, seconds / 1.25)


def test_real_plants_cluster_on_the_counts() -> None:
    shares = []
    for duet in real_duets():
        tempo = duet_tempo(duet, leader_only=True)
        assert 155 < tempo.bpm < 195
        shares.append(plant_fit(foot_plants(duet.leader), tempo, begins=0).on_count)
    # A quarter would be chance.
    assert min(shares) > 0.45
    assert np.mean(shares) > 0.55


def test_leader_and_reactor_of_the_held_out_duets_agree_on_the_beat() -> None:
    held_out = [duet for duet in real_duets() if duet.name in ("salsa_03", "salsa_05")]
    for duet in held_out:
        tempo = duet_tempo(duet, leader_only=True)
        assert plant_fit(foot_plants(duet.reactor), tempo, begins=1).on_count > 0.6
