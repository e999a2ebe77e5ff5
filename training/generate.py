"""Generate the reactor for a leader and a song with a checkpoint.

    python -m training.generate --checkpoint training/checkpoints/salsa --leader leader.bvh --song song.mp3 \\
        --out runs/dance
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from training.checkpoint import load_model
from training.command_line import run_program
from training.config import FPS
from training.data.bvh.reader import read_bvh
from training.data.sources import read_duets
from training.diffusion.react import Request, react
from training.evaluation.report.filmstrip import filmstrip
from training.music.features import features, load_audio
from training.music.recipe import AudioRecipe


@dataclass(frozen=True)
class Options:
    checkpoint: Path
    leader: Path
    """A BVH file, or any source of duets (then name the duet)."""
    out: Path
    """Folder for reactor.npz and the filmstrip."""
    duet: str | None = None
    song: Path | None = None
    seeds: tuple[int, ...] = (1204,)
    steps: int | None = None
    coarse: float | None = None
    """Guidance of the coarse layer, Eq. 9's s; the model's default when left out."""
    fine: float | None = None
    music_guidance: float | None = None
    """Guidance weight of the music; the model's default when left out."""
    variety: float | None = None
    """Distance from the mean of several seeds; the model's default when left out."""
    fps: float | None = None
    """Frame rate of the BVH file where its header is wrong."""

    def __post_init__(self) -> None:
        bvh = self.leader.suffix.lower() == ".bvh"
        if bvh and self.duet is not None:
            raise ValueError("--duet names one of several duets; a BVH file holds one dancer")
        if not bvh and self.fps is not None:
            raise ValueError("--fps is the frame rate of a BVH file; --leader is none")
        if self.song is None and self.music_guidance is not None:
            raise ValueError("--music-guidance weighs a song, which was not given: add --song")
        if not self.seeds:
            raise ValueError("no dance to make: give one or more --seeds")
        weights = (self.coarse, self.fine, self.music_guidance, self.variety)
        if not all(weight is None or math.isfinite(weight) for weight in weights):
            raise ValueError("weights of guidance are finite numbers")


def read_leader(options: Options) -> np.ndarray:
    """(T, 22, 3) metres, 30 fps."""
    if options.leader.suffix.lower() == ".bvh":
        return read_bvh(options.leader, fps=options.fps).motion
    duets = {duet.name: duet for duet in read_duets(options.leader)}
    if options.duet not in duets:
        raise ValueError(f"name one of the duets in {options.leader} with --duet: {', '.join(duets)}")
    return duets[options.duet].leader


def main(options: Options) -> None:
    model = load_model(options.checkpoint)
    leader = read_leader(options)
    recipe = AudioRecipe()
    music = features(load_audio(options.song, recipe), recipe) if options.song else None
    coarse, fine = model.diffusion.guidance
    guidance = (
        coarse if options.coarse is None else options.coarse,
        fine if options.fine is None else options.fine,
    )

    options.out.mkdir(parents=True, exist_ok=True)
    made: dict[str, np.ndarray] = {}
    for seed in options.seeds:
        request = Request(
            leader, music, seed, options.steps, guidance, options.music_guidance, options.variety
        )
        reactor = react(model, request)
        made[f"seed_{seed}/leader"], made[f"seed_{seed}/follower"] = leader, reactor
        filmstrip(leader, reactor, options.out / f"seed_{seed}.png")
        print(f"seed {seed}: {len(reactor) / FPS:.1f} s", flush=True)
    np.savez_compressed(options.out / "reactor.npz", **made)  # pyright: ignore[reportArgumentType]
    print(f"wrote {options.out / 'reactor.npz'} and a filmstrip for each seed")


if __name__ == "__main__":
    run_program(main, Options)
