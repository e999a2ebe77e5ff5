"""Eq. 3-5: kinematic and latent losses of stage 1."""

from __future__ import annotations

from collections.abc import Sequence

import torch.nn.functional as F
from torch import Tensor

from training.config import HfsqConfig
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.masking import progressive_masking


def kinematic(truth: Tensor, predicted: Tensor, weights: tuple[float, float, float]) -> Tensor:
    """Eq. 4: L1 on positions, velocities and accelerations (metres per frame^k), times 100 to speak of centimetres."""
    total = truth.new_zeros(())
    for weight in weights:
        total = total + weight * (truth - predicted).abs().mean() * 100
        truth, predicted = truth.diff(dim=1), predicted.diff(dim=1)
    return total


def stage1_loss(
    model: Autoencoder, motions: Sequence[Tensor], config: HfsqConfig
) -> tuple[Tensor, dict[str, Tensor]]:
    """Eq. 3 summed over the streams. motions: (N, T, c) metres each. Returns the loss and its parts, detached."""
    weights = (config.weight_position, config.weight_velocity, config.weight_acceleration)
    parts: dict[str, Tensor] = {}
    total = motions[0].new_zeros(())
    for name, stream, motion in zip(("upper", "lower", "placement"), model.each, motions, strict=True):
        v = stream.features(motion)
        codes = stream.quantiser(v)
        combined = stream.quantiser.combine(codes)
        # Eq. 5; its two terms have the same value and pull the encoder and the codes towards each other.
        latent = F.mse_loss(v, combined.detach()) + config.beta * F.mse_loss(v.detach(), combined)
        if model.training and config.masking is not None:
            combined = stream.quantiser.combine(progressive_masking(codes, config.masking))
        kin = kinematic(motion, stream.decode(combined), weights)
        total = total + kin + config.weight_latent * latent + stream.quantiser.penalty()
        parts[f"kinematic/{name}"] = kin.detach()
        parts[f"latent/{name}"] = latent.detach()
    return total, parts
