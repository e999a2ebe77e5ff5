"""Synthesises the demo song: about 35 s of salsa.

    python -m training.music.demo --out web/public/demo/song.mp3

Percussion instruments enter one after the other, then bass and piano. The piano plays a montuno over a minor
progression of two bars.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import soundfile
from scipy.signal import fftconvolve

from training.command_line import run_program
from training.music.synth import CLAVE_23, Kit, Track, bass_note, cycle_starts, midi_hertz, percussion
from training.music.tempo import CYCLE, Tempo

RATE = 44100
# MIDI notes of the piano's chords in A minor, one chord for each half of a cycle of eight counts.
_CHORDS = (
    ((57, 60, 64), (57, 62, 65)),
    ((56, 62, 64), (57, 60, 64)),
    ((57, 60, 64), (57, 62, 65)),
    ((55, 59, 65), (56, 62, 64)),
)
# MIDI notes of the bass under them.
_ROOTS = ((33, 38), (40, 33), (33, 38), (31, 40))
# Strokes of the montuno in 2-3 clave, in eighth notes of the eight counts.
_MONTUNO = (0, 2, 3, 5, 7, 9, 11, 13, 15)

_KIT = Kit(
    clave=0.6,
    conga=0.9,
    bell=0.0,
    maracas=0.3,
    bass=0.0,
    clave_pattern=CLAVE_23,
    clave_hertz=2450.0,
    conga_hertz=205.0,
    bell_hertz=580.0,
    bass_key=33,
    progression=(0,),
    density=0.9,
    looseness=0.003,
    noise=0.0,
    loudness=1.0,
)


def piano_note(note: int, seconds: float, loudness: float) -> np.ndarray:
    """A piano note (N,): slightly inharmonic partials, higher ones decay sooner and are louder in loud notes."""
    t = np.arange(int(RATE * (seconds + 0.25))) / RATE
    hertz = midi_hertz(note)
    sound = np.zeros(len(t))
    for k in range(1, 13):
        partial = k * hertz * np.sqrt(1 + 0.0004 * k * k)
        if partial < RATE / 2:
            level = np.exp(-k * (0.55 - 0.2 * loudness)) * (0.5 if k % 7 == 0 else 1.0)
            sound += level * np.sin(2 * np.pi * partial * t + k) * np.exp(-t * (1.2 + 0.5 * k))
    damper = np.clip((seconds + 0.12 - t) / 0.12, 0, 1)
    return loudness * sound * damper * np.minimum(1, t / 0.002)


def piano(tempo: Tempo, samples: int, from_cycle: int, rng: np.random.Generator) -> np.ndarray:
    """The montuno (samples,), from cycle `from_cycle` of eight counts on: octaves and inner notes in turn."""
    track = Track(RATE, samples)
    eighth = 30 / tempo.bpm
    for cycle, start in enumerate(cycle_starts(tempo, samples / RATE)):
        if cycle < from_cycle:
            continue
        for k, position in enumerate(_MONTUNO):
            # A stroke on the last eighth note of a half has the chord of the next half.
            half = (position + 1) // 8
            chord = _CHORDS[(cycle + half // 2) % len(_CHORDS)][half % 2]
            low, middle, high = chord
            notes = (high, high + 12) if k % 2 == 0 else (low + 12, middle + 12)
            if position == 0:
                notes = (low, low + 12, high + 12)
            length = eighth * (0.9 if position % 4 else 1.4)
            at = start + position * eighth + rng.normal(0, 0.003)
            for note in notes:
                track.add(at, piano_note(note, length, rng.uniform(0.7, 1.0)), 0.3)
    return track.samples


def bass(tempo: Tempo, samples: int, from_cycle: int) -> np.ndarray:
    """The tumbao (samples,), from cycle `from_cycle` on: the fifth on "2 and", the root of the next bar on 4."""
    track = Track(RATE, samples)
    eighth = 30 / tempo.bpm
    for cycle, start in enumerate(cycle_starts(tempo, samples / RATE)):
        for half in range(2) if cycle >= from_cycle else ():
            bar = start + 8 * half * eighth
            root = _ROOTS[cycle % len(_ROOTS)][half]
            following = _ROOTS[(cycle + half) % len(_ROOTS)][1 - half]
            if cycle == from_cycle and half == 0:
                track.add(bar, bass_note(RATE, midi_hertz(root), 3 * eighth), 1.0)
            track.add(bar + 3 * eighth, bass_note(RATE, midi_hertz(root + 7), 2.8 * eighth), 0.9)
            track.add(bar + 6 * eighth, bass_note(RATE, midi_hertz(following), 4.5 * eighth), 1.0)
    return track.samples


def add_reverb(audio: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """The sound (N,) plus that of a small room: convolution with 0.5 s of decaying noise, at 0.16 of its level."""
    t = np.arange(int(0.5 * RATE)) / RATE
    tail = rng.standard_normal(len(t)) * np.exp(-t / 0.11) * (t > 0.012)
    # A moving average takes off high frequencies, as walls do.
    tail = np.convolve(tail, np.ones(8) / 8, mode="same")
    return audio + 0.16 * fftconvolve(audio, tail / np.sqrt(np.sum(tail**2)))[: len(audio)]


def demo_song(tempo: Tempo, cycles: int, seed: int) -> np.ndarray:
    """(N,) float32 mono at 44100 Hz: `cycles` cycles of eight counts and a long last chord."""
    rng = np.random.default_rng(seed)
    cycle = CYCLE * 60 / tempo.bpm
    total = int((tempo.first + cycles * cycle + 2.0) * RATE)
    # Arrangement: from cycle, to cycle, and the percussion that plays in them.
    arrangement = (
        (0, 1, replace(_KIT, conga=0.0)),
        (1, 4, _KIT),
        (4, cycles, replace(_KIT, bell=0.45, maracas=0.4)),
    )
    mix = np.zeros(total)
    for begin, end, kit in arrangement:
        level = kit.clave + kit.conga + kit.bell + kit.maracas
        layer = percussion(tempo, total, RATE, replace(kit, loudness=0.3 * level), rng)
        first, last = (round((tempo.first + k * cycle - 0.01) * RATE) for k in (begin, end))
        mix[max(0, first) : last] += layer[max(0, first) : last]
    finish = round((tempo.first + cycles * cycle - 0.01) * RATE)
    # Bass and piano are quieter than the percussion, which has the beat. Their cycle 3 is the fourth: cycle_starts
    # begins with the cycle before the first beat.
    playing = slice(round((tempo.first + 4 * cycle) * RATE), finish)
    level = np.std(mix[playing])
    for share, line in ((0.75, bass(tempo, total, 3)), (0.6, piano(tempo, total, 3, rng))):
        line[finish:] = 0
        mix += line * (share * level / np.std(line[playing]))
    ending = Track(RATE, total)
    for note in (45, 57, 64, 69, 72, 76):
        ending.add(tempo.first + cycles * cycle, piano_note(note, 1.4, 0.9), 0.12)
    mix = add_reverb(mix + ending.samples, rng)
    # tanh compresses peaks; a peak of 0.75 leaves headroom for the overshoot of MP3 coding.
    mix = np.tanh(1.6 * mix / np.percentile(np.abs(mix), 99.9))
    mix[-RATE // 2 :] *= np.linspace(1, 0, RATE // 2)
    return (0.75 * mix / np.abs(mix).max()).astype(np.float32)


@dataclass(frozen=True)
class Options:
    out: Path = field(default=Path("web/public/demo/song.mp3"))
    bpm: float = 164.0
    cycles: int = 11
    """Of eight counts."""
    seed: int = 20


def main(options: Options) -> None:
    song = demo_song(Tempo(options.bpm, 0.35), options.cycles, options.seed)
    options.out.parent.mkdir(parents=True, exist_ok=True)
    # MP3: the one compressed format that every browser decodes and libsndfile writes.
    extra = {"compression_level": 0.35, "bitrate_mode": "VARIABLE"} if options.out.suffix == ".mp3" else {}
    soundfile.write(options.out, song, RATE, **extra)
    print(f"{options.out}: {len(song) / RATE:.1f} s, {options.out.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    run_program(main, Options)
