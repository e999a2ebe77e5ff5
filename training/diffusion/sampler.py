"""DDIM over blocks (paper 3.4): all blocks of a dance in parallel, whatever computes a step."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import torch
from torch import Tensor

from training.diffusion.blocks import gather, overlapping, partition, scatter
from training.diffusion.guidance import Branches, classifier_free_guidance
from training.diffusion.model import Model, ReactionModel, Sampling
from training.diffusion.noise import noise
from training.diffusion.schedule import Step

OnStep = Callable[[int, Tensor], None]

RunStep = Callable[[Tensor, Tensor, Tensor, Step], Tensor]
"""x (B, block, R, C), memory (B, block, M), valid (B, block) and a step to the next x."""


def initial_noise(sampling: Sampling, seed: int, frames: int) -> Tensor:
    """Standard normal noise (frames, R, C) of a seed."""
    values = noise(seed, frames, sampling.layers * sampling.channels)
    return torch.from_numpy(values).unflatten(1, (sampling.layers, sampling.channels))


@torch.no_grad()
def sample(
    sampling: Sampling,
    run_step: RunStep,
    memory: Tensor,
    initial: Tensor,
    steps: Sequence[Step],
    on_step: OnStep | None = None,
) -> Tensor:
    """Clean normalised latents (L, R, C) for memory (L, M) from standard normal noise (L, R, C).

    All blocks of a step are computed in parallel. `on_step(k, x)` sees the state after each step.
    """
    frames, size = len(memory), sampling.block
    x = initial
    for k, step in enumerate(steps):
        if sampling.stitching:
            blocks = overlapping(frames, size)
        else:
            blocks = partition(frames, size, shifted=sampling.alternating_phase and k % 2 == 1)
        following = run_step(
            gather(x, blocks, size),
            gather(memory, blocks, size),
            gather(torch.ones(frames), blocks, size),
            step,
        )
        x = scatter(following, blocks, frames)
        if on_step is not None:
            on_step(k, x)
    return x


def sample_branch(
    model: ReactionModel, memory: Tensor, keep: float, initial: Tensor, steps: Sequence[Step]
) -> Tensor:
    """Latents (L, R, C) without guidance; memory (L, 2 D), keep as in `ReactionModel.step`."""
    return sample(
        model.sampling,
        lambda x, m, valid, step: model.step(x, m, valid, keep, step),
        memory,
        initial,
        steps,
    )


def sample_branches(
    model: ReactionModel, memory: Tensor, silent: Tensor, initial: Tensor, steps: Sequence[Step]
) -> Branches:
    """The three branches of `blend`; memory and silent (L, 2 D) are with and without a song."""
    return Branches(
        sample_branch(model, memory, 1.0, initial, steps),
        sample_branch(model, silent, 1.0, initial, steps),
        sample_branch(model, silent, 0.0, initial, steps),
    )


def sample_guided_at_every_step(
    model: Model,
    memory: Tensor,
    silent: Tensor,
    initial: Tensor,
    steps: Sequence[Step],
    guidance: Tensor,
    music_guidance: float,
) -> Tensor:
    """Latents (L, R, C) with the paper's form of guidance, for its Table 4; guidance s (S, R)."""

    def run_step(x: Tensor, both: Tensor, valid: Tensor, step: Step) -> Tensor:
        with_song, without = both.chunk(2, dim=-1)
        time = torch.tensor([step.time]).float()
        x0 = classifier_free_guidance(
            model.denoiser, x, time, with_song, without, valid, guidance, music_guidance
        )
        return step.a * x + step.b * x0

    return sample(model.sampling, run_step, torch.cat([memory, silent], dim=-1), initial, steps)
