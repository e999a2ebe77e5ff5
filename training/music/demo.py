"""Makes the demo song: about 35 s of salsa by the project's own synthesiser.

    python -m training.music.demo --out web/public/demo/song.mp3

Percussion comes in one by one, then bass and piano; the piano plays a montuno over a two-bar minor progression.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import soundfile
import tyro
from scipy.signal import fftconvolve

from training.music.synth import CLAVE_23, Kit, Track, bass_note, cycle_starts, midi_hertz, percussion
from training.music.tempo import CYCLE, Tempo

RATE = 44100
# i - iv - V7 - i in A minor, two counts of four each: MIDI notes of the piano's chord for each half of a cycle.
_CHORDS = (
    ((57, 60, 64), (57, 62, 65)),
    ((56, 62, 64), (57, 60, 64)),
    ((57, 60, 64), (57, 62, 65)),
    ((55, 59, 65), (56, 62, 64)),
)
# The bass notes under them.
_ROOTS = ((33, 38), (40, 33), (33, 38), (31, 40))
# Montuno in 2-3 clave, in eighths of the eight counts; on the first it is on the beat, then always off it.
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


def piano_note(rate: int, note: int, seconds: float, loudness: float) -> np.ndarray:
    """A struck string: slightly stretched partials, brighter when loud, each fading at its own pace."""
    t = np.arange(int(rate * (seconds + 0.25))) / rate
    hertz = midi_hertz(note)
    sound = np.zeros(len(t))
    for k in range(1, 13):
        partial = k * hertz * np.sqrt(1 + 0.0004 * k * k)
        if partial < rate / 2:
            level = np.exp(-k * (0.55 - 0.2 * loudness)) * (0.5 if k % 7 == 0 else 1.0)
            sound += level * np.sin(2 * np.pi * partial * t + k) * np.exp(-t * (1.2 + 0.5 * k))
    damper = np.clip((seconds + 0.12 - t) / 0.12, 0, 1)
    return loudness * sound * damper * np.minimum(1, t / 0.002)


def piano(tempo: Tempo, samples: int, from_cycle: int, rng: np.random.Generator) -> np.ndarray:
    """The montuno, from one cycle of eight counts on: (samples,). Octaves outline, inner notes answer."""
    track = Track(RATE, samples)
    eighth = 30 / tempo.bpm
    for cycle, start in enumerate(cycle_starts(tempo, samples / RATE)):
        if cycle < from_cycle:
            continue
        for k, position in enumerate(_MONTUNO):
            # Off-beat strokes already belong to the chord of the half that follows.
            half = (position + 1) // 8
            chord = _CHORDS[(cycle + half // 2) % len(_CHORDS)][half % 2]
            low, middle, high = chord
            notes = (high, high + 12) if k % 2 == 0 else (low + 12, middle + 12)
            if position == 0:
                notes = (low, low + 12, high + 12)
            length = eighth * (0.9 if position % 4 else 1.4)
            at = start + position * eighth + rng.normal(0, 0.003)
            for note in notes:
                track.add(at, piano_note(RATE, note, length, rng.uniform(0.7, 1.0)), 0.3)
    return track.samples


def bass(tempo: Tempo, samples: int, from_cycle: int) -> np.ndarray:
    """Tumbao: (samples,). In every bar the fifth on "2 and", and on 4 already the root of the bar to come."""
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


def room(audio: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """The sound in a small room: a noisy tail of 0.5 s, a tenth as loud."""
    t = np.arange(int(0.5 * RATE)) / RATE
    tail = rng.standard_normal(len(t)) * np.exp(-t / 0.11) * (t > 0.012)
    # Rooms swallow treble: each sample of the tail leans on the one before.
    tail = np.convolve(tail, np.ones(8) / 8, mode="same")
    return audio + 0.16 * fftconvolve(audio, tail / np.sqrt(np.sum(tail**2)))[: len(audio)]


def demo_song(tempo: Tempo, cycles: int, seed: int) -> np.ndarray:
    """(N,) float32 mono at 44100 Hz: so many cycles of eight counts and a last note that rings."""
    rng = np.random.default_rng(seed)
    cycle = CYCLE * 60 / tempo.bpm
    total = int((tempo.first + cycles * cycle + 2.0) * RATE)
    # (from cycle, to cycle, what plays): the arrangement, from clave alone to everybody.
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
    # Bass and piano sit just under the percussion, which carries the beat. cycle_starts begins with the cycle
    # before the first beat, so theirs are counted from 1.
    playing = slice(round((tempo.first + 4 * cycle) * RATE), finish)
    level = np.std(mix[playing])
    for share, line in ((0.75, bass(tempo, total, 3)), (0.6, piano(tempo, total, 3, rng))):
        line[finish:] = 0
        mix += line * (share * level / np.std(line[playing]))
    ending = Track(RATE, total)
    for note in (45, 57, 64, 69, 72, 76):
        ending.add(tempo.first + cycles * cycle, piano_note(RATE, note, 1.4, 0.9), 0.12)
    mix = room(mix + ending.samples, rng)
    # Headroom is left for the ripple that MP3 adds. Gentle saturation holds the peaks together, as a mixing desk would.
    mix = np.tanh(1.6 * mix / np.percentile(np.abs(mix), 99.9))
    mix[-RATE // 2 :] *= np.linspace(1, 0, RATE // 2)
    return (0.75 * mix / np.abs(mix).max()).astype(np.float32)


@dataclass(frozen=True)
class Options:
    """The demo song."""

    out: Path = field(default=Path("web/public/demo/song.mp3"))
    bpm: float = 164.0
    cycles: int = 11
    seed: int = 20


def main(options: Options) -> None:
    song = demo_song(Tempo(options.bpm, 0.35), options.cycles, options.seed)
    options.out.parent.mkdir(parents=True, exist_ok=True)
    # MP3: the one compressed format that every browser decodes and libsndfile writes.
    extra = {"compression_level": 0.35, "bitrate_mode": "VARIABLE"} if options.out.suffix == ".mp3" else {}
    soundfile.write(options.out, song, RATE, **extra)
    print(f"{options.out}: {len(song) / RATE:.1f} s, {options.out.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main(tyro.cli(Options))
