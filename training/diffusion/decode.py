"""From sampled latents to the reactor's joints."""

from __future__ import annotations

from torch import Tensor

from training.config import DiffusionConfig, FrameConfig
from training.hfsq.autoencoder import Autoencoder
from training.motion.foot_contact_correction import correct_foot_contact
from training.motion.leader_frame import smoothed_heading, smoothed_root
from training.motion.rigid_body import rigid_body, steady_bones
from training.motion.streams import from_streams

# Latent frames on each side of a part of a clip that its decoded joints depend on: the iterations of the foot-contact
# correction reach farthest, and fade. Beyond it 2e-5 m is left beside made leaders, up to 1e-3 m where a foot is held
# at the very end of a part.
RECEPTIVE_FIELD = 48


def decode(
    hfsq: Autoencoder,
    frame: FrameConfig,
    config: DiffusionConfig,
    latents: Tensor,
    leader: Tensor,
    gains: Tensor,
    bones: Tensor,
) -> Tensor:
    """The reactor's joints (4 L, 22, 3), metres at the model's height, of normalised latents (L, R, C).

    leader: (4 L, 22, 3), to whose smoothed place the placement stream is relative. gains: (S, R) factor of each
    residual layer of each stream; 0 leaves it out. bones: (22,) metres, the lengths to give them.
    """
    joints = decoded_joints(hfsq, frame, latents, leader, gains)
    motion = rigid_body(steady_bones(joints[None], bones), bones)[0]
    return correct_foot_contact(motion, config.foot_contact)


def decoded_joints(
    hfsq: Autoencoder, frame: FrameConfig, latents: Tensor, leader: Tensor, gains: Tensor
) -> Tensor:
    """Joints (4 L, 22, 3), metres, as the networks decode them: bones change their lengths, feet slide."""
    raw = hfsq.denormalise(latents) * gains.T.repeat_interleave(hfsq.stream_latent, dim=1)
    upper, lower, placement = (stream[0] for stream in hfsq.decode(raw[None]))
    return from_streams(upper, lower, placement, smoothed_root(leader), smoothed_heading(leader, frame))
