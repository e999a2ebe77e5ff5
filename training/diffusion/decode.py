"""From sampled latents to the reactor's joints."""

from __future__ import annotations

from torch import Tensor

from training.config import DiffusionConfig, FrameConfig
from training.hfsq.autoencoder import Autoencoder
from training.motion.foot_contact_correction import correct_foot_contact
from training.motion.leader_frame import smoothed_heading
from training.motion.sharpen import sharpen
from training.motion.streams import reactor_motion


def decode(
    hfsq: Autoencoder,
    frame: FrameConfig,
    config: DiffusionConfig,
    latents: Tensor,
    leader: Tensor,
    layers: Tensor,
) -> Tensor:
    """The reactor's joints (4 L, 22, 3), metres at the model's height, of normalised latents (L, R, C).

    leader: (4 L, 22, 3), what the placement stream is relative to. layers: (R,) factor of each residual layer; 0
    leaves it out.
    """
    raw = hfsq.denormalise(latents) * layers[:, None]
    streams = [sharpen(stream[0], config.sharpen) for stream in hfsq.decode(raw[None])]
    motion = reactor_motion(streams, leader, smoothed_heading(leader, frame))
    return correct_foot_contact(motion, config.foot_contact)
