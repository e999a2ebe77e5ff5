"""Time-stretches songs so that their beats fall on those of a dance, with a phase vocoder."""

from __future__ import annotations

import librosa
import numpy as np

from training.music.recipe import AudioRecipe
from training.music.tempo import Tempo

LOWEST_RATIO, HIGHEST_RATIO = 0.75, 1.33
"""Bounds of the dance's tempo over the song's; beyond them a stretched song sounds wrong."""

_N_FFT = 1024
_HOP = 256


def find_beats(audio: np.ndarray, recipe: AudioRecipe) -> np.ndarray:
    """Beats of a song in seconds, by librosa: (K,). audio: (N,) mono at recipe.sample_rate."""
    frames = librosa.beat.beat_track(
        y=audio, sr=recipe.sample_rate, hop_length=recipe.hop, start_bpm=recipe.start_bpm, trim=False
    )[1]
    return np.asarray(frames) * recipe.hop / recipe.sample_rate


def beats_at_tempo(beats: np.ndarray, bpm: float) -> np.ndarray | None:
    """The beats of a song, or twice or half as many, so that the stretch to `bpm` stays within the bounds.

    beats: (K,) seconds. Returns (M,) seconds, or None when none of the three fits or there are fewer than eight beats.
    """
    if len(beats) < 8:
        return None
    song_bpm = 60 / float(np.median(np.diff(beats)))
    index = np.arange(len(beats))
    for octave in (1.0, 2.0, 0.5):
        if LOWEST_RATIO <= bpm / (song_bpm * octave) <= HIGHEST_RATIO:
            chosen = np.interp(np.arange(0, len(beats) - 1 + 1e-9, 1 / octave), index, beats)
            return chosen if len(chosen) >= 8 else None
    return None


def warp_time(audio: np.ndarray, source: np.ndarray) -> np.ndarray:
    """`audio` (N,) along another course of time, pitch unchanged: (K * 256,) float32.

    source: (K,) position in audio, in samples, of output sample k * 256; it may jump. A phase vocoder: magnitudes are
    those at the source positions, phases advance as fast as they do there.
    """
    spectrum = librosa.stft(audio, n_fft=_N_FFT, hop_length=_HOP)
    at = np.clip(source / _HOP, 0, spectrum.shape[1] - 2)
    whole = at.astype(int)
    part = (at - whole).astype(np.float32)
    here, there = spectrum[:, whole], spectrum[:, whole + 1]
    magnitude = (1 - part) * np.abs(here) + part * np.abs(there)
    expected = 2 * np.pi * _HOP * np.arange(len(spectrum))[:, None] / _N_FFT
    deviation = np.angle(there) - np.angle(here) - expected
    advance = expected + deviation - 2 * np.pi * np.round(deviation / (2 * np.pi))
    phase = np.cumsum(advance, axis=1) - advance + np.angle(here[:, :1])
    warped = librosa.istft(
        magnitude * np.exp(1j * phase), hop_length=_HOP, n_fft=_N_FFT, length=len(source) * _HOP
    )
    return warped.astype(np.float32)


def stretch_to_tempo(
    audio: np.ndarray, beats: np.ndarray, tempo: Tempo, samples: int, recipe: AudioRecipe, start: int = 0
) -> np.ndarray:
    """A song whose beats fall on those of `tempo`: (samples,) float32.

    beats: (K,) seconds from `beats_at_tempo`. start: index of the song's beat on the dance's first beat. A song that is
    too short begins again after a multiple of four beats.
    """
    usable = len(beats) - 1 - (len(beats) - 1) % 4
    seconds = np.arange(int(np.ceil(samples / _HOP))) * _HOP / recipe.sample_rate
    position = (seconds - tempo.first) * tempo.bpm / 60
    index = np.floor(position).astype(int)
    song_index = (index + start) % usable
    source = beats[song_index] + (position - index) * (beats[song_index + 1] - beats[song_index])
    return warp_time(audio, source * recipe.sample_rate)[:samples]


def stretch_by(audio: np.ndarray, factor: float) -> np.ndarray:
    """A song (N,) `factor` times as fast, pitch unchanged: (about N / factor,) float32."""
    return warp_time(audio, np.arange(0, len(audio), _HOP * factor))
