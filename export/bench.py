"""The Python half of `npm run bench`: the same work under onnxruntime native and PyTorch eager, and eager on CUDA.

CUDA is left out where there is none.

    python -m export.bench --checkpoint training/checkpoints/salsa --model web/public/models/salsa --out runs/bench

Writes scene.npz, the leader and the song that the browser half computes with too, and python.json, the seconds.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import TypeVar

import numpy as np
import torch

from export.runtime import open_model
from training.checkpoint import load_model
from training.command_line import run_program
from training.config import STREAMS, STRIDE
from training.data.made import made_dancer
from training.diffusion.model import ReactionModel
from training.diffusion.react import music_of_length, pad_to_stride
from training.diffusion.sampler import initial_noise, sample_branch, sample_branches
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
    threads: int = 2
    repeats: int = 5


def made_song(frames: int, recipe: AudioRecipe) -> np.ndarray:
    """Chords with a click on every beat at 120 BPM, (frames * hop,) float32: every feature varies."""
    random = np.random.default_rng(SEED)
    time = np.arange(frames * recipe.hop) / recipe.sample_rate
    root = np.array([220.0, 174.6, 261.6, 196.0])[(time // 2).astype(int) % 4]
    chord = sum(np.sin(2 * np.pi * root * ratio * time) for ratio in (1, 1.25, 1.5))
    click = random.normal(size=len(time)) * np.exp(-40 * (time % 0.5))
    return (0.1 * chord + 0.5 * click + 0.01 * random.normal(size=len(time))).astype(np.float32)


class Stopwatch:
    """Seconds of named stages, the median of several repeats without the first, which warms up."""

    def __init__(self) -> None:
        self.repeats: dict[str, list[float]] = {}

    @property
    def seconds(self) -> Seconds:
        return {stage: median(times[1:] or times) for stage, times in self.repeats.items()}

    def __call__(self, stage: str, work: Callable[[], T]) -> T:
        start = perf_counter()
        result = work()
        if torch.get_default_device().type == "cuda":
            torch.cuda.synchronize()
        self.repeats.setdefault(stage, []).append(perf_counter() - start)
        return result


@torch.no_grad()
def run(model: ReactionModel, leader: np.ndarray, music: np.ndarray, options: Options) -> Seconds:
    """Seconds of condition, steps of the conditional branch, of all three branches, and decode, on torch's default
    device.
    """
    watch, sampling, device = Stopwatch(), model.sampling, torch.get_default_device()
    padded = torch.from_numpy(pad_to_stride(leader)).to(device)
    features, valid = music_of_length(music, len(padded))
    steps, role = sampling.ddim(), torch.zeros(1)
    gains = torch.ones(len(STREAMS), sampling.layers)
    initial = initial_noise(sampling, SEED, len(padded) // STRIDE).to(device)
    silent = model.condition(padded, torch.zeros_like(features), torch.zeros_like(valid), role)
    for _ in range(1 + options.repeats):
        memory = watch("condition", lambda: model.condition(padded, features, valid, role))
        latents = watch("steps", lambda m=memory: sample_branch(model, m, 1.0, initial, steps))
        watch("branches", lambda m=memory: sample_branches(model, m, silent, initial, steps, torch.zeros(())))
        watch("decode", lambda x=latents: model.decode(x, padded, gains, role))
    return watch.seconds


def main(options: Options) -> None:
    torch.set_num_threads(options.threads)
    options.out.mkdir(parents=True, exist_ok=True)
    recipe = AudioRecipe()
    leader, song = made_dancer(options.frames, SEED).astype(np.float32), made_song(options.frames, recipe)
    np.savez(options.out / "scene.npz", leader=leader, song=song)

    watch = Stopwatch()
    for _ in range(2):  # the first call compiles
        music = watch("features", lambda: features(song, recipe))
    seconds = {
        "onnxruntime native": run(open_model(options.model, options.threads), leader, music, options),
        "PyTorch eager": run(load_model(options.checkpoint), leader, music, options),
    }
    if torch.cuda.is_available():
        model = load_model(options.checkpoint)
        model.hfsq.to("cuda")
        model.denoiser.to("cuda")
        with torch.device("cuda"):
            seconds["PyTorch eager, CUDA"] = run(model, leader, music, options)
    rows = [
        {"backend": name, "threads": options.threads, "seconds": {**watch.seconds, **stages}}
        for name, stages in seconds.items()
    ]
    (options.out / "python.json").write_text(json.dumps(rows))


if __name__ == "__main__":
    run_program(main, Options)
