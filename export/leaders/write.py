"""Writes the four leaders that the page offers, at the tempo of its demo song.

    python -m export.leaders.write --model web/public/models/salsa
    node tools/write-bvh.mjs runs/leaders/motions.npz web/public/models/salsa/manifest.json web/public/leaders

With a model a partner is generated for each of them, and filmstrips show both. No recorded motion is used.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from export.leaders.body import joints_of
from export.leaders.dances import DANCES
from export.leaders.steps import Dance
from training.command_line import run_program
from training.config import FPS
from training.music.demo import Options as Song
from training.music.features import features, load_audio
from training.music.recipe import AudioRecipe

FIRST = 0.35
"""Seconds of the first beat of the demo song."""
ENDING = 1.0
"""Seconds after the last eight counts."""


@dataclass(frozen=True)
class Options:
    out: Path = Path("runs/leaders")
    model: Path | None = None
    """Folder of an exported model, for partners and filmstrips."""
    song: Path = Path("web/public/demo/song.mp3")
    seed: int = 1206
    """Of the partners."""


def leader(name: str) -> np.ndarray:
    """(T, 22, 3) metres of one of `DANCES`; over its whole length the dancer stays about the middle of the floor."""
    dance = Dance()
    tell, seed = DANCES[name]
    tell(dance)
    frames = round((FIRST + dance.count * 60 / Song.bpm + ENDING) * FPS)
    motion = joints_of(dance, Song.bpm, FIRST, frames, seed=seed)
    middle = (motion[:, 0].max(axis=0) + motion[:, 0].min(axis=0)) / 2
    return (motion - middle * [1, 0, 1]).astype(np.float32)


def main(options: Options) -> None:
    motions = {name: leader(name) for name in DANCES}
    options.out.mkdir(parents=True, exist_ok=True)
    np.savez(options.out / "motions.npz", **motions)  # type: ignore[arg-type]
    for name, motion in motions.items():
        print(f"{name}: {len(motion) / FPS:.1f} s")
    if options.model is not None:
        partners(options, motions, options.model)


def partners(options: Options, motions: dict[str, np.ndarray], folder: Path) -> None:
    """Filmstrips of the leaders with generated partners, which get them as on the page: in the body of the training."""
    from export.runtime import open_model
    from training.diffusion.react import Request, react
    from training.evaluation.report.filmstrip import filmstrip
    from training.motion.other_body import in_body

    model = open_model(folder, threads=1)
    recipe = AudioRecipe()
    music = features(load_audio(options.song, recipe), recipe)
    for name, motion in motions.items():
        known = in_body(motion, model.manifest["skeleton"]["training_bodies"]["leader"])
        reactor = react(model, Request(motion, music, options.seed, condition_leader=known))
        for start in range(0, int(len(motion) / FPS) - 4, 8):
            filmstrip(motion, reactor, options.out / f"{name}_{start}.png", start=start, seconds=6, poses=14)


if __name__ == "__main__":
    run_program(main, Options)
