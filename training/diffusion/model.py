"""A trained model as inference sees it: one interface, here with PyTorch behind it, in export/runtime.py with
onnxruntime.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import torch
from torch import Tensor

from training.config import STREAMS, DiffusionConfig, FrameConfig, per_layer
from training.denoiser.denoiser import Denoiser
from training.diffusion.decode import decode
from training.diffusion.guidance import classifier_free_guidance
from training.diffusion.schedule import Step, alphas_cumprod
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
    alternating_phase: bool  # every other step begins with half a block
    stitching: bool  # blocks overlap by half and cross-fade
    steps: int
    guidance: tuple[float, ...]  # Eq. 9's s of each layer
    music_guidance: float
    reference_height: float  # metres, `body_height` of the leaders that the model knows


class ReactionModel(Protocol):
    """The three functions of a model. All motions are at its reference height, T = 4 L."""

    @property
    def sampling(self) -> Sampling: ...

    def condition(self, leader: Tensor, music: Tensor, music_valid: Tensor, role: Tensor) -> Tensor:
        """Memory (L, 3 D) of leader (T, 22, 3) metres, music (T, F), music_valid (T,) and role (1,)."""
        ...

    def step(
        self, x: Tensor, memory: Tensor, valid: Tensor, step: Step, guidance: Tensor, music_guidance: float
    ) -> tuple[Tensor, Tensor]:
        """x after one step, and x0: x (B, block, R, C), memory (B, block, 3 D), valid (B, block), guidance (S, R)."""
        ...

    def decode(self, latents: Tensor, leader: Tensor, layers: Tensor) -> Tensor:
        """Joints (T, 22, 3) metres of normalised latents (L, R, C); layers (R,) multiplies each residual layer."""
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
        config, layers = self.diffusion, self.denoiser.layers
        return Sampling(
            block=self.denoiser.config.block,
            layers=layers,
            channels=self.denoiser.latent_width,
            alpha_bar=alphas_cumprod(config),
            alternating_phase=config.alternating_phase,
            stitching=config.stitching,
            steps=config.steps,
            guidance=tuple(per_layer(config.guidance, layers)),
            music_guidance=config.music_guidance,
            reference_height=self.reference_height,
        )

    def condition(self, leader: Tensor, music: Tensor, music_valid: Tensor, role: Tensor) -> Tensor:
        features = leader_features(leader, smoothed_heading(leader, self.frame))
        return self.denoiser.condition.of_clip(features[None], music[None], music_valid[None], role)[0]

    def step(
        self, x: Tensor, memory: Tensor, valid: Tensor, step: Step, guidance: Tensor, music_guidance: float
    ) -> tuple[Tensor, Tensor]:
        time, weight = torch.tensor([step.time]).float(), torch.tensor([music_guidance]).float()
        x0 = classifier_free_guidance(self.denoiser, x, time, memory, valid, guidance, weight)
        return step.a * x + step.b * x0, x0

    def decode(self, latents: Tensor, leader: Tensor, layers: Tensor) -> Tensor:
        return decode(self.hfsq, self.frame, self.diffusion, latents, leader, layers)


def for_all_streams(guidance: tuple[float, ...]) -> Tensor:
    """(S, R): each layer's guidance, the same for every stream."""
    return torch.tensor(guidance, dtype=torch.float32).repeat(len(STREAMS), 1)
