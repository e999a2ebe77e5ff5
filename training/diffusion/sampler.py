"""Latents of any length from noise, block by block (paper 3.4)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import torch
from torch import Tensor

from training.diffusion.blocks import gather, overlapping, partition, scatter
from training.diffusion.model import ReactionModel, Sampling
from training.diffusion.noise import noise
from training.diffusion.schedule import Step

OnStep = Callable[[int, Tensor, Tensor], None]


def initial_noise(sampling: Sampling, seed: int, frames: int) -> Tensor:
    """Standard normal noise (frames, R, C) of a seed."""
    values = noise(seed, frames, sampling.layers * sampling.channels)
    return torch.from_numpy(values).unflatten(1, (sampling.layers, sampling.channels))


@torch.no_grad()
def sample(
    model: ReactionModel,
    memory: Tensor,
    initial: Tensor,
    steps: Sequence[Step],
    guidance: Tensor,
    music_guidance: float,
    on_step: OnStep | None = None,
) -> Tensor:
    """Clean normalised latents (L, R, C) for memory (L, M) from standard normal noise (L, R, C).

    guidance (S, R) and music_guidance as in `classifier_free_guidance`. All blocks are computed in parallel.
    `on_step(k, x, x0)` sees the state after each step.
    """
    sampling = model.sampling
    frames, size = len(memory), sampling.block
    x = initial
    for k, step in enumerate(steps):
        if sampling.stitching:
            blocks = overlapping(frames, size)
        else:
            blocks = partition(frames, size, shifted=sampling.alternating_phase and k % 2 == 1)
        x_next, x0 = model.step(
            gather(x, blocks, size),
            gather(memory, blocks, size),
            gather(torch.ones(frames), blocks, size),
            step,
            guidance,
            music_guidance,
        )
        x = scatter(x_next, blocks, frames)
        if on_step is not None:
            on_step(k, x, scatter(x0, blocks, frames))
    return x
