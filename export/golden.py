"""Golden tensors: one whole sampling of the PyTorch model, for every other runtime to be compared with."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch

from training.config import STREAMS
from training.data.made import made_dancer
from training.diffusion.model import Model
from training.diffusion.sampler import initial_noise, sample
from training.diffusion.schedule import ddim_steps
from training.music.recipe import MUSIC_FEATURES


@dataclass(frozen=True)
class Scene:
    """What is sampled: a made leader and made music, so that the tensors are the project's own."""

    frames: int
    steps: int
    seed: int = 7
    silent_from: int | None = None  # motion frame after which there is no song


def inputs(model: Model, scene: Scene) -> dict[str, np.ndarray]:
    """leader, music, music_valid, role, guidance (different for each stream and layer), music_guidance."""
    random = np.random.default_rng(scene.seed)
    valid = np.ones(scene.frames, dtype=np.float32)
    if scene.silent_from is not None:
        valid[scene.silent_from :] = 0
    guidance = np.linspace(-0.5, 1.5, len(STREAMS) * model.denoiser.layers, dtype=np.float32)
    return {
        "leader": made_dancer(scene.frames, scene.seed),
        "music": random.normal(size=(scene.frames, MUSIC_FEATURES)).astype(np.float32),
        "music_valid": valid,
        "role": np.zeros(1, dtype=np.float32),
        "guidance": guidance.reshape(len(STREAMS), model.denoiser.layers),
        "music_guidance": np.full(1, 1.5, dtype=np.float32),
    }


@torch.no_grad()
def reference(model: Model, scene: Scene, every_step: bool = True) -> dict[str, np.ndarray]:
    """Inputs and everything PyTorch makes of them: memory, initial noise, x and x0 after each step, joints.

    x and x0 are (steps, L, R, C), or the last step alone when `every_step` is off; reactor and coarse are (T, 22, 3).
    """
    given = inputs(model, scene)
    tensors = {name: torch.from_numpy(value) for name, value in given.items()}
    sampling = model.sampling
    memory = model.condition(tensors["leader"], tensors["music"], tensors["music_valid"], tensors["role"])
    initial = initial_noise(sampling, scene.seed, len(memory))
    states: list[tuple[np.ndarray, np.ndarray]] = []
    latents = sample(
        model,
        memory,
        initial,
        ddim_steps(sampling.alpha_bar, scene.steps),
        tensors["guidance"],
        float(given["music_guidance"][0]),
        on_step=lambda _, x, x0: states.append((x.numpy().copy(), x0.numpy().copy())),
    )
    every_layer, only_coarse = torch.ones(sampling.layers), torch.zeros(sampling.layers)
    only_coarse[0] = 1
    kept = states if every_step else states[-1:]
    return given | {
        "seed": np.array([scene.seed], dtype=np.float32),
        "steps": np.array([scene.steps], dtype=np.float32),
        "memory": memory.numpy(),
        "initial": initial.numpy(),
        "x": np.stack([x for x, _ in kept]),
        "x0": np.stack([x0 for _, x0 in kept]),
        "reactor": model.decode(latents, tensors["leader"], every_layer).numpy(),
        "coarse": model.decode(latents, tensors["leader"], only_coarse).numpy(),
    }


def write(path: Path, tensors: dict[str, np.ndarray]) -> None:
    np.savez_compressed(path, **{name: value.astype(np.float32) for name, value in tensors.items()})  # pyright: ignore
