"""The demo song: what the program writes can be read back and has the beat it was asked for."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import soundfile

from training.config import FPS
from training.music.demo import RATE, Options, bass, main, piano
from training.music.features import features, load_audio
from training.music.recipe import AudioRecipe
from training.music.tempo import Tempo

RECIPE = AudioRecipe()
SHIPPED = Path(__file__).parents[3] / "web" / "public" / "demo" / "song.mp3"


def on_the_eighths(path: Path, tempo: Tempo) -> float:
    """How far the onsets of a song gather on the eighths of a tempo: 1 for all, about 0 for another tempo."""
    onset = features(load_audio(path, RECIPE), RECIPE)[:, 52]
    counts = tempo.counts(np.arange(len(onset)) / FPS)
    return float(np.abs(np.sum(onset * np.exp(4j * np.pi * counts))) / np.sum(onset))


def test_program_writes_a_song_with_the_asked_beat(tmp_path: Path) -> None:
    out = tmp_path / "song.mp3"
    main(Options(out=out, bpm=158.0, cycles=5, seed=20))
    audio, rate = soundfile.read(out)
    assert rate == RATE
    assert audio.ndim == 1
    assert 0.6 < np.abs(audio).max() <= 1.0
    assert abs(len(audio) / RATE - (0.35 + 5 * 8 * 60 / 158 + 2)) < 0.1
    assert on_the_eighths(out, Tempo(158.0, 0.35)) > 3 * on_the_eighths(out, Tempo(155.0, 0.35))
    assert on_the_eighths(out, Tempo(158.0, 0.35)) > 0.3


@pytest.mark.parametrize("line", ["piano", "bass"])
def test_piano_and_bass_strike_on_the_eighths(line: str) -> None:
    tempo = Tempo(150.0, 0.0)
    samples = 2 * RATE * 8 * 60 // 150
    audio = piano(tempo, samples, 1, np.random.default_rng(0)) if line == "piano" else bass(tempo, samples, 1)
    eighth = RATE * 30 // 150
    # Strokes (in eighths) before which the line pauses, in both cycles.
    rises = []
    for position in (11, 11 + 16) if line == "piano" else (11, 14, 11 + 16, 14 + 16):
        at = position * eighth
        before, after = (np.std(audio[a : a + RATE // 25]) for a in (at - RATE // 25 - 400, at + 400))
        rises.append(after / max(before, 1e-6))
    assert min(rises) > 1.5, rises


def test_shipped_song_is_small_and_steady() -> None:
    assert SHIPPED.stat().st_size < 700_000
    assert on_the_eighths(SHIPPED, Tempo(Options().bpm, 0.35)) > 0.3
