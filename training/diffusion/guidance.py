"""Classifier-free guidance (paper 3.5): after sampling, as the page does it, and at every step, as the paper does.

The paper applies Eq. 9 to every prediction. Once the first steps agree on a dance, conditional and unconditional
predictions are alike, so the result hardly moves, and every change of a weight costs a sampling. Applied once, to
latents that were sampled from the same noise, the same equation acts over its whole range and needs no network pass.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor

from training.denoiser.denoiser import Denoiser


@dataclass(frozen=True, eq=False)
class Branches:
    """Latents (..., L, R, C) of one dance that were sampled from the same noise under three conditions, and the mean
    over several noises."""

    conditional: Tensor  # leader and song
    silent: Tensor  # the leader without a song
    unconditional: Tensor  # neither
    mean: Tensor  # of the conditional latents of several seeds


def blend(branches: Branches, coarse: Tensor, music: float, variety: float) -> Tensor:
    """Eq. 9 on sampled latents, with a term for the song (Liu et al. 2022, guidance by a single condition) and one
    for the distance from other seeds:

        x = cond + m (cond - silent), in the coarse layer + s (cond - uncond) + (v - 1) (cond - mean)

    coarse: s, broadcastable to a layer (..., L, C). music: m. variety: v. Returns (..., L, R, C). The fine layer's
    guidance acts where latents are decoded, see `layer_gains`.
    """
    conditional = branches.conditional
    change = conditional - branches.silent
    x = conditional + music * change
    away = coarse[..., None, :] * (conditional - branches.unconditional)[..., :1, :]
    away = away + (variety - 1) * (conditional - branches.mean)[..., :1, :]
    return torch.cat([x[..., :1, :] + away, x[..., 1:, :]], dim=-2)


def per_channel(values: Tensor, channels: int) -> Tensor:
    """(C,) of values (S,), one for each stream: the channels of a layer are its streams' one after the other."""
    return values[:, None].expand(-1, channels // len(values)).flatten()


def layer_gains(fine: Tensor, layers: int) -> Tensor:
    """(S, R) factors of the residual layers for guidance s of the fine layer (S,) of each stream.

    Eq. 9 between a dance with its fine layer and the same dance without, which the decoder knows from residual
    masking (paper 3.2): (1 + s) fine - s 0.
    """
    coarse = torch.ones(len(fine), 1)
    return torch.cat([coarse, (1 + fine)[:, None].expand(-1, layers - 1)], dim=1)


def clamp_to_range(denoiser: Denoiser, x0: Tensor) -> Tensor:
    """x0 (..., R, C) clamped to the range of the quantiser: the decoder has never seen a latent beyond it.

    Static thresholding, Saharia et al. 2022 (Imagen), section 2.3.
    """
    return torch.minimum(torch.maximum(x0, denoiser.lowest), denoiser.highest)


def classifier_free_guidance(
    denoiser: Denoiser,
    x: Tensor,
    time: Tensor,
    memory: Tensor,
    silent: Tensor,
    valid: Tensor,
    guidance: Tensor,
    music_guidance: float,
) -> Tensor:
    """Guidance at every step (Ho and Salimans 2022): Eq. 9 per stream and layer, with a term for the song:

        x0 = (1 + s) cond - s uncond + m (cond - no_music)

    cond is the prediction for leader and music, uncond for neither, no_music for the leader alone; m = 0 leaves Eq. 9.

    x (B, block, R, C), time (1,), memory and silent (B, block, 2 D) with and without a song, valid (B, block),
    guidance s (S, R). Returns x0 (B, block, R, C), clamped to the quantiser's range. The coarse layer is combined
    from coarse predictions alone, so no fine weight reaches it.
    """
    ones = torch.ones(len(x), denoiser.layers)
    keep = torch.cat([ones, 0 * ones, ones])
    predictions = denoiser(
        torch.cat([x, x, x]), time, torch.cat([memory, memory, silent]), valid.repeat(3, 1), keep, keep
    )
    cond, uncond, no_music = predictions.chunk(3)
    s = torch.stack([per_channel(layer, denoiser.latent_width) for layer in guidance.T])  # (R, C)
    return clamp_to_range(denoiser, cond + s * (cond - uncond) + music_guidance * (cond - no_music))
