"""The three graphs of the browser, as modules: condition and decode over the clip, step over blocks.

They carry the maths (normalisation, frame of reference, clamp), so that the page passes metres and
features. Batch-free at their edges: one clip at a time.
"""

from __future__ import annotations

from torch import Tensor, nn

from training.diffusion.model import Model
from training.diffusion.sampler import advance


class Condition(nn.Module):
    """leader (T, 22, 3), music (T, 54), music_valid (T), role (1) to memory (T / 4, M) and unfamiliarity (T / 4)."""

    def __init__(self, model: Model) -> None:
        super().__init__()
        self.model = model
        self.encoder = model.denoiser.condition  # registers its parameters

    def forward(
        self, leader: Tensor, music: Tensor, music_valid: Tensor, role: Tensor
    ) -> tuple[Tensor, Tensor]:
        memory = self.model.condition(leader, music, music_valid, role)
        return memory, self.model.unfamiliarity(leader)


class Step(nn.Module):
    """One sampling step over B blocks: `ReactionModel.predict`, then `advance` with a (1), b (1) and extrapolation (S).

    Returns the next noisy latents and the prediction x0, (B, block, R, C), which a graphics card keeps for the next
    step.
    """

    def __init__(self, model: Model) -> None:
        super().__init__()
        self.model = model
        self.denoiser = model.denoiser  # registers its parameters

    def forward(
        self,
        x: Tensor,
        before: Tensor,
        memory: Tensor,
        valid: Tensor,
        keep: Tensor,
        time: Tensor,
        a: Tensor,
        b: Tensor,
        extrapolation: Tensor,
    ) -> tuple[Tensor, Tensor]:
        x0 = self.model.predict(x, memory, valid, keep, time)
        return advance(x, x0, before, a, b, extrapolation), x0


class Decode(nn.Module):
    """latents (L, R, C) normalised, leader (4 L, 22, 3), gains (S, R) and bones (22) metres to reactor (4 L, 22, 3)
    metres and lengths (4 L, 22), see `ReactionModel.decode`.
    """

    def __init__(self, model: Model) -> None:
        super().__init__()
        self.model = model
        self.hfsq = model.hfsq  # registers its parameters

    def forward(self, latents: Tensor, leader: Tensor, gains: Tensor, bones: Tensor) -> tuple[Tensor, Tensor]:
        return self.model.decode(latents, leader, gains, bones)
