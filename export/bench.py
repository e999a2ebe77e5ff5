"""The Python half of `npm run bench`: the same work under onnxruntime native and PyTorch eager.

    python -m export.bench --checkpoint training/checkpoints/salsa --model web/public/models/salsa --out /tmp/bench

Writes scene.npz, the leader and the song that the browser half computes with too, and python.json, the seconds.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import TypeVar

import numpy as np
import torch
import tyro

from export.runtime import default_guidance, open_model, plan
from export.runtime import sample as sample_exported
from training.checkpoint import load_model
from training.data.made import made_dancer
from training.diffusion.noise import noise
from training.diffusion.sampler import condition, decode, pad_to_stride, sample
from training.diffusion.schedule import alphas_cumprod, ddim_steps
from training.music.features import features
from training.music.recipe import AudioRecipe

SEED = 1
T = TypeVar("T")
Seconds = dict[str, float]


@dataclass(frozen=True)
class Options:
    checkpoint: Path
    model: Path
    out: Path
    frames: int = 2066
    steps: int = 10
    threads: int = 2
    repeats: int = 3


def made_song(frames: int, recipe: AudioRecipe) -> np.ndarray:
    """Chords with a click on every beat at 120 BPM, (frames * hop,) float32: enough for every feature to be busy."""
    random = np.random.default_rng(SEED)
    time = np.arange(frames * recipe.hop) / recipe.sample_rate
    root = np.array([220.0, 174.6, 261.6, 196.0])[(time // 2).astype(int) % 4]
    chord = sum(np.sin(2 * np.pi * root * ratio * time) for ratio in (1, 1.25, 1.5))
    click = random.normal(size=len(time)) * np.exp(-40 * (time % 0.5))
    return (0.1 * chord + 0.5 * click + 0.01 * random.normal(size=len(time))).astype(np.float32)


class Watch:
    """Seconds of named stages; of several repeats, the fastest, which other programs disturbed least."""

    def __init__(self) -> None:
        self.seconds: Seconds = {}

    def __call__(self, stage: str, work: Callable[[], T]) -> T:
        start = perf_counter()
        result = work()
        taken = perf_counter() - start
        self.seconds[stage] = min(taken, self.seconds.get(stage, taken))
        return result


def inputs(leader: np.ndarray, music: np.ndarray) -> dict[str, np.ndarray]:
    padded = pad_to_stride(leader)
    heard = np.zeros((len(padded), music.shape[1]), dtype=np.float32)
    heard[: len(music)] = music[: len(padded)]
    valid = (np.arange(len(padded)) < len(music)).astype(np.float32)
    return {"leader": padded.astype(np.float32), "music": heard, "music_valid": valid}


def run_native(options: Options, given: dict[str, np.ndarray]) -> Seconds:
    """onnxruntime's own CPU build on the graphs that the browser loads."""
    model, watch = open_model(options.model, options.threads), Watch()
    steps, guidance = plan(model.manifest, options.steps), default_guidance(model.manifest)
    louder = model.manifest["guidance"]["music"]["default"]
    layers = np.ones(len(model.manifest["latent"]["layers"]))
    for _ in range(1 + options.repeats):
        (memory,) = watch("condition", lambda: model.run("condition", **given, role=np.zeros(1)))
        latents = watch("steps", lambda m=memory: sample_exported(model, m, SEED, steps, guidance, louder))
        watch(
            "decode", lambda x=latents: model.run("decode", latents=x, leader=given["leader"], layers=layers)
        )
    return watch.seconds


def run_eager(options: Options, given: dict[str, np.ndarray]) -> Seconds:
    """PyTorch, as the training programs sample."""
    model, watch = load_model(options.checkpoint), Watch()
    leader, music, valid = (torch.from_numpy(given[name]) for name in ("leader", "music", "music_valid"))
    steps = ddim_steps(alphas_cumprod(model.diffusion), options.steps)
    guidance = torch.tensor(model.diffusion.guidance).expand(3, -1)
    layers, width = model.denoiser.layers, model.denoiser.latent_width

    def run_steps(memory: torch.Tensor) -> torch.Tensor:
        initial = torch.from_numpy(noise(SEED, len(memory), layers * width)).unflatten(1, (layers, width))
        return sample(model, memory, initial, steps, guidance, model.diffusion.music)

    for _ in range(1 + options.repeats):
        memory = watch("condition", lambda: condition(model, leader, music, valid))
        latents = watch("steps", lambda m=memory: run_steps(m))
        watch("decode", lambda x=latents: decode(model, x, leader))
    return watch.seconds


def main(options: Options) -> None:
    torch.set_num_threads(options.threads)
    options.out.mkdir(parents=True, exist_ok=True)
    recipe = AudioRecipe()
    leader, song = made_dancer(options.frames, SEED).astype(np.float32), made_song(options.frames, recipe)
    np.savez(options.out / "scene.npz", leader=leader, song=song)

    watch = Watch()
    for _ in range(2):  # the first call compiles
        music = watch("features", lambda: features(song, recipe))
    given = inputs(leader, music)
    native, eager = run_native(options, given), run_eager(options, given)
    rows = [
        {"backend": name, "threads": options.threads, "seconds": {**watch.seconds, **seconds}}
        for name, seconds in (("onnxruntime native", native), ("PyTorch eager", eager))
    ]
    (options.out / "python.json").write_text(json.dumps(rows))


if __name__ == "__main__":
    main(tyro.cli(Options))
