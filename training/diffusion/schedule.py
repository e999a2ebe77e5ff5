"""DDPM with a cosine schedule and x0 prediction (paper 3.3), and DDIM as a list of coefficients."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from training.config import DiffusionConfig


def alphas_cumprod(config: DiffusionConfig) -> np.ndarray:
    """alpha bar (train_steps,) float64 of the cosine schedule (Nichol & Dhariwal 2021), betas capped at
    0.999.
    """
    steps = config.train_steps

    def alpha_bar(t: float) -> float:
        return math.cos((t + 0.008) / 1.008 * math.pi / 2) ** 2

    betas = [min(1 - alpha_bar((t + 1) / steps) / alpha_bar(t / steps), 0.999) for t in range(steps)]
    return np.cumprod(1 - np.array(betas))


def add_noise(x0: Tensor, noise: Tensor, alpha_bar: Tensor) -> Tensor:
    """q(x_t | x0); alpha_bar (N,) broadcasts over the rest."""
    shape = (-1, *([1] * (x0.dim() - 1)))
    return alpha_bar.sqrt().view(shape) * x0 + (1 - alpha_bar).sqrt().view(shape) * noise


@dataclass(frozen=True)
class Step:
    """One sampler step: x <- a x + b x0, with x0 predicted at `time`."""

    time: float  # timestep / train_steps
    a: float
    b: float


def ddim_steps(alpha_bar: np.ndarray, count: int, last_time: float) -> list[Step]:
    """Deterministic DDIM (Song et al. 2021, eta = 0) to clean data: `count` steps, evenly spaced from the noisiest
    timestep to `last_time`, a share of the training timesteps.

    Timesteps are counted in whole numbers, so that no rounding differs between languages. Raises ValueError for a time
    out of range, or for more steps than there are timesteps between.
    """
    total = len(alpha_bar)
    if not 1 / total <= last_time <= 1:
        raise ValueError(f"the last time has to be between {1 / total} and 1, got {last_time}")
    way = total - math.floor(last_time * total + 0.5)  # halves go up, as in JavaScript
    if not 1 <= count <= way + 1:
        raise ValueError(f"between 1 and {way + 1} steps, got {count}")
    timesteps = [total - 1 - way * k // max(count - 1, 1) for k in range(count)]
    steps = []
    for k, t in enumerate(timesteps):
        now = alpha_bar[t]
        after = alpha_bar[timesteps[k + 1]] if k + 1 < count else 1.0
        a = math.sqrt((1 - after) / (1 - now))
        steps.append(Step(t / total, a, math.sqrt(after) - a * math.sqrt(now)))
    return steps


def stratified_timesteps(n: int, steps: int, device: torch.device) -> Tensor:
    """(N,) timesteps in rising order, one drawn from each of n equal slices, so that every batch covers all noise
    levels; after the low-discrepancy sampler of Kingma et al. 2021 (Variational Diffusion Models).
    """
    slices = (torch.arange(n, device=device) + torch.rand(n, device=device)) / n
    return (slices * steps).long().clamp_max(steps - 1)
