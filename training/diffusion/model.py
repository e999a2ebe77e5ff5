"""A trained model as inference sees it: one interface, here with PyTorch behind it, in export/runtime.py with
onnxruntime.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from torch import Tensor

from training.config import DiffusionConfig, FrameConfig
from training.denoiser.denoiser import Denoiser
from training.diffusion.decode import decode
from training.diffusion.guidance import clamp_to_range
from training.diffusion.schedule import Step, alphas_cumprod, ddim_steps
from training.hfsq.autoencoder import Autoencoder
from training.motion.leader_frame import smoothed_heading
from training.motion.streams import leader_features


@dataclass(frozen=True)
class Sampling:
    """Sizes of a model and the defaults that it is sampled with."""

    block: int  # latent frames
    layers: int  # R
    channels: int  # C, of one layer
    alpha_bar: np.ndarray  # (train_steps,), the noise schedule
    last_time: float  # of the last step, a share of the training timesteps
    extrapolation: tuple[float, ...]  # (S,) of the last prediction, see `extrapolated_ddim`
    stitching: bool  # blocks overlap by half and cross-fade
    steps: int
    guidance: tuple[float, float]  # Eq. 9's s of the coarse and the fine layer
    music_guidance: float  # m of `blend`
    variety: float  # v of `blend`
    mean_seeds: int  # seeds 0, 1, ... whose mean variety is measured from
    reference_height: float  # metres, `body_height` of the leaders that the model knows

    def ddim(self, steps: int | None = None) -> list[Step]:
        """The model's own steps, or as many as are asked for, see `ddim_steps`."""
        return ddim_steps(self.alpha_bar, self.steps if steps is None else steps, self.last_time)


class ReactionModel(Protocol):
    """The three functions of a model. All motions are at its reference height, T = 4 L."""

    @property
    def sampling(self) -> Sampling: ...

    def condition(self, leader: Tensor, music: Tensor, music_valid: Tensor, role: Tensor) -> Tensor:
        """Memory (L, 2 D) of leader (T, 22, 3) metres, music (T, F), music_valid (T,) and role (1,)."""
        ...

    def unfamiliarity(self, leader: Tensor) -> Tensor:
        """(L,) how far a leader (T, 22, 3) metres is from those of training, see `ConditionEncoder.unfamiliarity`."""
        ...

    def predict(self, x: Tensor, memory: Tensor, valid: Tensor, keep: Tensor, time: Tensor) -> Tensor:
        """Clean latents x0 (B, block, R, C), clamped to the quantiser's range, of noisy ones x (B, block, R, C).

        memory (B, block, 2 D), valid (B, block); keep (1,): 1 with leader and song as they are in the memory, 0
        without both; time (1,): timestep over the number of training timesteps.
        """
        ...

    def decode(self, latents: Tensor, leader: Tensor, gains: Tensor, role: Tensor) -> Tensor:
        """Joints (T, 22, 3) metres of normalised latents (L, R, C). gains (S, R) multiplies each stream's layers;
        role (1,): whose body dances.
        """
        ...


@dataclass(frozen=True)
class Model:
    """A trained pair of stages under PyTorch."""

    hfsq: Autoencoder
    frame: FrameConfig
    denoiser: Denoiser
    diffusion: DiffusionConfig
    reference_height: float

    @property
    def sampling(self) -> Sampling:
        config = self.diffusion
        return Sampling(
            block=self.denoiser.config.block,
            layers=self.denoiser.layers,
            channels=self.denoiser.latent_width,
            alpha_bar=alphas_cumprod(config),
            last_time=config.last_time,
            extrapolation=config.extrapolation,
            stitching=config.stitching,
            steps=config.steps,
            guidance=config.guidance,
            music_guidance=config.music_guidance,
            variety=config.variety,
            mean_seeds=config.mean_seeds,
            reference_height=self.reference_height,
        )

    def condition(self, leader: Tensor, music: Tensor, music_valid: Tensor, role: Tensor) -> Tensor:
        features = leader_features(leader, smoothed_heading(leader, self.frame))
        return self.denoiser.condition(features[None], music[None], music_valid[None], role)[0]

    def unfamiliarity(self, leader: Tensor) -> Tensor:
        features = leader_features(leader, smoothed_heading(leader, self.frame))
        return self.denoiser.condition.unfamiliarity(features[None])[0]

    def predict(self, x: Tensor, memory: Tensor, valid: Tensor, keep: Tensor, time: Tensor) -> Tensor:
        # Written so that the exported graph needs no shape arithmetic.
        every = (valid[:, :1] * 0 + keep).expand(-1, self.denoiser.layers)
        return clamp_to_range(self.denoiser, self.denoiser(x, time, memory, valid, every, every))

    def decode(self, latents: Tensor, leader: Tensor, gains: Tensor, role: Tensor) -> Tensor:
        reactors, leaders = self.denoiser.bodies.square().sum(-1).sqrt()
        bones = reactors + role * (leaders - reactors)
        clamped = clamp_to_range(self.denoiser, latents)
        return decode(self.hfsq, self.frame, self.diffusion, clamped, leader, gains, bones)
