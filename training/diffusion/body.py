"""The bodies that a model dances with: one for each role, the same in every dance."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import torch
import torch.nn.functional as F
from torch import Tensor

from training.config import STREAMS
from training.diffusion.decode import decoded_joints
from training.diffusion.model import Model
from training.diffusion.react import at_height, music_of_length, scale_to
from training.diffusion.sampler import initial_noise, sample_branch
from training.motion.rest_pose import rest_offsets
from training.motion.rigid_body import bone_lengths, rigid_body, steady_bones


def set_bodies(model: Model, leaders: Sequence[np.ndarray], reactors: Sequence[np.ndarray]) -> None:
    """Measures the denoiser's `bodies`: of role 0, the reactor, on dances that the model makes beside leaders, and of
    role 1, the leader, beside reactors, all (T, 22, 3) metres.

    A student keeps the bodies of its teacher, and a denoiser those of the decoders that it was trained beside; bones of
    the shipped model as it decodes them now differ from them by at most 3 mm.
    """
    bodies = [measure_body(model, partners, role) for role, partners in enumerate((leaders, reactors))]
    model.denoiser.bodies.copy_(torch.stack(bodies))


def mean_bodies(
    leaders: Sequence[np.ndarray], reactors: Sequence[np.ndarray], height: float
) -> dict[str, np.ndarray]:
    """By role the mean rest offsets (22, 3) of captured dancers (T, 22, 3), each scaled to a height, metres of
    `body_height`. A leader is given to a model as danced by this body: the network has seen few others.
    """
    return {
        role: np.mean([rest_offsets(motion * scale_to(motion, height)) for motion in motions], axis=0)
        for role, motions in (("leader", leaders), ("reactor", reactors))
    }


@torch.no_grad()
def measure_body(model: Model, partners: Sequence[np.ndarray], role: int) -> Tensor:
    """Rest offsets (22, 3), metres at the model's height, of the dancer of a role beside partners (T, 22, 3). Without
    music: songs change the bones by a millimetre.

    The bones have their mean lengths as decoded, which are shorter than the true ones: where a decoder is unsure of a
    direction it shortens the bone. The shorter arm errs less.
    """
    dances = [decoded_dance(model, partner, role) for partner in partners]
    lengths = bone_lengths(torch.cat(dances)[None])[0].mean(0)
    rigid = [rigid_body(steady_bones(dance[None], lengths), lengths)[0] for dance in dances]
    offsets = torch.from_numpy(rest_offsets(torch.cat(rigid).numpy()))
    # Left and right keep lengths of their own: captured feet and forearms differ too.
    return F.normalize(offsets, dim=-1) * lengths[:, None]


@torch.no_grad()
def decoded_dance(model: Model, partner: np.ndarray, role: int) -> Tensor:
    """Joints (T, 22, 3), metres, of a dance as decoded: bones change their lengths."""
    sampling = model.sampling
    leader = at_height(partner, sampling.reference_height)
    memory = model.condition(leader, *music_of_length(None, len(leader)), torch.tensor([float(role)]))
    latents = sample_branch(model, memory, 1.0, initial_noise(sampling, 0, len(memory)), sampling.ddim())
    return decoded_joints(model.hfsq, model.frame, latents, leader, torch.ones(len(STREAMS), sampling.layers))
