"""The shipped demo's reaction to its leader, by the model itself, and on demand a new leader by role swap.

    python -m export.demo --model web/public/models/salsa
    node tools/write-bvh.mjs runs/demo/motions.npz web/public/models/salsa/manifest.json runs/demo
    cp runs/demo/reactor.bvh web/public/demo

With `--duet ../shared/data/cmu_salsa/duets.npz salsa_02` a leader is generated for that duet's reactor; no motion of
the duet is written. The leader in web/public/demo was made so by the student's teacher and stays, since the controls
are measured beside it.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from export.runtime import Exported, open_model
from training.command_line import run_program
from training.config import FPS
from training.data.augment import warp_factor, warp_motion
from training.data.bvh.reader import read_bvh
from training.data.duet import Duet
from training.data.sources import read_duets
from training.data.splits import split
from training.data.step_tempo import duet_tempo
from training.diffusion.react import Request, react
from training.evaluation.report.filmstrip import filmstrip
from training.motion.floor import put_on_floor
from training.motion.other_body import in_body
from training.music.demo import Options as Song
from training.music.features import features, load_audio
from training.music.recipe import AudioRecipe
from training.music.tempo import CYCLE, Tempo


@dataclass(frozen=True)
class Options:
    model: Path
    leader: Path = Path("web/public/demo/leader.bvh")
    duet: tuple[Path, str] | None = None
    """Data and a duet of it: a new leader, for this duet's reactor, takes the place of `leader`."""
    song: Path = Path("web/public/demo/song.mp3")
    out: Path = Path("runs/demo")
    seconds: float = 32.0
    skip: int = 1
    """Cycles of eight counts to leave out at the start of the duet, where the couple walks in."""
    leader_seed: int = 6
    """Of the generated leader; this one steps on the beat without a shift."""
    seed: int = 1206
    """Of the first reaction; demo.json names it to the page."""


def on_the_beat(motion: np.ndarray, dance: Tempo, song: Tempo, skip: int, seconds: float) -> np.ndarray:
    """The motion (T, 22, 3) at the song's tempo, cut so that its cycles of eight counts begin with the song's.

    skip: cycles to leave out at the start. seconds: length of the result.
    """
    factor = song.bpm / dance.bpm
    warped = warp_motion(motion, factor)
    first = dance.first / warp_factor(len(motion), factor)
    cycle = CYCLE * 60 / song.bpm
    cut = (first - song.first) % cycle
    start = round((cut + skip * cycle) * FPS)
    return warped[start : start + round(seconds * FPS)]


def new_leader(model: Exported, options: Options, duet: Duet, whole_song: np.ndarray) -> np.ndarray:
    """Generated for the reactor of a duet, (T, 22, 3) in the middle of the floor."""
    song = Tempo(Song.bpm, 0.35)
    partner = on_the_beat(
        duet.reactor, duet_tempo(duet, leader_only=False), song, options.skip, options.seconds
    )
    leader = put_on_floor(
        react(model, Request(partner, whole_song[: len(partner)], options.leader_seed, role=1.0))
    )
    return leader - leader[:, 0].mean(axis=0) * np.array([1, 0, 1])


def main(options: Options) -> None:
    recipe = AudioRecipe()
    whole_song = features(load_audio(options.song, recipe), recipe)
    model = open_model(options.model, threads=1)
    if options.duet:
        data, name = options.duet
        (duet,) = split(read_duets(data), val=(name,), test=()).val
        leader = new_leader(model, options, duet, whole_song)
    else:
        leader = read_bvh(options.leader).motion
    leader = leader.astype(np.float32)
    known = in_body(leader, model.manifest["skeleton"]["training_bodies"]["leader"])
    song = whole_song[: len(leader)]
    reactor = react(model, Request(leader, song, options.seed, condition_leader=known))
    options.out.mkdir(parents=True, exist_ok=True)
    np.savez(options.out / "motions.npz", leader=leader, reactor=reactor, song=whole_song)
    for start in range(0, int(len(leader) / FPS) - 8, 8):
        filmstrip(leader, reactor, options.out / f"from_{start}.png", start=start)
    print(f"{len(leader) / FPS:.1f} s in {options.out}")


if __name__ == "__main__":
    run_program(main, Options)
