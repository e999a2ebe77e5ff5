"""Teach the mirror network of a trained autoencoder what the autoencoder itself would answer: the last of stage 1."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import torch
import torch.nn.functional as F
from torch import Tensor
from torch.optim import AdamW
from torch.optim.lr_scheduler import OneCycleLR

from training.hfsq.autoencoder import Autoencoder
from training.streams import mirrored

Streams = Sequence[Tensor]


@dataclass(frozen=True)
class MirrorTraining:
    windows: int = 2000
    steps: int = 1500
    batch: int = 64
    learning_rate: float = 1.5e-3


@torch.no_grad()
def encoded(model: Autoencoder, streams: Streams) -> Tensor:
    """Normalised latents (N, L, R, C)."""
    return model.normalise(model.encode(streams))


@torch.no_grad()
def mirrored_by_decoding(model: Autoencoder, latents: Tensor) -> Tensor:
    """Coarse latents (N, L, C) of what normalised latents (N, L, R, C) decode to, seen in a mirror."""
    return encoded(model, mirrored(model.decode(model.denormalise(latents))))[:, :, 0]


def between(latents: Tensor) -> Tensor:
    """Half of the windows (N, ...) as they are, the others on their way to another one: what sampling predicts at first
    lies between dances.
    """
    n = len(latents)
    share = torch.rand(n).masked_fill(torch.rand(n) < 0.5, 1.0).view(-1, *[1] * (latents.dim() - 1))
    return share * latents + (1 - share) * latents[torch.randperm(n)]


def learn_mirror(
    model: Autoencoder, windows: Callable[[int], Streams], training: MirrorTraining
) -> list[float]:
    """Train `model.mirror` in place, the rest stays as it is; `windows(n)` draws n windows of streams in metres.

    Returns the loss of every step: mean squared error in standard deviations of the coarse latents.
    """
    seen, wanted = [], []
    for _ in range(0, training.windows, training.batch):
        latents = between(encoded(model, windows(training.batch)))
        seen.append(latents[:, :, 0])
        wanted.append(mirrored_by_decoding(model, latents))
    x, y = torch.cat(seen), torch.cat(wanted)
    mirror = model.mirror.train().requires_grad_(True)
    optimizer = AdamW(mirror.parameters(), training.learning_rate)
    schedule = OneCycleLR(optimizer, training.learning_rate, training.steps)
    losses = []
    for step in range(1, training.steps + 1):
        chosen = torch.randint(len(x), (training.batch,))
        loss = F.mse_loss(mirror(x[chosen]), y[chosen])
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
        schedule.step()
        losses.append(float(loss.detach()))
        if step % 100 == 0:
            print(f"mirror: step {step} of {training.steps}, error {losses[-1]:.4f}", flush=True)
    mirror.eval().requires_grad_(False)
    return losses


@torch.no_grad()
def mirror_fit(model: Autoencoder, streams: Streams) -> float:
    """Share of the variance of a mirrored dance's coarse latents that `model.mirror` explains; streams (1, T, c)."""
    latents = encoded(model, streams)
    wanted = mirrored_by_decoding(model, latents)
    error = (model.mirror(latents[:, :, 0]) - wanted).square().mean()
    return float(1 - error / wanted.var())
