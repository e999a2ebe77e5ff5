"""The three graphs of the browser, as modules: condition and decode over the clip, step over blocks.

They carry the maths (normalisation, frame of reference, guidance, sampler update), so that the page passes metres and
features. Batch-free at their edges: one clip at a time.
"""

from __future__ import annotations

from torch import Tensor, nn

from training.diffusion.guidance import classifier_free_guidance
from training.diffusion.model import Model


class Condition(nn.Module):
    """leader (T, 22, 3), music (T, 54), music_valid (T), role (1) to memory (T / 4, M)."""

    def __init__(self, model: Model) -> None:
        super().__init__()
        self.model = model
        self.encoder = model.denoiser.condition  # registers its parameters

    def forward(self, leader: Tensor, music: Tensor, music_valid: Tensor, role: Tensor) -> Tensor:
        return self.model.condition(leader, music, music_valid, role)


class SamplerStep(nn.Module):
    """One denoising step with guidance over B blocks, see `classifier_free_guidance`: x_next = a x + b x0.

    x (B, block, R, C), memory (B, block, M), valid (B, block), time (1), guidance (S, R), music_guidance (1),
    coefficients a and b (2) to x_next and x0 (B, block, R, C).
    """

    def __init__(self, model: Model) -> None:
        super().__init__()
        self.denoiser = model.denoiser

    def forward(
        self,
        x: Tensor,
        memory: Tensor,
        valid: Tensor,
        time: Tensor,
        guidance: Tensor,
        music_guidance: Tensor,
        coefficients: Tensor,
    ) -> tuple[Tensor, Tensor]:
        x0 = classifier_free_guidance(self.denoiser, x, time, memory, valid, guidance, music_guidance)
        a, b = coefficients.unbind(0)
        return a * x + b * x0, x0


class Decode(nn.Module):
    """latents (L, R, C) normalised, leader (4 L, 22, 3), layers (R) to reactor (4 L, 22, 3) metres."""

    def __init__(self, model: Model) -> None:
        super().__init__()
        self.model = model
        self.hfsq = model.hfsq  # registers its parameters

    def forward(self, latents: Tensor, leader: Tensor, layers: Tensor) -> Tensor:
        return self.model.decode(latents, leader, layers)
