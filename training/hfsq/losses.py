"""Eq. 3-5: kinematic and latent losses of stage 1."""

from __future__ import annotations

from collections.abc import Sequence

import torch
import torch.nn.functional as F
from torch import Tensor

from training.config import STREAMS, HfsqConfig
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.masking import progressive_masking


def kinematic(truth: Tensor, predicted: Tensor, weights: tuple[float, float, float]) -> Tensor:
    """Eq. 4: L1 on positions, velocities and accelerations (metres per frame^k), times 100: centimetres."""
    total = truth.new_zeros(())
    for weight in weights:
        total = total + weight * (truth - predicted).abs().mean() * 100
        truth, predicted = truth.diff(dim=1), predicted.diff(dim=1)
    return total


def energy_loss(truth: Tensor, predicted: Tensor) -> Tensor:
    """(N,) squared logarithm of predicted over true mean speed, acceleration and jerk, mean over joints.

    L1 terms favour a motion that moves too little. The third difference weighs frequencies above 6 Hz.
    motions: (N, T, 22, 3) metres.
    """
    total = truth.new_zeros(len(truth))
    for _ in range(3):
        truth, predicted = truth.diff(dim=1), predicted.diff(dim=1)
        true_speed, speed = ((m.square().sum(-1) + 1e-8).sqrt().mean(1) for m in (truth, predicted))
        total = total + (speed / true_speed).log().square().mean(-1)
    return total


def stage1_loss(
    model: Autoencoder, motions: Sequence[Tensor], slow: Sequence[Tensor], config: HfsqConfig
) -> tuple[Tensor, dict[str, Tensor]]:
    """Eq. 3 summed over the streams. Returns the loss and its parts, detached.

    motions: (N, T, c) metres each; slow: the same without what is above the masking's cutoff, the target of
    windows whose upper layers are hidden. So the base layer learns low frequencies and leaves high ones to the
    layers above, and Eq. 9 can guide the two apart.
    """
    weights = (config.weight_position, config.weight_velocity, config.weight_acceleration)
    parts: dict[str, Tensor] = {}
    total = motions[0].new_zeros(())
    for name, stream, motion, low in zip(STREAMS, model.each, motions, slow, strict=True):
        v = stream.features(motion)
        codes = stream.quantiser(v)
        combined = stream.quantiser.combine(codes)
        # Eq. 5; its two terms have the same value and pull the encoder and the codes towards each other.
        latent = F.mse_loss(v, combined.detach()) + config.beta * F.mse_loss(v.detach(), combined)
        target = motion
        if model.training and config.masking is not None:
            masked, hidden = progressive_masking(codes, config.masking)
            combined = stream.quantiser.combine(masked)
            target = torch.where(hidden[:, None, None], low, motion)
        decoded = stream.decode(combined)
        kin = kinematic(target, decoded, weights)
        energy = energy_loss(*(m.float().unflatten(-1, (-1, 3)) for m in (target, decoded))).mean()
        total = total + kin + config.weight_energy * energy
        total = total + config.weight_latent * latent + stream.quantiser.penalty()
        parts[f"kinematic/{name}"] = kin.detach()
        parts[f"energy/{name}"] = energy.detach()
        parts[f"latent/{name}"] = latent.detach()
    return total, parts
