"""The reactor to a leader and a song: one function, whatever runs the model."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from training.config import STREAMS, STRIDE
from training.diffusion.guidance import Branches, blend, layer_gains
from training.diffusion.model import Model, ReactionModel
from training.diffusion.sampler import (
    initial_noise,
    sample_branch,
    sample_guided_at_every_step,
    sample_mean,
)
from training.motion.skeleton import body_height
from training.music.recipe import MUSIC_FEATURES


@dataclass(frozen=True, eq=False)
class Request:
    """What a model is asked for. None takes the model's default."""

    leader: np.ndarray  # (T, 22, 3) metres, 30 fps, of any size
    music: np.ndarray | None = None  # (T', F) features; silence where they end, and without them
    seed: int = 0
    steps: int | None = None
    guidance: tuple[float, float] | None = (
        None  # Eq. 9's s of coarse and fine; fine -1 leaves the coarse layer alone
    )
    music_guidance: float | None = None  # m of `blend`
    variety: float | None = None  # v of `blend`
    at_every_step: bool = False  # the paper's form of guidance, for its Table 4; with a `Model` alone
    role: float = 0.0  # 0 dances the reactor, 1 the leader, to a partner in the leader's place
    condition_leader: np.ndarray | None = None  # (T, 22, 3), given to the condition in the leader's place


@torch.no_grad()
def react(model: ReactionModel, request: Request) -> np.ndarray:
    """The reactor (T, 22, 3) metres, as much smaller or taller than the model's reference as the leader is.

    Raises ValueError for guidance at every step with an exported model, or with a variety other than 1.
    """
    sampling = model.sampling
    height = sampling.reference_height
    leader = at_height(request.leader, height)
    conditioning = leader if request.condition_leader is None else at_height(request.condition_leader, height)
    role = torch.tensor([float(request.role)])
    memory, silent = (
        model.condition(conditioning, *music_of_length(music, len(leader)), role)
        for music in (request.music, None)
    )
    coarse, fine = sampling.guidance if request.guidance is None else request.guidance
    weight = sampling.music_guidance if request.music_guidance is None else request.music_guidance
    steps = sampling.ddim(request.steps)
    initial = initial_noise(sampling, request.seed, len(memory))
    variety = sampling.variety if request.variety is None else request.variety
    if request.at_every_step:
        if not isinstance(model, Model):
            raise ValueError("guidance at every step needs a checkpoint, not an exported model")
        if variety != 1:
            raise ValueError(f"guidance at every step has no variety, got {variety:g} instead of 1")
        guidance = torch.tensor([[coarse, fine]] * len(STREAMS))
        latents = sample_guided_at_every_step(model, memory, silent, initial, steps, guidance, weight)
        fine = 0.0
    else:
        conditional = sample_branch(model, memory, 1.0, initial, steps)
        # A branch without weight need not be sampled.
        branches = Branches(
            conditional=conditional,
            silent=sample_branch(model, silent, 1.0, initial, steps) if weight else conditional,
            unconditional=sample_branch(model, silent, 0.0, initial, steps) if coarse else conditional,
            mean=sample_mean(model, memory, steps) if variety != 1 else conditional,
        )
        latents = blend(branches, torch.full((1,), coarse), weight, variety)
    gains = layer_gains(torch.full((len(STREAMS),), fine), sampling.layers)
    reactor = model.decode(latents, leader, gains, role)
    return reactor[: len(request.leader)].numpy() / scale_to(request.leader, height)


def scale_to(motion: np.ndarray, height: float) -> np.float32:
    """The factor that brings a dancer (T, 22, 3) to a height, in metres of `body_height`."""
    return np.float32(height / body_height(motion))


def at_height(motion: np.ndarray, height: float) -> Tensor:
    """A dancer (T, 22, 3) scaled to a height and padded to whole latent frames."""
    return torch.from_numpy(pad_to_stride((motion * scale_to(motion, height)).astype(np.float32)))


def pad_to_stride(motion: np.ndarray) -> np.ndarray:
    """Repeat the last frame until the length is a multiple of 4."""
    missing = -len(motion) % STRIDE
    return np.concatenate([motion, np.repeat(motion[-1:], missing, axis=0)]) if missing else motion


def music_of_length(music: np.ndarray | None, frames: int) -> tuple[Tensor, Tensor]:
    """Features (frames, F), cut or followed by zeros, and (frames,) 1 where there is music."""
    features, valid = torch.zeros(frames, MUSIC_FEATURES), torch.zeros(frames)
    if music is not None:
        count = min(len(music), frames)
        features[:count], valid[:count] = torch.from_numpy(music[:count]).float(), 1
    return features, valid
