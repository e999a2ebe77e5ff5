"""Statistics of training clips: mean and deviation of streams and latents, and the FSQ bins in use."""

from __future__ import annotations

import torch
from torch import Tensor

from training.config import STRIDE
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.windows import Clip


def set_input_statistics(model: Autoencoder, clips: list[Clip]) -> None:
    """Mean per dimension and one standard deviation per stream, from training clips."""
    for i, stream in enumerate(model.each):
        values = torch.cat([clip.streams[i] for clip in clips])
        stream.mean.copy_(values.mean(0))
        stream.std.copy_(values.std(0).mean())


@torch.no_grad()
def set_latent_statistics(model: Autoencoder, clips: list[Clip]) -> None:
    latents = torch.cat([encode_clip(model, clip)[0] for clip in clips])
    model.latent_mean.copy_(latents.mean(0))
    model.latent_std.copy_(latents.std(0).clamp_min(1e-3))


def encode_clip(model: Autoencoder, clip: Clip) -> Tensor:
    """Latents (1, L, R, C) of a whole clip; up to 3 frames at its end are left out."""
    frames = len(clip) // STRIDE * STRIDE
    return model.encode([s[None, :frames] for s in clip.streams])


@torch.no_grad()
def bins_used(model: Autoencoder, clips: list[Clip]) -> list[float]:
    """Share of FSQ bins that training data uses, per residual layer: little where the residual rounds to zero."""
    latents = torch.cat([encode_clip(model, clip)[0] for clip in clips[: len(clips) // 4 + 1]])
    levels = torch.tensor(model.config.levels * (model.latent_width // len(model.config.levels)))
    shares = []
    for layer in range(model.layers):
        used = [len(latents[:, layer, c].mul(1000).round().unique()) for c in range(model.latent_width)]
        shares.append(float((torch.tensor(used) / levels).mean()))
    return shares
