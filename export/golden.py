"""Golden tensors: one whole sampling of the PyTorch model, for every other runtime to be compared with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from training.data.made import made_dancer
from training.diffusion.guidance import blend, layer_gains, per_channel
from training.diffusion.model import Model, ReactionModel
from training.diffusion.sampler import initial_noise, sample_branches, sample_mean
from training.music.recipe import MUSIC_FEATURES


@dataclass(frozen=True)
class Scene:
    """What is sampled: a made leader and made music, so that the tensors are the project's own."""

    frames: int
    seed: int = 7
    silent_from: int | None = None  # motion frame after which there is no song


def inputs(scene: Scene) -> dict[str, np.ndarray]:
    """leader, music, music_valid, role; weights coarse and fine for each stream, and music_guidance."""
    random = np.random.default_rng(scene.seed)
    valid = np.ones(scene.frames, dtype=np.float32)
    if scene.silent_from is not None:
        valid[scene.silent_from :] = 0
    return {
        "leader": made_dancer(scene.frames, scene.seed),
        "music": random.normal(size=(scene.frames, MUSIC_FEATURES)).astype(np.float32),
        "music_valid": valid,
        "role": np.zeros(1, dtype=np.float32),
        "coarse": np.array([-0.5, 0.25, 0.75], dtype=np.float32),
        "fine": np.array([0.5, -0.25, 1.0], dtype=np.float32),
        "music_guidance": np.full(1, 1.5, dtype=np.float32),
    }


def sample(model: ReactionModel, given: Mapping[str, Tensor]) -> tuple[Tensor, Tensor]:
    """The branches' latents and their mean (4, L, R, C), and the blended latents (L, R, C), of the inputs together with
    their memory, silent and initial.
    """
    memory, sampling = given["memory"], model.sampling
    steps = sampling.ddim()
    mean = sample_mean(model, memory, steps)
    branches = sample_branches(model, memory, given["silent"], given["initial"], steps, mean)
    latents = blend(
        branches,
        per_channel(given["coarse"], sampling.channels),
        float(given["music_guidance"]),
        variety=1.0,  # the page repeats this sampling as it loads: without the seeds of the mean
    )
    each = torch.stack([branches.conditional, branches.silent, branches.unconditional, branches.mean])
    return each, latents


@torch.no_grad()
def reference(model: Model, scene: Scene) -> dict[str, np.ndarray]:
    """Inputs and everything PyTorch makes of them: memory with and without the song, the
    leader's unfamiliarity (L,), initial noise, the branches'
    latents and their mean (4, L, R, C), the blended latents (L, R, C), the joints (T, 22, 3), and those of the
    coarse layer alone.
    """
    given = inputs(scene)
    tensors = {name: torch.from_numpy(value) for name, value in given.items()}
    sampling = model.sampling
    leader, role, valid = tensors["leader"], tensors["role"], tensors["music_valid"]
    memory, silent = (
        model.condition(leader, tensors["music"], heard, role) for heard in (valid, torch.zeros_like(valid))
    )
    initial = initial_noise(sampling, scene.seed, len(memory))
    branches, latents = sample(model, tensors | {"memory": memory, "silent": silent, "initial": initial})
    gains = layer_gains(tensors["fine"], sampling.layers)
    coarse_alone = layer_gains(torch.full_like(tensors["fine"], -1), sampling.layers)
    return given | {
        "seed": np.array([scene.seed], dtype=np.float32),
        "memory": memory.numpy(),
        "silent": silent.numpy(),
        "unfamiliarity": model.unfamiliarity(leader).numpy(),
        "initial": initial.numpy(),
        "branches": branches.numpy(),
        "latents": latents.numpy(),
        "reactor": model.decode(latents, leader, gains, role).numpy(),
        "coarse_alone": model.decode(latents, leader, coarse_alone, role).numpy(),
    }


def write(path: Path, tensors: dict[str, np.ndarray]) -> None:
    np.savez_compressed(path, **{name: value.astype(np.float32) for name, value in tensors.items()})  # pyright: ignore
