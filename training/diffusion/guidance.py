"""Classifier-free guidance per stream and layer (paper 3.5), clamped to the quantiser's range."""

from __future__ import annotations

import torch
from torch import Tensor

from training.config import STREAMS
from training.denoiser.denoiser import Denoiser


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
    valid: Tensor,
    guidance: Tensor,
    music_guidance: Tensor,
) -> Tensor:
    """Classifier-free guidance (Ho and Salimans 2022) per stream and layer, the paper's Eq. 9, with a term for music:

        x0 = (1 + s) cond - s uncond + m (cond - no_music)

    cond is the prediction for leader and music, uncond for neither, no_music for the leader alone. The last term is
    guidance by a single condition (Liu et al. 2022) and not in the paper; m = 0 leaves Eq. 9.

    x (B, block, R, C), time (1,), memory (B, block, 3 D) of `condition`, valid (B, block), guidance s (S, R),
    music_guidance m (1,). Returns x0 (B, block, R, C), clamped to the quantiser's range. The coarse layer is combined
    from coarse predictions alone, so no fine weight reaches it.
    """
    leader, music, silence = memory.chunk(3, dim=-1)
    with_music, without_music = torch.cat([leader, music], dim=-1), torch.cat([leader, silence], dim=-1)
    ones = valid[:, :1].expand(-1, denoiser.layers) * 0 + 1
    keep = torch.cat([ones, ones * 0, ones])
    predictions = denoiser(
        torch.cat([x, x, x]),
        time,
        torch.cat([with_music, with_music, without_music]),
        torch.cat([valid, valid, valid]),
        keep,
        keep,
    )
    # Written so that the exported graph needs no shape arithmetic.
    cond, uncond, no_music = predictions.reshape(3, -1, *predictions.shape[1:]).unbind(0)
    s = guidance.T.repeat_interleave(denoiser.latent_width // len(STREAMS), dim=1)  # (R, C)
    return clamp_to_range(denoiser, cond + s * (cond - uncond) + music_guidance * (cond - no_music))
