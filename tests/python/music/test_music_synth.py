"""The percussion synthesiser plays on the beat, differently for every seed."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from training.config import FPS
from training.music.features import features
from training.music.recipe import AudioRecipe
from training.music.synth import CLAVE_23, Kit, cycle_starts, percussion
from training.music.tempo import Tempo

RECIPE = AudioRecipe()
RATE = RECIPE.sample_rate
TEMPO = Tempo(160.0, 0.4)


def play(seed: int, samples: int = 8 * RATE, tempo: Tempo = TEMPO, **changes: Any) -> np.ndarray:
    rng = np.random.default_rng(seed)
    kit = replace(Kit.random(rng), **changes)
    return percussion(tempo, samples, RATE, kit, rng)


def test_same_seed_same_music_other_seed_other_music() -> None:
    np.testing.assert_array_equal(play(1), play(1))
    assert np.abs(play(1) - play(2)).max() > 0.05


def test_peak_length_and_type() -> None:
    audio = play(3, loudness=0.5)
    assert audio.shape == (8 * RATE,)
    assert audio.dtype == np.float32
    assert np.abs(audio).max() == pytest.approx(0.5, rel=1e-5)


def test_clave_alone_sounds_on_its_pattern_and_nowhere_else() -> None:
    others = dict.fromkeys(("conga", "bell", "maracas", "bass", "noise", "looseness"), 0.0)
    audio = play(4, clave=1.0, clave_pattern=CLAVE_23, **others)
    eighth = 30 / TEMPO.bpm
    onsets = [start + p * eighth for start in cycle_starts(TEMPO, 8.0) for p in CLAVE_23]
    expected = np.array([t for t in onsets if 0.0 < t < 7.98])
    loud = np.abs(audio) > 0.2 * np.abs(audio).max()
    index = np.flatnonzero(loud)
    heard = index[np.flatnonzero(np.diff(index, prepend=-RATE) > 0.05 * RATE)] / RATE
    np.testing.assert_allclose(heard, expected, atol=0.003)


@pytest.mark.parametrize("seed", range(2))
def test_beats_found_in_the_music_are_the_tempos(seed: int) -> None:
    audio = play(seed, samples=15 * RATE)
    found = np.flatnonzero(features(audio, RECIPE)[:, 53]) / FPS
    phase = np.exp(2j * np.pi * TEMPO.counts(found))
    assert len(found) > 15
    # One frame is about a tenth of a beat; the onset of a stroke is heard one frame late.
    assert abs(phase.mean()) > 0.9
    assert abs(np.angle(phase.mean())) / (2 * np.pi) < 0.2


def test_every_kit_marks_the_beat() -> None:
    kits = [Kit.random(np.random.default_rng(seed)) for seed in range(200)]
    assert all(kit.conga > 0 or kit.bell > 0 for kit in kits)
    assert {kit.clave > 0 for kit in kits} == {True, False}
