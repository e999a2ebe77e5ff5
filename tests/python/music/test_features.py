"""Music features: shapes and edges, the recipe's way through JSON, and the golden files of the browser's tests."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import soundfile

from tests.fixtures import make_audio
from training.config import FPS
from training.music.features import features, frame_count, load_audio, tempo
from training.music.recipe import AudioRecipe

RECIPE = AudioRecipe()
ONSET, BEAT = 52, 53
MFCC, DELTA, CHROMA = slice(0, 20), slice(20, 40), slice(40, 52)


def clicks(bpm: float, seconds: float) -> np.ndarray:
    """Bursts of noise, the first one after a beat."""
    rng = np.random.default_rng(0)
    audio = np.zeros(int(seconds * RECIPE.sample_rate), dtype=np.float32)
    length = RECIPE.sample_rate // 20
    for second in np.arange(60 / bpm, seconds - 0.1, 60 / bpm):
        start = round(second * RECIPE.sample_rate)
        audio[start : start + length] += 0.3 * rng.standard_normal(length) * np.exp(-np.arange(length) / 100)
    return audio


def sine(hertz: float, seconds: float) -> np.ndarray:
    time = np.arange(int(seconds * RECIPE.sample_rate)) / RECIPE.sample_rate
    return (0.5 * np.sin(2 * np.pi * hertz * time)).astype(np.float32)


@pytest.mark.parametrize("samples", [1, 511, 512, 1023, 2047, 2048, 10_000])
def test_one_row_per_motion_frame_for_any_length(samples: int) -> None:
    noise = np.random.default_rng(1).normal(0, 0.1, samples).astype(np.float32)
    matrix = features(noise, RECIPE)
    assert matrix.shape == (frame_count(samples, RECIPE), RECIPE.features) == (1 + samples // 512, 54)
    assert matrix.dtype == np.float32
    assert np.isfinite(matrix).all()


def test_two_frames_do_not_depend_on_memory() -> None:
    noise = np.random.default_rng(1).normal(0, 0.1, 600).astype(np.float32)
    first = features(noise, RECIPE)
    for _ in range(20):
        # Freed memory full of NaN is what an unwritten array is likely to get.
        junk = [np.full(size, np.nan, np.float32) for size in (1025, 2050, 4100, 31_775)]
        del junk
        np.testing.assert_array_equal(features(noise, RECIPE), first)


@pytest.mark.parametrize("samples", [1, 512, 2048, 40_000])
def test_silence_is_zeros_without_beats(samples: int) -> None:
    matrix = features(np.zeros(samples, np.float32), RECIPE)
    assert not matrix.any()
    assert tempo(matrix[:, ONSET], RECIPE) == 0


@pytest.mark.parametrize(
    "audio", [np.zeros(0, np.float32), np.zeros((2, 100), np.float32), np.array([0, np.nan], np.float32)]
)
def test_an_invalid_signal_is_an_error(audio: np.ndarray) -> None:
    with pytest.raises(ValueError):
        features(audio, RECIPE)


def test_beats_lie_on_the_clicks() -> None:
    matrix = features(clicks(120, 12), RECIPE)
    beats = np.flatnonzero(matrix[:, BEAT]) / FPS
    assert set(np.unique(matrix[:, BEAT])) == {0, 1}
    assert tempo(matrix[:, ONSET], RECIPE) == pytest.approx(120)
    assert len(beats) >= 20
    assert np.abs(beats / 0.5 - np.round(beats / 0.5)).max() * 0.5 <= 1.5 / FPS


def test_chroma_names_the_pitch_with_c_first() -> None:
    chroma = features(sine(440.0, 2), RECIPE)[20:-20, CHROMA]
    np.testing.assert_array_equal(chroma.argmax(axis=1), 9)  # A
    np.testing.assert_allclose(chroma.max(axis=1), 1)


def test_delta_is_the_slope_of_the_mfcc() -> None:
    matrix = features(clicks(100, 4), RECIPE)
    np.testing.assert_allclose(matrix[1:-1, DELTA], (matrix[2:, MFCC] - matrix[:-2, MFCC]) / 2, atol=1e-3)


def test_mfcc_does_not_depend_on_loudness() -> None:
    song = clicks(100, 4) + sine(330, 4)
    np.testing.assert_allclose(
        features(song * 0.1, RECIPE)[:, MFCC], features(song, RECIPE)[:, MFCC], atol=2e-2
    )


def test_load_audio_takes_the_mean_of_the_channels_at_the_recipe_rate(tmp_path: Path) -> None:
    time = np.arange(48000) / 48000
    left = 0.5 * np.sin(2 * np.pi * 440 * time)
    path = tmp_path / "song.wav"
    soundfile.write(path, np.stack([left, 0 * left], axis=1), 48000, subtype="FLOAT")
    audio = load_audio(path, RECIPE)
    assert audio.dtype == np.float32
    assert audio.shape == (RECIPE.sample_rate,)
    np.testing.assert_allclose(audio[1000:-1000], (sine(440, 1) / 2)[1000:-1000], atol=1e-4)


def test_load_audio_takes_one_of_two_channels_that_cancel_each_other_out(tmp_path: Path) -> None:
    left = sine(440, 1)
    path = tmp_path / "without-voice.wav"
    soundfile.write(path, np.stack([left, -0.999 * left], axis=1), RECIPE.sample_rate, subtype="FLOAT")
    np.testing.assert_allclose(load_audio(path, RECIPE), left, atol=1e-6)


def test_a_song_that_cannot_be_used_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"nowhere\.mp3 does not exist"):
        load_audio(tmp_path / "nowhere.mp3", RECIPE)
    (tmp_path / "text.mp3").write_text("no song")
    for name, samples in (("empty.wav", np.zeros(0)), ("nan.wav", np.full(100, np.nan))):
        soundfile.write(tmp_path / name, samples, 44100, subtype="FLOAT")
    for name, why in (("text.mp3", ""), ("empty.wav", "no sound"), ("nan.wav", "not finite")):
        with pytest.raises(ValueError, match=rf"{name} cannot be read as a song: .*{why}"):
            load_audio(tmp_path / name, RECIPE)


def test_recipe_is_unchanged_by_json_and_has_the_frames_of_the_motion() -> None:
    block = json.loads(json.dumps(RECIPE.to_dict()))
    assert block == RECIPE.to_dict()
    assert AudioRecipe(**{key: value for key, value in block.items() if key != "features"}) == RECIPE
    assert block["features"] == 54
    assert RECIPE.sample_rate / RECIPE.hop == FPS


def test_golden_files_are_up_to_date() -> None:
    golden = json.loads((make_audio.FOLDER / "golden.json").read_text())
    assert golden["recipe"] == RECIPE.to_dict(), "run python -m tests.fixtures.make_audio"
    assert golden["songs"].keys() == make_audio.SONGS.keys()
    for name, song in golden["songs"].items():
        samples, rate = soundfile.read(make_audio.FOLDER / f"{name}.wav", dtype="int16")
        assert rate == RECIPE.sample_rate
        np.testing.assert_allclose(samples, make_audio.make_song(name), atol=1)
        matrix = features(samples.astype(np.float32) / 32768, RECIPE)
        stored = np.fromfile(make_audio.FOLDER / f"{name}.f32", "<f4").reshape(-1, RECIPE.features)
        np.testing.assert_allclose(matrix, stored, atol=1e-2)
        np.testing.assert_array_equal(matrix[:, BEAT], stored[:, BEAT])
        assert tempo(matrix[:, ONSET], RECIPE) == pytest.approx(song["tempo"])
