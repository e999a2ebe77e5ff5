"""DDIM over blocks (paper 3.4): all blocks of a dance in parallel, whatever computes a prediction."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import torch
from torch import Tensor

from training.diffusion.blocks import gather, overlapping, partition, scatter
from training.diffusion.guidance import Branches, classifier_free_guidance, per_channel
from training.diffusion.model import Model, ReactionModel, Sampling
from training.diffusion.noise import noise
from training.diffusion.schedule import Step

Predict = Callable[[Tensor, Tensor, Tensor, Tensor], Tensor]
"""x (B, block, R, C), memory (B, block, M), valid (B, block) and time (1,) to clean latents x0 (B, block, R, C)."""


def initial_noise(sampling: Sampling, seed: int, frames: int) -> Tensor:
    """Standard normal noise (frames, R, C) of a seed."""
    values = noise(seed, frames, sampling.layers * sampling.channels)
    return torch.from_numpy(values).unflatten(1, (sampling.layers, sampling.channels))


@torch.no_grad()
def sample(
    sampling: Sampling, predict: Predict, memory: Tensor, initial: Tensor, steps: Sequence[Step]
) -> Tensor:
    """Clean normalised latents (L, R, C) for memory (L, M) from standard normal noise (L, R, C).

    All blocks of a step are computed in parallel.
    """
    frames, size = len(memory), sampling.block
    blocks = overlapping(frames, size) if sampling.stitching else partition(frames, size)
    memory_blocks = gather(memory, blocks, size)
    valid = gather(torch.ones(frames), blocks, size)

    def predict_all(x: Tensor, step: Step) -> Tensor:
        time = torch.tensor([step.time], dtype=torch.float32)
        return scatter(predict(gather(x, blocks, size), memory_blocks, valid, time), blocks, frames)

    return extrapolated_ddim(predict_all, initial, steps, torch.tensor(sampling.extrapolation))


def extrapolated_ddim(
    predict: Callable[[Tensor, Step], Tensor], initial: Tensor, steps: Sequence[Step], extrapolation: Tensor
) -> Tensor:
    """What DDIM (Song et al. 2021, Eq. 12) makes of noise (..., R, C).

    The last prediction x0 becomes x0 + c (x0 - the one before it), c (S,) of each stream in `extrapolation`, as in a
    multistep solver (Lu et al. 2022, DPM-Solver++). Few steps of a model that is not distilled stop short of where
    many would arrive, with too little energy and too little difference between seeds.
    """
    c = per_channel(extrapolation, initial.shape[-1])
    x, before = initial, initial
    for k, step in enumerate(steps):
        x0 = predict(x, step)
        if 0 < k == len(steps) - 1:
            x0 = x0 + c * (x0 - before)
        x, before = step.a * x + step.b * x0, x0
    return x


def sample_branch(
    model: ReactionModel, memory: Tensor, keep: float, initial: Tensor, steps: Sequence[Step]
) -> Tensor:
    """Latents (L, R, C) without guidance; memory (L, 2 D), keep as in `ReactionModel.predict`."""
    kept = torch.tensor([keep])
    return sample(
        model.sampling,
        lambda x, m, valid, time: model.predict(x, m, valid, kept, time),
        memory,
        initial,
        steps,
    )


def sample_branches(
    model: ReactionModel, memory: Tensor, silent: Tensor, initial: Tensor, steps: Sequence[Step], mean: Tensor
) -> Branches:
    """The branches of `blend`; memory and silent (L, 2 D) are with and without a song, mean is of `sample_mean`."""
    return Branches(
        sample_branch(model, memory, 1.0, initial, steps),
        sample_branch(model, silent, 1.0, initial, steps),
        sample_branch(model, silent, 0.0, initial, steps),
        mean,
    )


def sample_mean(model: ReactionModel, memory: Tensor, steps: Sequence[Step]) -> Tensor:
    """Mean (L, R, C) of the conditional latents of seeds 0, 1, ...; memory (L, 2 D)."""
    noises = (initial_noise(model.sampling, seed, len(memory)) for seed in range(model.sampling.mean_seeds))
    return torch.stack([sample_branch(model, memory, 1.0, noise, steps) for noise in noises]).mean(0)


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

    def predict(x: Tensor, both: Tensor, valid: Tensor, time: Tensor) -> Tensor:
        with_song, without = both.chunk(2, dim=-1)
        return classifier_free_guidance(
            model.denoiser, x, time, with_song, without, valid, guidance, music_guidance
        )

    return sample(model.sampling, predict, torch.cat([memory, silent], dim=-1), initial, steps)
