"""The three graphs of the browser, as modules: condition and decode over the clip, step over blocks.

They carry the maths (normalisation, frame of reference, clamp), so that the page passes metres and
features. Batch-free at their edges: one clip at a time.
"""

from __future__ import annotations

from torch import Tensor, nn

from training.diffusion.model import Model


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
    """One DDIM step over B blocks (Song et al. 2021, Eq. 12): the next noisy latents a x + b x0, (B, block, R, C), of
    x and of x0 from `ReactionModel.predict`; a (1) and b (1) as in `Step` of training/diffusion/schedule.py.
    """

    def __init__(self, model: Model) -> None:
        super().__init__()
        self.model = model
        self.denoiser = model.denoiser  # registers its parameters

    def forward(
        self,
        x: Tensor,
        memory: Tensor,
        valid: Tensor,
        keep: Tensor,
        time: Tensor,
        a: Tensor,
        b: Tensor,
    ) -> Tensor:
        return a * x + b * self.model.predict(x, memory, valid, keep, time)


class Decode(nn.Module):
    """latents (L, R, C) normalised, leader (4 L, 22, 3), gains (S, R) and role (1) to reactor (4 L, 22, 3) metres, see
    `ReactionModel.decode`.
    """

    def __init__(self, model: Model) -> None:
        super().__init__()
        self.model = model
        self.hfsq = model.hfsq  # registers its parameters

    def forward(self, latents: Tensor, leader: Tensor, gains: Tensor, role: Tensor) -> Tensor:
        return self.model.decode(latents, leader, gains, role)
