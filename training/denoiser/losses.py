"""Losses of stage 2: Eq. 6 on latents, and Eq. 7's kinematic, contact and orientation terms on decoded motion."""

from __future__ import annotations

import torch
from torch import Tensor

from training.config import DenoiserLossConfig
from training.denoiser.windows import Batch
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.losses import energy_loss, kinematic
from training.motion.heading import hip_heading
from training.motion.rigid_body import rigid_body
from training.motion.skeleton import FEET
from training.motion.streams import from_streams

CONTACT_STEP = 0.01  # metres per frame; a foot that moves less stands (EDGE)
SNR_CAP = 5.0  # Hang et al. 2023, Efficient Diffusion Training via Min-SNR Weighting Strategy


def noise_weights(alpha_bar: Tensor, share: float) -> Tensor:
    """(N,) weights with mean 1 for windows of that alpha bar: a `share` of them grows with signal over noise.

    Predicting x0 from much noise has the largest error, so an unweighted loss is spent there; what little
    noise hides, the detail of a motion, would stay blurred.
    """
    snr = (alpha_bar / (1 - alpha_bar)).clamp_max(SNR_CAP)
    return 1 - share + share * snr / snr.mean()


def simple_loss(
    truth: Tensor, predicted: Tensor, valid: Tensor, weights: tuple[float, ...], windows: Tensor
) -> tuple[Tensor, Tensor]:
    """Eq. 6. truth, predicted (N, L, R, C) normalised; valid (N, L); weights of the layers and of the windows
    (N,). Returns the loss and the layers' errors (R,).
    """
    error = (truth - predicted).square().mean(-1) * valid[..., None]
    layers = (error * windows[:, None, None]).sum((0, 1)) / valid.sum()
    return (layers * layers.new_tensor(weights)).sum(), layers.detach()


def decoded_windows(hfsq: Autoencoder, latents: Tensor, batch: Batch, rows: list[int]) -> Tensor:
    """World joints (n, T, 22, 3) of normalised latents (n, block, R, C) for those rows of the batch."""
    decoded = hfsq.decode(hfsq.denormalise(latents))
    upper, lower, placement = (s.float().flatten(0, 1) for s in decoded)
    leader, heading = batch.leader[rows].flatten(0, 1), batch.heading[rows].flatten(0, 1)
    joints = from_streams(upper, lower, placement, leader, heading)
    # Not raised to the floor: feet under it would be held at one height, and the contact loss would favour them.
    return rigid_body(joints.unflatten(0, (len(rows), -1)), floor=False)


def orientation_loss(leader: Tensor, truth: Tensor, predicted: Tensor) -> Tensor:
    """Squared difference of (cos, sin) of the yaw between the partners; finite when they face each other.

    The relative yaw of unit directions l and r is the rotation (l . r, l x r), so no angle is ever divided.
    """
    leader_heading = hip_heading(leader)

    def relative(joints: Tensor) -> Tensor:
        heading = hip_heading(joints)
        dot = (leader_heading * heading).sum(-1)
        cross = leader_heading[..., 0] * heading[..., 1] - leader_heading[..., 1] * heading[..., 0]
        return torch.stack([dot, cross], dim=-1)

    return (relative(truth) - relative(predicted)).square().sum(-1).mean(1)


def contact_loss(truth: Tensor, predicted: Tensor) -> Tensor:
    """(N,) mean speed in cm per frame of predicted feet where the true foot stands. motions (N, T, 22, 3)."""
    feet = list(FEET)
    stands = (truth[:, :, feet].diff(dim=1).norm(dim=-1) < CONTACT_STEP).to(predicted.dtype)
    speed = (predicted[:, :, feet].diff(dim=1).square().sum(-1) + 1e-10).sqrt() * 100
    return (speed * stands).sum((1, 2)) / stands.sum((1, 2)).clamp_min(1)


def motion_loss(
    leader: Tensor, truth: Tensor, predicted: Tensor, signal: Tensor, config: DenoiserLossConfig
) -> dict[str, Tensor]:
    """Terms of Eq. 7 on world joints (N, T, 22, 3), each weighted by signal (N,) = alpha bar.

    Decoded geometry at high noise would pull ambiguous poses to their mean, so noisy windows count for
    little.
    """
    weights = (1.0, config.velocity, config.acceleration)
    per_window = torch.stack(
        [kinematic(t[None], p[None], weights) for t, p in zip(truth, predicted, strict=True)]
    )
    return {
        "kinematic": config.kinematic * (per_window * signal).mean(),
        "contact": config.contact * (contact_loss(truth, predicted) * signal).mean(),
        "energy": config.energy * (energy_loss(truth, predicted) * signal).mean(),
        "orientation": config.orientation * (orientation_loss(leader, truth, predicted) * signal).mean(),
    }
