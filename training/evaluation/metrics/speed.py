"""Mean joint speed and acceleration of a motion, and its energy by frequency.

Motions are (T, J, 3) in metres. The ratios to the truth show over-smoothing (below 1) and jitter (above 1).
"""

from __future__ import annotations

import numpy as np

from training.config import FPS

# Bands of joint velocity, Hz: walking about, steps, accents, and mostly noise.
BANDS: tuple[tuple[float, float], ...] = ((0.0, 1.0), (1.0, 3.0), (3.0, 6.0), (6.0, 15.0))


def joint_speed(motion: np.ndarray) -> float:
    """Mean speed of all joints in the world, m/s."""
    return float(np.linalg.norm(np.diff(motion, axis=0), axis=-1).mean() * FPS)


def joint_acceleration(motion: np.ndarray) -> float:
    """Mean size of the second difference of all joints in the world, m/s^2."""
    return float(np.linalg.norm(np.diff(motion, n=2, axis=0), axis=-1).mean() * FPS**2)


def band_power(motion: np.ndarray, bands: tuple[tuple[float, float], ...] = BANDS) -> np.ndarray:
    """Mean power of the joint velocities in each band, (len(bands),) in (m/s)^2.

    Whole-clip periodogram of the velocities under a Hann window, averaged over joints and summed over x, y,
    z and the frequencies of [low, high); the last band includes the Nyquist frequency. Without the window a
    clip that ends faster than it began would leak its slow motion into the quick bands. Summed over all
    bands it is the mean squared speed, as the window weighs it.
    """
    velocity = np.diff(motion, axis=0) * FPS
    frames = len(velocity)
    window = np.hanning(frames + 2)[1:-1, None, None]
    spectrum = np.abs(np.fft.rfft(velocity * window, axis=0)) ** 2 / (frames * (window**2).sum())
    frequency = np.fft.rfftfreq(frames, 1 / FPS)
    twice = np.where((frequency > 0) & (frequency < FPS / 2), 2.0, 1.0)  # the negative frequencies
    power = twice * spectrum.sum(axis=2).mean(axis=1)
    last = len(bands) - 1
    return np.array(
        [
            power[(frequency >= low) & ((frequency <= high) if i == last else (frequency < high))].sum()
            for i, (low, high) in enumerate(bands)
        ]
    )


def band_name(low: float, high: float) -> str:
    return f"{low:g}-{high:g} Hz"


def band_decibels(truth: np.ndarray, generated: np.ndarray) -> dict[str, float]:
    """Energy of the generated motion against the true one, dB, by the name of each of `BANDS`."""
    ratio = band_power(generated) / band_power(truth)
    return {
        band_name(low, high): float(10 * np.log10(max(value, 1e-12)))
        for (low, high), value in zip(BANDS, ratio, strict=True)
    }
