"""Estimates the tempo and phase of a salsa dance, both constant, from the motion of the feet.

Salsa has eight counts: steps on 1, 2, 3 and 5, 6, 7 with alternating feet, so that one foot is planted on 1, 3 and 6
and the other on 2, 5 and 7. The leader begins with the left foot, the reactor with the right. The steps on 2 and 6 are
small, and dancers spread three steps over four counts. Single counts are therefore weak in the spectrum of foot speed,
but the cycle of eight counts is strong in the sum and in the difference of the two feet.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.signal import find_peaks

from training.data.duet import FPS, Duet
from training.motion.skeleton import JOINTS
from training.music.tempo import CYCLE, Tempo

_LEFT = tuple(JOINTS.index(name) for name in ("left_ankle", "left_foot"))
_RIGHT = tuple(JOINTS.index(name) for name in ("right_ankle", "right_foot"))

# Counts, from 0, on which the first foot of the cycle and the other one are planted.
BEGINNING_FOOT = (0, 2, 5)
OTHER_FOOT = (1, 4, 6)

_BPM = np.arange(140.0, 210.0, 0.2)
# Harmonics of the eight-count cycle in foot speed: the sum of both feet repeats after four counts, their difference
# changes its sign after four.
_SUM_HARMONICS = (2, 4, 6)
_DIFFERENCE_HARMONICS = (1, 3, 5)


@dataclass(frozen=True)
class Plants:
    """Foot plants of one dancer: seconds (K,), foot (K,) 0 left or 1 right, and peak speed (K,) of the step, m/s."""

    seconds: np.ndarray
    foot: np.ndarray
    speed: np.ndarray


def foot_speed(motion: np.ndarray) -> np.ndarray:
    """Speed (2, T) of the left and right foot (mean of ankle and toe) of a motion (T, 22, 3), m/s, whose positions are
    smoothed by a Gaussian of 1.5 frames.
    """
    rows = []
    for foot in (_LEFT, _RIGHT):
        path = gaussian_filter1d(motion[:, foot].mean(axis=1).astype(np.float64), 1.5, axis=0, mode="nearest")
        rows.append(np.linalg.norm(np.gradient(path, axis=0), axis=1) * FPS)
    return np.stack(rows)


def foot_plants(motion: np.ndarray) -> Plants:
    """Foot plants of a motion (T, 22, 3): when the speed of a foot has fallen to half of the step's peak.

    There it changes fastest, so this time is known best; a captured foot goes on sliding a little. Steps slower than
    0.5 m/s do not count.
    """
    seconds, feet, peaks = [], [], []
    for foot, speed in enumerate(foot_speed(motion)):
        found, _ = find_peaks(speed, height=0.5, prominence=0.25)
        for peak, following in zip(found, np.append(found, len(speed))[1:], strict=True):
            level = 0.5 * speed[peak]
            slow = np.flatnonzero(speed[peak:following] <= level)
            if len(slow):
                after = peak + slow[0]
                fall = speed[after - 1] - speed[after]
                seconds.append((after - 1 + (speed[after - 1] - level) / fall) / FPS)
                feet.append(foot)
                peaks.append(speed[peak])
    order = np.argsort(seconds)
    return Plants(np.array(seconds)[order], np.array(feet, dtype=int)[order], np.array(peaks)[order])


def _centred(signal: np.ndarray) -> np.ndarray:
    """The signal (T,) without its slow trend (Gaussian of 2 s), faded at both ends, with norm 1."""
    window = np.hanning(len(signal) + 2)[1:-1] ** 0.25
    signal = (signal - gaussian_filter1d(signal, 2.0 * FPS, mode="nearest")) * window
    return signal / max(float(np.linalg.norm(signal)), 1e-12)


def cycle_power(motion: np.ndarray, bpm: np.ndarray) -> np.ndarray:
    """Power (len(bpm),) of the foot speeds in harmonics of eight counts at each tempo, about 0 to 1."""
    left, right = foot_speed(motion)
    seconds = np.arange(len(motion)) / FPS
    power = np.zeros(len(bpm))
    for signal, harmonics in ((left + right, _SUM_HARMONICS), (left - right, _DIFFERENCE_HARMONICS)):
        signal = _centred(signal)
        for harmonic in harmonics:
            wave = np.exp(-2j * np.pi * harmonic * np.outer(bpm / 60 / CYCLE, seconds))
            power += np.abs(wave @ signal) ** 2 / len(seconds)
    return power


def _step_template(counts: np.ndarray, planted: tuple[int, ...]) -> np.ndarray:
    """Expected foot speed, of any scale, at positions in the eight counts: a Gaussian before each plant.

    The small steps on 2 and 6 have half the height.
    """
    total = np.zeros_like(counts)
    for plant in planted:
        away = (counts - (plant - 0.6) + CYCLE / 2) % CYCLE - CYCLE / 2
        total += (0.5 if plant in (1, 5) else 1.0) * np.exp(-0.5 * (away / 0.5) ** 2)
    return total


def plant_errors(plants: Plants, tempo: Tempo, begins: int) -> np.ndarray:
    """Signed distance (K,) in beats of each plant from the nearest count on which its foot is planted.

    begins: the foot on count 1, 0 left (leader) or 1 right (reactor).
    """
    counts = tempo.counts(plants.seconds)
    targets = np.where((plants.foot == begins)[:, None], BEGINNING_FOOT, OTHER_FOOT)
    errors = (counts[:, None] - targets + CYCLE / 2) % CYCLE - CYCLE / 2
    return errors[np.arange(len(counts)), np.abs(errors).argmin(axis=1)]


def estimate_tempo(dancers: list[tuple[np.ndarray, int]]) -> Tempo:
    """Constant tempo and phase of dancers who move together.

    dancers: motions (T, 22, 3), each with the foot on count 1 (0 left, 1 right).

    The tempo is that of the most power in the harmonics of eight counts. The phase is that at which foot speeds
    correlate best with the pattern of steps, then moved so that the median plant lies on its count.
    """
    bpm = float(_BPM[np.sum([cycle_power(motion, _BPM) for motion, _ in dancers], axis=0).argmax()])
    period = 60 / bpm
    feet = [(foot_speed(motion), begins) for motion, begins in dancers]
    fits = []
    firsts = np.arange(0, CYCLE, 0.05) * period
    for first in firsts:
        fit = 0.0
        for speeds, begins in feet:
            counts = Tempo(bpm, float(first)).counts(np.arange(speeds.shape[1]) / FPS)
            for foot, speed in enumerate(speeds):
                template = _step_template(counts, BEGINNING_FOOT if foot == begins else OTHER_FOOT)
                fit += float(np.corrcoef(template, speed)[0, 1])
        fits.append(fit)
    tempo = Tempo(bpm, float(firsts[int(np.argmax(fits))]))
    errors = np.concatenate([plant_errors(foot_plants(motion), tempo, begins) for motion, begins in dancers])
    shift = float(np.median(errors)) * period if len(errors) else 0.0
    return Tempo(bpm, (tempo.first + shift) % (CYCLE * period))


def duet_tempo(duet: Duet, leader_only: bool) -> Tempo:
    """Tempo of a duet, from both dancers or from the leader alone.

    The music of a held-out duet is a condition of the model, so its tempo may not depend on the true reactor.
    """
    if leader_only:
        return estimate_tempo([(duet.leader, 0)])
    return estimate_tempo([(duet.leader, 0), (duet.reactor, 1)])


@dataclass(frozen=True)
class PlantFit:
    """How well foot plants agree with a tempo.

    plants: their number. on_count: share within a third of a beat of a count of their foot; 0.25 by chance.
    concentration: mean resultant length, 0 to 1, of their phases in a pair of steps, the right foot half a turn later.
    """

    plants: int
    on_count: float
    concentration: float


def plant_fit(plants: Plants, tempo: Tempo, begins: int) -> PlantFit:
    """Compares plants with a tempo. begins: the foot on count 1, 0 left or 1 right."""
    on_count = float(np.mean(np.abs(plant_errors(plants, tempo, begins)) < 1 / 3))
    # Three pairs of steps in eight counts. Phases of single beats would spread even for a perfect dancer, since three
    # steps take four beats.
    turns = 3 * tempo.counts(plants.seconds) / CYCLE + 0.5 * (plants.foot != begins)
    return PlantFit(len(plants.seconds), on_count, float(np.abs(np.exp(2j * np.pi * turns).mean())))
