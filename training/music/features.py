"""The music features of a song, by librosa 0.11. The browser's extractor is tested against them."""

from __future__ import annotations

from pathlib import Path

import librosa
import numpy as np
import soundfile

from training.music.recipe import AudioRecipe

SONG_SUFFIXES = (".wav", ".flac", ".mp3", ".ogg", ".opus")
"""Files that `load_audio` reads."""


def load_audio(path: str | Path, recipe: AudioRecipe) -> np.ndarray:
    """Reads a sound file as one channel (`mixed_down`) at the recipe's rate.

    Returns
    -------
    (N,) float32, N = ceil(seconds * recipe.sample_rate).

    Raises
    ------
    FileNotFoundError
    ValueError
        That names the file when it holds none of libsndfile's formats, no sample, or samples that are not finite.
    """
    if not Path(path).exists():
        raise FileNotFoundError(f"{path} does not exist")
    try:
        channels, rate = soundfile.read(path, dtype="float32", always_2d=True)
    except soundfile.LibsndfileError as error:
        raise ValueError(f"{path} cannot be read as a song: {error}") from error
    if len(channels) == 0:
        raise ValueError(f"{path} cannot be read as a song: it holds no sound")
    if not np.isfinite(channels).all():
        raise ValueError(f"{path} cannot be read as a song: it holds samples that are not finite")
    return librosa.resample(
        mixed_down(channels, recipe.cancelled_share),
        orig_sr=rate,
        target_sr=recipe.sample_rate,
        res_type="soxr_hq",
    )


def mixed_down(channels: np.ndarray, cancelled_share: float) -> np.ndarray:
    """Mean (N,) of the channels (N, C); the first channel where they cancel each other out, as those of a song whose
    voice was removed do: it can be heard, but its mean is silent.
    """
    mean, first = channels.mean(axis=1), channels[:, 0].copy()
    return first if np.abs(mean).max() < cancelled_share * np.abs(first).max() else mean


def frame_count(samples: int, recipe: AudioRecipe) -> int:
    """Feature frames of a signal of so many samples."""
    return 1 + samples // recipe.hop


def features(audio: np.ndarray, recipe: AudioRecipe) -> np.ndarray:
    """MFCC, MFCC deltas, chroma, onset strength and beats, one row per motion frame.

    Digital silence gives zeros. The whole song is needed at once: the decibel reference is its loudest value.

    Parameters
    ----------
    audio : (N,) mono samples in [-1, 1] at `recipe.sample_rate`, N >= 1.

    Returns
    -------
    (1 + N // recipe.hop, recipe.features) float32.

    Raises
    ------
    ValueError
        For an empty signal, more than one dimension, or samples that are not finite.
    """
    if audio.ndim != 1 or audio.size == 0:
        raise ValueError(f"features need a non-empty mono signal of shape (N,), got {audio.shape}")
    if not np.isfinite(audio).all():
        raise ValueError("the audio holds samples that are not finite")
    spectrum = _magnitude(audio.astype(np.float32, copy=False), recipe)
    mfcc = _mfcc(spectrum, recipe)
    harmonic, percussive = _separate(spectrum, recipe)
    onset = _onset(percussive, recipe)
    columns = [
        mfcc,
        _delta(mfcc, recipe),
        _chroma(harmonic, recipe),
        onset[None],
        _beats(onset, recipe)[None],
    ]
    return np.ascontiguousarray(np.concatenate(columns).T, dtype=np.float32)


def _magnitude(audio: np.ndarray, recipe: AudioRecipe) -> np.ndarray:
    """(n_fft / 2 + 1, frames) magnitude spectrogram of a signal (N,), frames centred.

    A signal shorter than the window is padded with zeros at its end, and the frames that this adds are cut off.
    """
    padded = np.pad(audio, (0, max(0, recipe.n_fft - audio.size)))
    stft = librosa.stft(
        padded, n_fft=recipe.n_fft, hop_length=recipe.hop, window="hann", center=True, pad_mode="constant"
    )
    return np.abs(stft)[:, : frame_count(audio.size, recipe)]


