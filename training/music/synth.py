"""Synthesises salsa percussion from sines and noise: clave, conga, bell, maracas, and a bass."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from training.music.tempo import CYCLE, Tempo

# Positions in eighths of the eight counts (0 to 15).
CLAVE_32 = (0, 3, 6, 10, 12)
CLAVE_23 = (2, 4, 8, 11, 14)
_CONGA_OPEN = (6, 7, 14, 15)
_CONGA_SLAP = (2, 10)
_CONGA_SOFT = (0, 1, 3, 4, 5, 8, 9, 11, 12, 13)
_BELL_STRONG = (0, 4, 8, 12)
_BELL_WEAK = (2, 6, 10, 14)
# Bass strokes: among them "2 and", and 4, from which on the bass has the chord of the next bar.
_BASS = (0, 3, 6, 11, 14)
# Root in semitones above the key for each of four cycles of eight counts.
_PROGRESSIONS = ((0, 5, 7, 5), (0, 0, 7, 0), (0, 7, 5, 7), (0, 10, 8, 7))


@dataclass(frozen=True)
class Kit:
    """Timbre, level and density of one arrangement. Levels are amplitudes; 0 leaves an instrument out."""

    clave: float
    conga: float
    bell: float
    maracas: float
    bass: float
    clave_pattern: tuple[int, ...]
    clave_hertz: float
    conga_hertz: float
    bell_hertz: float
    bass_key: int
    """MIDI note of the tonic."""
    progression: tuple[int, ...]
    density: float
    """Share of the soft conga, weak bell and off-beat maracas strokes that are played."""
    looseness: float
    """Standard deviation of a stroke's time, seconds."""
    noise: float
    """Amplitude of the background noise."""
    loudness: float
    """Peak of the finished music."""

    @staticmethod
    def random(rng: np.random.Generator) -> Kit:
        """A random arrangement that has the conga or the bell, which mark the beat."""
        sounding = rng.random(5) < (0.85, 0.85, 0.7, 0.6, 0.8)
        if not (sounding[1] or sounding[2]):
            sounding[rng.integers(1, 3)] = True
        clave, conga, bell, maracas, bass = np.where(sounding, rng.uniform(0.35, 1.0, 5), 0.0)
        return Kit(
            clave=float(clave),
            conga=float(conga),
            bell=float(bell) * 0.6,
            maracas=float(maracas) * 0.5,
            bass=float(bass) * 0.9,
            clave_pattern=CLAVE_32 if rng.random() < 0.5 else CLAVE_23,
            clave_hertz=float(rng.uniform(1800, 2900)),
            conga_hertz=float(rng.uniform(170, 260)),
            bell_hertz=float(rng.uniform(480, 800)),
            bass_key=int(rng.integers(33, 45)),
            progression=_PROGRESSIONS[rng.integers(len(_PROGRESSIONS))],
            density=float(rng.uniform(0.3, 1.0)),
            looseness=float(rng.uniform(0.0, 0.008)),
            noise=float(10 ** rng.uniform(-4.0, -2.3)),
            loudness=float(rng.uniform(0.25, 0.95)),
        )


def midi_hertz(note: float) -> float:
    """Frequency of a MIDI note number, A4 = 69 = 440 Hz."""
    return 440.0 * 2 ** ((note - 69) / 12)


def _seconds(rate: int, duration: float) -> np.ndarray:
    return np.arange(int(rate * duration)) / rate


