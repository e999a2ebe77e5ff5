"""The constants of the 54 music features. The browser's extractor reads them from the manifest."""

from __future__ import annotations

from dataclasses import asdict, dataclass


@dataclass(frozen=True)
class AudioRecipe:
    """How a song becomes music features.

    All values are numbers, so that JSON keeps them. One feature frame is one motion frame: `sample_rate / hop` frames
    per second.
    """

    sample_rate: int = 15360
    """Rate of the mono signal that is analysed, Hz."""
    cancelled_share: float = 0.01
    """Channels whose mean is less loud than this share of the first one cancel each other out."""
    hop: int = 512
    """Samples between frames; 15360 / 512 = 30 frames per second, the rate of the motion."""
    n_fft: int = 2048
    """Samples under the periodic Hann window of a frame; frames are centred, the signal padded with zeros."""

    mels: int = 128
    """Bands of the Slaney mel filter bank."""
    mel_fmin: float = 0.0
    """Lowest edge of the mel filter bank, Hz."""
    mel_fmax: float = 7680.0
    """Highest edge of the mel filter bank, Hz; half the sample rate."""
    amin: float = 1e-10
    """Powers below this count as this before the logarithm."""
    top_db: float = 80.0
    """Decibels below the loudest value of the song at which a spectrogram is cut off."""
    mfcc: int = 20
    """Cepstral coefficients (DCT-II, orthonormal), and as many deltas."""
    delta_width: int = 3
    """Frames of the line fitted for a delta; odd."""

    hpss_kernel: int = 31
    """Frames and bins of the two medians that separate harmony from percussion; odd."""
    hpss_power: float = 2.0
    """Exponent of the soft masks of that separation."""

    chroma: int = 12
    """Pitch classes, C first."""
    chroma_tuning: float = 0.0
    """Deviation from A = 440 Hz in fractions of a pitch class; fixed: an estimate could not be matched."""
    chroma_octave: float = 5.0
    """Octave (above A0 = 27.5 Hz) at which the Gaussian weight of the chroma filters is centred."""
    chroma_octave_width: float = 2.0
    """Standard deviation of that weight, octaves."""

    onset_lag: int = 1
    """Frames between the spectra whose difference is the onset strength."""
    start_bpm: float = 120.0
    """Mean of the log-normal prior of the tempo, beats per minute."""
    tempo_std: float = 1.0
    """Standard deviation of that prior, octaves."""
    tempo_window: float = 8.0
    """Length of the autocorrelation window of the tempo, seconds."""
    max_tempo: float = 320.0
    """Tempi from here on are not considered, beats per minute."""
    tightness: float = 100.0
    """How closely the beats keep to the tempo."""

    @property
    def features(self) -> int:
        """Columns: MFCC, their deltas, chroma, onset strength, beat."""
        return 2 * self.mfcc + self.chroma + 2

    def to_dict(self) -> dict[str, float]:
        """The manifest's `audio` block: every field, and the number of feature columns."""
        return {**asdict(self), "features": self.features}


MUSIC_FEATURES = AudioRecipe().features
