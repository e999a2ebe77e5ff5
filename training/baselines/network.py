"""What the baselines' networks share: a transformer over one block of tokens, and diffusion with it."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from training.config import DenoiserConfig, DiffusionConfig
from training.denoiser.transformer import Layer, TimeEmbedding, alibi_bias, causal_bias, sinusoidal
from training.diffusion.blocks import Block, gather, scatter
from training.diffusion.schedule import add_noise, alphas_cumprod, ddim_steps, stratified_timesteps

DROPOUT = 0.1
SLOPES = DenoiserConfig().alibi_slopes
LAST_TIME = 0.1
"""Share of the training timesteps at which the last step predicts, as our denoiser's default."""


class Trunk(nn.Module):
    """Tokens (N, L, channels) beside context tokens (N, L, D), at most a block of each, to (N, L, out).

    Attention has the distance biases of our denoiser, in both directions unless it is causal.
    """

    positions: Tensor
    near: Tensor
    mask: Tensor

    def __init__(
        self, channels: int, out: int, width: int, depth: int, heads: int, block: int, causal: bool = False
    ) -> None:
        super().__init__()
        table = sinusoidal(block)
        self.register_buffer("positions", table, persistent=False)
        near = alibi_bias(block, SLOPES[:heads])
        self.register_buffer("near", near, persistent=False)
        self.register_buffer("mask", near + causal_bias(block) * float(causal), persistent=False)
        self.input = nn.Linear(channels, width)
        self.position = nn.Linear(table.shape[1], width)
        self.time = TimeEmbedding(width)
        self.layers = nn.ModuleList(Layer(width, heads, 2, DROPOUT) for _ in range(depth))
        self.norm = nn.LayerNorm(width)
        self.output = nn.Linear(width, out)
        nn.init.zeros_(self.output.weight)
        nn.init.zeros_(self.output.bias)

    def enter(self, x: Tensor) -> Tensor:
        return self.input(x) + self.position(self.positions[: x.shape[1]])

    def leave(self, hidden: Tensor) -> Tensor:
        return self.output(self.norm(hidden))

    def masks(self, valid: Tensor) -> tuple[Tensor, Tensor]:
        """Biases of self-attention and of attention to the context; valid (N, L)."""
        length = valid.shape[1]
        padding = (valid[:, None, None, :] - 1) * 1e4
        return self.mask[:, :length, :length] + padding, self.near[:, :length, :length] + padding

    def forward(self, x: Tensor, context: Tensor, valid: Tensor, time: Tensor) -> Tensor:
        """time: (N,) in [0, 1], what the layers are told beside the tokens."""
        hidden, film = self.enter(x) + context, F.silu(self.time(time))
        context = context + self.position(self.positions[: x.shape[1]])
        for layer in self.layers:
            hidden = layer(hidden, context, film, *self.masks(valid))
        return self.leave(hidden)


class Diffusion(nn.Module):
    """DDPM that predicts clean tokens, and DDIM, with the schedule of our denoiser."""

    alpha_bar: Tensor

    def __init__(self) -> None:
        super().__init__()
        self.table = alphas_cumprod(DiffusionConfig())
        self.register_buffer("alpha_bar", torch.from_numpy(self.table).float(), persistent=False)

    def draw(self, x0: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """Noisy tokens of x0 (N, ...), their times (N,) in [0, 1], rising, and alpha bar (N,)."""
        steps = stratified_timesteps(len(x0), len(self.table), x0.device)
        signal = self.alpha_bar[steps]
        return add_noise(x0, torch.randn_like(x0), signal), steps / len(self.table), signal

    @torch.no_grad()
    def sample(
        self,
        predict: Callable[[Tensor, Tensor, list[Block]], Tensor],
        initial: Tensor,
        blocks: list[Block],
        block: int,
        steps: int,
    ) -> Tensor:
        """Clean tokens (L, C) from noise (L, C); where blocks overlap their predictions are cross-faded at every step.

        predict: noisy tokens (B, block, C), time (B,) and the blocks to clean tokens (B, block, C).
        """
        x = initial
        for step in ddim_steps(self.table, steps, LAST_TIME):
            time = torch.full((len(blocks),), step.time)
            x0 = scatter(predict(gather(x, blocks, block), time, blocks), blocks, len(x))
            x = step.a * x + step.b * x0
        return x


def token_error(truth: Tensor, predicted: Tensor, valid: Tensor) -> Tensor:
    """Mean squared error of tokens (N, L, C) that are valid (N, L)."""
    return ((truth - predicted).square().mean(-1) * valid).sum() / valid.sum()


def block_inputs(values: Sequence[Tensor], blocks: list[Block], block: int) -> list[Tensor]:
    """Each (L, ...) as (B, block, ...), and last the valid tokens (B, block)."""
    cut = [gather(v, blocks, block) for v in values]
    return [*cut, gather(torch.ones(len(values[0])), blocks, block)]
