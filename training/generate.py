"""Generate the reactor for a leader and a song with a checkpoint, also one of `training.baselines`.

    python -m training.generate --checkpoint training/checkpoints/salsa --leader leader.bvh --song song.mp3 \\
        --out runs/dance

Writes leader.npy and reactor_SEED.npy, (T, 22, 3) metres at 30 fps, y up, which the page reads, and a filmstrip of each
seed. As on the page, the network gets the leader in the body of the training's leaders, which needs Node and the
packages that `npm start` installs; a baseline gets it as it is.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from training.baselines.trained import load_baseline
from training.checkpoint import load_model, read_card
from training.command_line import run_program
from training.config import FPS, check_limits
from training.data.bvh.file import FRAME_RATES
from training.data.bvh.reader import read_bvh
from training.data.npz import read_npy
from training.data.sources import read_duets
from training.diffusion.react import Request, react
from training.evaluation.report.filmstrip import filmstrip
from training.motion.other_body import in_body
from training.music.features import features, load_audio
from training.music.recipe import AudioRecipe

SAMPLING_OPTIONS = ("steps", "coarse", "fine", "music_guidance", "variety")


@dataclass(frozen=True)
class Options:
    checkpoint: Path
    """Folder of a checkpoint."""
    leader: Path
    """A BVH file, the leader.npy of an earlier dance, or any source of duets (then name the duet)."""
    out: Path
    """Folder for the motions and filmstrips."""
    duet: str | None = None
    """Name of the duet whose leader is taken, where --leader holds several."""
    song: Path | None = None
    """An audio file; without one the dance has no music."""
    seeds: tuple[int, ...] = (1204,)
    """One dance is made of each."""
    steps: int | None = None
    """How often the denoiser predicts; the model's default when left out."""
    coarse: float | None = None
    """Guidance of the coarse layer, Eq. 9's s; the model's default when left out."""
    fine: float | None = None
    """Gain of the fine layer, (1 + s) times; the model's default when left out."""
    music_guidance: float | None = None
    """Guidance weight of the music; the model's default when left out."""
    variety: float | None = None
    """Distance from the mean of several seeds; the model's default when left out."""
    fps: float | None = None
    """Frame rate of the BVH file where its header is wrong."""
    leader_as_is: bool = False
    """Give the network the leader as it is, for which Node is not needed; the partner may crouch beside another rig."""

    def __post_init__(self) -> None:
        kind = self.leader.suffix.lower()
        bvh = kind == ".bvh"
        if self.duet is not None and kind in (".bvh", ".npy"):
            raise ValueError("--duet names one of several duets; --leader is a file that holds one dancer")
        if not bvh and self.fps is not None:
            raise ValueError("--fps is the frame rate of a BVH file; --leader is none")
        check_limits(self, fps=FRAME_RATES)
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
    if options.leader.suffix.lower() == ".npy":
        return read_npy(options.leader).motion
    duets = {duet.name: duet for duet in read_duets(options.leader)}
    if options.duet not in duets:
        raise ValueError(f"name one of the duets in {options.leader} with --duet: {', '.join(duets)}")
    return duets[options.duet].leader


Generate = Callable[[np.ndarray | None, int], np.ndarray]
"""The reactor (T, 22, 3) to music (T', 54) and a seed."""


def load_generator(options: Options, leader: np.ndarray) -> Generate:
    """The checkpoint with the weights of the options, beside a leader (T, 22, 3).

    Raises ValueError for a weight that the checkpoint would ignore and as `in_body`, and FileNotFoundError.
    """
    if (options.checkpoint / "baseline.json").exists():
        given = [name for name in SAMPLING_OPTIONS if getattr(options, name) is not None]
        if given:
            flags = ", ".join(f"--{name.replace('_', '-')}" for name in given)
            raise ValueError(
                f"{options.checkpoint} is a baseline, which has no such control: leave {flags} out"
            )
        baseline = load_baseline(options.checkpoint)
        return lambda music, seed: baseline.react(leader, music, seed)
    model = load_model(options.checkpoint)
    known = None if options.leader_as_is else in_body(leader, training_body(options.checkpoint))
    coarse, fine = model.diffusion.guidance
    guidance = (
        coarse if options.coarse is None else options.coarse,
        fine if options.fine is None else options.fine,
    )

    def generate(music: np.ndarray | None, seed: int) -> np.ndarray:
        weights = (options.steps, guidance, options.music_guidance, options.variety)
        return react(model, Request(leader, music, seed, *weights, condition_leader=known))

    return generate


def training_body(checkpoint: Path) -> list[list[float]]:
    """Rest offsets (22, 3), metres, of the training's leaders. Raises ValueError where the checkpoint has none."""
    bodies = read_card(checkpoint).get("training_bodies")
    if bodies is None:
        raise ValueError(f"{checkpoint}/card.json has no training_bodies: add --leader-as-is")
    return bodies["leader"]


def main(options: Options) -> None:
    leader = read_leader(options)
    generate = load_generator(options, leader)
    recipe = AudioRecipe()
    music = features(load_audio(options.song, recipe), recipe) if options.song else None

    options.out.mkdir(parents=True, exist_ok=True)
    np.save(options.out / "leader.npy", leader.astype(np.float32))
    for seed in options.seeds:
        reactor = generate(music, seed)
        np.save(options.out / f"reactor_{seed}.npy", reactor.astype(np.float32))
        filmstrip(leader, reactor, options.out / f"reactor_{seed}.png")
        print(f"seed {seed}: {len(reactor) / FPS:.1f} s", flush=True)
    print(f"wrote leader.npy, and a reactor with its filmstrip for each seed, to {options.out}")


if __name__ == "__main__":
    run_program(main, Options)