def _soft_start(rate: int, sound: np.ndarray) -> np.ndarray:
    """The sound (N,), changed in place: faded in over 1 ms, so that it does not begin with a click."""
    rise = min(len(sound), max(1, rate // 1000))
    sound[:rise] *= np.linspace(0, 1, rise)
    return sound


def clave_stroke(rate: int, hertz: float) -> np.ndarray:
    """A stroke of the clave (N,): two inharmonic sines that decay within 40 ms."""
    t = _seconds(rate, 0.12)
    sound = np.sin(2 * np.pi * hertz * t) + 0.3 * np.sin(2 * np.pi * 1.49 * hertz * t)
    return _soft_start(rate, sound * np.exp(-t / 0.022))


def conga_stroke(rate: int, hertz: float, kind: str, rng: np.random.Generator) -> np.ndarray:
    """A stroke of the conga (N,), its pitch falling a little. kind: `open` is long, `slap` short and noisy, `soft`
    short and quiet.
    """
    decay, noise, level = {"open": (0.16, 0.15, 1.0), "slap": (0.035, 0.9, 0.9), "soft": (0.03, 0.35, 0.3)}[
        kind
    ]
    t = _seconds(rate, min(0.6, decay * 6))
    fall = hertz * (t + 0.012 * (1 - np.exp(-t / 0.02)))
    tone = np.sin(2 * np.pi * fall) + 0.35 * np.sin(2 * np.pi * 1.6 * fall) * np.exp(-t / 0.03)
    hit = rng.standard_normal(len(t)) * np.exp(-t / 0.008) * noise
    return _soft_start(rate, level * (tone * np.exp(-t / decay) + hit))


def bell_stroke(rate: int, hertz: float) -> np.ndarray:
    """A stroke of the cow bell (N,): two partials about a fifth apart, each with its third harmonic."""
    t = _seconds(rate, 0.35)
    sound = np.zeros(len(t))
    for ratio, level in ((1.0, 1.0), (1.504, 0.8), (3.0, 0.3), (4.51, 0.2)):
        if ratio * hertz < rate / 2:
            sound += level * np.sin(2 * np.pi * ratio * hertz * t)
    return _soft_start(rate, 0.6 * sound * (0.6 * np.exp(-t / 0.03) + 0.4 * np.exp(-t / 0.12)))


def maracas_stroke(rate: int, rng: np.random.Generator) -> np.ndarray:
    """A stroke of the maracas (N,): high-passed noise that decays within 30 ms."""
    t = _seconds(rate, 0.08)
    noise = np.diff(rng.standard_normal(len(t) + 1))
    return _soft_start(rate, 0.4 * noise * np.exp(-t / 0.018))


def bass_note(rate: int, hertz: float, duration: float) -> np.ndarray:
    """A bass note (N,) of `duration` seconds: harmonics, of which higher ones decay sooner."""
    t = _seconds(rate, duration)
    sound = np.zeros(len(t))
    for k in range(1, 6):
        if k * hertz < rate / 2:
            sound += np.sin(2 * np.pi * k * hertz * t) / k * np.exp(-t * (1.5 + 2.5 * k))
    release = np.minimum(1.0, (duration - t) / 0.02)
    return _soft_start(rate, sound * release)


class Track:
    """A mono signal to which sounds are added. samples: (N,) at `rate` Hz."""

    def __init__(self, rate: int, samples: int) -> None:
        self.rate = rate
        self.samples = np.zeros(samples, dtype=np.float64)

    def add(self, seconds: float, sound: np.ndarray, level: float) -> None:
        """Adds a sound, times `level`, from `seconds` on; what lies outside of the track is cut off."""
        start = round(seconds * self.rate)
        begin, end = max(0, start), min(len(self.samples), start + len(sound))
        if begin < end:
            self.samples[begin:end] += level * sound[begin - start : end - start]


def cycle_starts(tempo: Tempo, duration: float) -> np.ndarray:
    """Seconds (K,) of count 1 of every cycle of eight counts that touches [0, duration); the first is negative."""
    length = CYCLE * 60 / tempo.bpm
    first = tempo.first % length - length
    return first + length * np.arange(int(np.ceil((duration - first) / length)))


def percussion(tempo: Tempo, samples: int, rate: int, kit: Kit, rng: np.random.Generator) -> np.ndarray:
    """Percussion (samples,) at `tempo`, float32 mono at `rate` Hz, with the peak kit.loudness."""
    track = Track(rate, samples)
    eighth = 30 / tempo.bpm
    clave = clave_stroke(rate, kit.clave_hertz)
    bell = bell_stroke(rate, kit.bell_hertz)
    conga = {kind: conga_stroke(rate, kit.conga_hertz, kind, rng) for kind in ("open", "slap", "soft")}
    maracas = [maracas_stroke(rate, rng) for _ in range(4)]

    def play(at: float, sound: np.ndarray, level: float) -> None:
        if level:
            track.add(at + rng.normal(0, kit.looseness), sound, level * rng.uniform(0.8, 1.0))

    def at_random(level: float) -> float:
        return level if rng.random() < kit.density else 0.0

    for cycle, start in enumerate(cycle_starts(tempo, samples / rate)):
        times = start + eighth * np.arange(16)
        for position in kit.clave_pattern:
            play(times[position], clave, kit.clave)
        for kind, positions in (("open", _CONGA_OPEN), ("slap", _CONGA_SLAP)):
            for position in positions:
                play(times[position], conga[kind], kit.conga)
        for position in _CONGA_SOFT:
            play(times[position], conga["soft"], at_random(kit.conga))
        for position in _BELL_STRONG:
            play(times[position], bell, kit.bell)
        for position in _BELL_WEAK:
            play(times[position], bell, at_random(0.6 * kit.bell))
        for position in range(16):
            level = kit.maracas if position % 2 == 0 else 0.5 * at_random(kit.maracas)
            play(times[position], maracas[position % 4], level)
        root = kit.progression[cycle % len(kit.progression)]
        following = kit.progression[(cycle + 1) % len(kit.progression)]
        for position in _BASS:
            semitones = following if position == 14 else root + (7 if position in (3, 11) else 0)
            note = bass_note(rate, midi_hertz(kit.bass_key + semitones), 2.5 * eighth)
            play(times[position], note, kit.bass)

    track.samples += kit.noise * rng.standard_normal(samples)
    peak = np.abs(track.samples).max(initial=1e-9)
    return (track.samples * (kit.loudness / peak)).astype(np.float32)
