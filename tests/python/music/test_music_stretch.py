"""Songs that are time-stretched to the beats of a dance."""

from __future__ import annotations

import numpy as np
import pytest

from training.music.recipe import AudioRecipe
from training.music.stretch import beats_at_tempo, find_beats, stretch_by, stretch_to_tempo, warp_time
from training.music.synth import conga_stroke
from training.music.tempo import Tempo

RECIPE = AudioRecipe()
RATE = RECIPE.sample_rate


def clicks(beats: np.ndarray, seconds: float) -> np.ndarray:
    """A slap on every beat."""
    rng = np.random.default_rng(0)
    audio = np.zeros(int(seconds * RATE), dtype=np.float32)
    stroke = conga_stroke(RATE, 220.0, "slap", rng)
    for beat in beats:
        start = round(beat * RATE)
        audio[start : start + len(stroke)] += stroke[: len(audio) - start]
    return audio


def onsets(audio: np.ndarray) -> np.ndarray:
    """Times of the strokes in seconds: where the short-time level jumps up."""
    level = np.sqrt(np.convolve(audio**2, np.ones(RATE // 100), mode="same"))
    loud = np.flatnonzero(level > 0.35 * level.max())
    return loud[np.flatnonzero(np.diff(loud, prepend=-RATE) > 0.08 * RATE)] / RATE


@pytest.mark.parametrize(("song", "octave"), [(160.0, 1.0), (82.0, 2.0), (330.0, 0.5), (130.0, 1.0)])
def test_octave_keeps_the_stretch_within_bounds(song: float, octave: float) -> None:
    beats = np.arange(0, 30, 60 / song)
    chosen = beats_at_tempo(beats, 165.0)
    assert chosen is not None
    assert 60 / np.median(np.diff(chosen)) == pytest.approx(song * octave)
    assert 0.75 <= 165.0 / (song * octave) <= 1.33


def test_a_song_out_of_bounds_at_every_octave_gives_none() -> None:
    assert beats_at_tempo(np.arange(0, 30, 60 / 118.0), 165.0) is None
    assert beats_at_tempo(np.arange(0, 2, 60 / 160.0), 165.0) is None


def test_uneven_beats_fall_on_the_even_beats_of_the_dance() -> None:
    rng = np.random.default_rng(3)
    beats = 0.5 + np.cumsum(0.4 + 0.05 * rng.standard_normal(30))
    audio = clicks(beats, beats[-1] + 1)
    tempo = Tempo(165.0, 0.7)
    # Longer than the song, so that it has to begin again.
    stretched = stretch_to_tempo(audio, beats, tempo, 18 * RATE, RECIPE, start=5)
    assert stretched.shape == (18 * RATE,)
    heard = onsets(stretched)
    counts = tempo.counts(heard)
    off = np.abs((counts + 0.5) % 1 - 0.5) * 60 / 165.0
    assert len(heard) == pytest.approx(18 * 165 / 60, abs=3)
    assert np.median(off) < 0.02
    assert off.max() < 0.05


def test_stretching_keeps_pitch_and_changes_length() -> None:
    tone = np.sin(2 * np.pi * 440 * np.arange(4 * RATE) / RATE).astype(np.float32)
    fast = stretch_by(tone, 1.25)
    assert len(fast) == pytest.approx(4 * RATE / 1.25, abs=512)
    spectrum = np.abs(np.fft.rfft(fast * np.hanning(len(fast))))
    assert spectrum.argmax() * RATE / len(fast) == pytest.approx(440, abs=1)


def test_an_identical_course_of_time_returns_the_song() -> None:
    rng = np.random.default_rng(0)
    audio = rng.standard_normal(2 * RATE).astype(np.float32)
    same = warp_time(audio, np.arange(0, len(audio), 256.0))[: len(audio)]
    # The last window has no following frame to take its phase from.
    np.testing.assert_allclose(same[: -2 * 1024], audio[: -2 * 1024], atol=2e-3)


def test_beats_of_a_steady_song_are_found() -> None:
    beats = np.arange(0.3, 12, 0.5)
    found = find_beats(clicks(beats, 12.5), RECIPE)
    nearest = np.abs(found[:, None] - beats).min(axis=1)
    assert len(found) >= 20
    assert np.median(nearest) < 0.05