def _separate(magnitude: np.ndarray, recipe: AudioRecipe) -> tuple[np.ndarray, np.ndarray]:
    """Harmonic and percussive magnitude spectrograms, both shaped like the input.

    Frames are mirrored at both ends here. Scipy's median filter does the same, but with two frames it reads memory that
    was never written (scipy 1.17).
    """
    margin = recipe.hpss_kernel // 2
    mirrored = np.pad(magnitude, ((0, 0), (margin, margin)), mode="symmetric")
    harmonic, percussive = librosa.decompose.hpss(
        mirrored, kernel_size=recipe.hpss_kernel, power=recipe.hpss_power
    )
    return harmonic[:, margin:-margin], percussive[:, margin:-margin]


def _mel(magnitude: np.ndarray, recipe: AudioRecipe) -> np.ndarray:
    """(mels, frames) power in the Slaney mel bands."""
    return librosa.feature.melspectrogram(
        S=magnitude**2,
        sr=recipe.sample_rate,
        n_fft=recipe.n_fft,
        n_mels=recipe.mels,
        fmin=recipe.mel_fmin,
        fmax=recipe.mel_fmax,
    )


def _mfcc(magnitude: np.ndarray, recipe: AudioRecipe) -> np.ndarray:
    """(mfcc, frames) cepstrum of the mel spectrogram in decibels below the loudest value of the song."""
    decibels = librosa.power_to_db(
        _mel(magnitude, recipe), ref=np.max, amin=recipe.amin, top_db=recipe.top_db
    )
    return librosa.feature.mfcc(S=decibels, n_mfcc=recipe.mfcc, dct_type=2, norm="ortho")


def _delta(mfcc: np.ndarray, recipe: AudioRecipe) -> np.ndarray:
    """(mfcc, frames) slope of each coefficient per frame; zero when there are too few frames for the fit."""
    if mfcc.shape[1] < recipe.delta_width:
        return np.zeros_like(mfcc)
    return librosa.feature.delta(mfcc, width=recipe.delta_width, order=1, mode="interp")


def _chroma(harmonic: np.ndarray, recipe: AudioRecipe) -> np.ndarray:
    """(chroma, frames) power of each pitch class, the strongest of a frame being 1."""
    return librosa.feature.chroma_stft(
        S=harmonic**2,
        sr=recipe.sample_rate,
        n_fft=recipe.n_fft,
        n_chroma=recipe.chroma,
        tuning=recipe.chroma_tuning,
        ctroct=recipe.chroma_octave,
        octwidth=recipe.chroma_octave_width,
        norm=np.inf,
    )


def _onset(percussive: np.ndarray, recipe: AudioRecipe) -> np.ndarray:
    """(frames,) median over the mel bands of the rise in decibels since the frame before."""
    decibels = librosa.power_to_db(_mel(percussive, recipe), ref=1.0, amin=recipe.amin, top_db=recipe.top_db)
    return librosa.onset.onset_strength(
        S=decibels,
        sr=recipe.sample_rate,
        n_fft=recipe.n_fft,
        hop_length=recipe.hop,
        lag=recipe.onset_lag,
        aggregate=np.median,
        center=True,
    )


def _beats(onset: np.ndarray, recipe: AudioRecipe) -> np.ndarray:
    """(frames,) 1 at the frames that hold a beat, else 0."""
    beats = np.zeros(onset.shape)
    if onset.any():
        # In double precision: librosa keeps its input's precision, and ties that float32 rounding decides cannot be
        # reproduced in the browser.
        _, frames = librosa.beat.beat_track(
            onset_envelope=onset.astype(np.float64),
            sr=recipe.sample_rate,
            hop_length=recipe.hop,
            bpm=tempo(onset, recipe),
            tightness=recipe.tightness,
        )
        beats[frames] = 1
    return beats


def tempo(onset: np.ndarray, recipe: AudioRecipe) -> float:
    """The tempo of a song in beats per minute; 0 where all onset strengths are 0.

    Parameters
    ----------
    onset : (frames,) onset strength, a column of `features`.
    """
    if not onset.any():
        return 0.0
    estimate = librosa.feature.tempo(
        onset_envelope=onset.astype(np.float64),
        sr=recipe.sample_rate,
        hop_length=recipe.hop,
        start_bpm=recipe.start_bpm,
        std_bpm=recipe.tempo_std,
        ac_size=recipe.tempo_window,
        max_tempo=recipe.max_tempo,
    )
    return float(estimate[0])
