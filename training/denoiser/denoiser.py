"""G_theta of Eq. 6: predicts clean latents x0 of every residual layer from noisy ones, the leader and the music."""

from __future__ import annotations

from dataclasses import dataclass

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from training.config import DenoiserConfig
from training.denoiser.condition import ConditionEncoder
from training.denoiser.transformer import (
    Layer,
    TimeEmbedding,
    alibi_bias,
    causal_bias,
    phase,
    sinusoidal,
)
from training.motion.skeleton import JOINTS


@dataclass(frozen=True)
class AttentionMasks:
    """For one block: positions, the mask of the attention and that of valid leader tokens, as biases of the logits."""

    positions: Tensor  # (block, P)
    attention: Tensor  # broadcastable to (N, heads, block, block)
    cross: Tensor  # (N, heads, block, block)


def position_table(config: DenoiserConfig) -> Tensor:
    """(block, P): what tells a block's tokens their place."""
    return phase(config.block) if config.positions == "periodic" else sinusoidal(config.block)


class Conditioning(nn.Module):
    """One residual layer's own path from the memory, with its own null for each condition (paper 3.5)."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.leader = nn.Linear(width, width)
        self.music = nn.Linear(width, width)
        self.no_leader = nn.Parameter(torch.zeros(width))
        self.no_music = nn.Parameter(torch.zeros(width))

    def forward(self, memory: Tensor, keep_leader: Tensor, keep_music: Tensor) -> tuple[Tensor, Tensor]:
        """memory (N, L, 2 D), keep (N,) 1 or 0. Returns leader and music tokens, (N, L, D) each."""
        leader, music = memory.chunk(2, dim=-1)
        keep_leader, keep_music = keep_leader[:, None, None], keep_music[:, None, None]
        return (
            self.leader(leader) * keep_leader + self.no_leader * (1 - keep_leader),
            self.music(music) * keep_music + self.no_music * (1 - keep_music),
        )


class Transformer(nn.Module):
    """The transformer of one residual layer. `context` channels carry what lower layers know; they never look up."""

    def __init__(self, channels: int, context: int, depth: int, config: DenoiserConfig) -> None:
        super().__init__()
        width = config.width
        self.conditioning = Conditioning(width)
        self.input = nn.Linear(channels + context, width)
        self.position = nn.Linear(position_table(config).shape[1], width)
        self.time = TimeEmbedding(width)
        self.layers = nn.ModuleList(
            Layer(width, config.heads, config.mlp, config.dropout) for _ in range(depth)
        )
        self.norm = nn.LayerNorm(width)
        self.output = nn.Linear(width, channels)
        nn.init.zeros_(self.output.weight)
        nn.init.zeros_(self.output.bias)

    def forward(
        self,
        x: Tensor,
        time: Tensor,
        memory: Tensor,
        keep_leader: Tensor,
        keep_music: Tensor,
        masks: AttentionMasks,
    ) -> tuple[Tensor, Tensor]:
        """x (N, L, channels + context). Returns x0 of this layer (N, L, channels) and hidden states (N, L, D)."""
        leader, music = self.conditioning(memory, keep_leader, keep_music)
        position = self.position(masks.positions)
        film = F.silu(music + self.time(time))
        h = self.input(x) + position + leader
        leader = leader + position
        for layer in self.layers:
            h = layer(h, leader, film, masks.attention, masks.cross)
        h = self.norm(h)
        return self.output(h), h


class Denoiser(nn.Module):
    """Condition encoder plus one transformer per residual layer: a deep coarse trunk, then fine heads on top of it.

    Coarse never sees fine: transformer r reads the noisy latents of layers up to r and
    the hidden states of the one below.
    `lowest` and `highest` (R, C) are the ends of the quantiser's range, which sampling keeps to. `bodies` (2, 22, 3)
    are the rest offsets, metres, of the dancers of role 0, the reactor, and 1, the leader; see `set_bodies`.
    """

    positions: Tensor
    attention: Tensor
    alibi: Tensor
    lowest: Tensor
    highest: Tensor
    bodies: Tensor

    def __init__(self, latent_width: int, layers: int, config: DenoiserConfig) -> None:
        super().__init__()
        if len(config.depths) != layers:
            raise ValueError(
                f"the {layers} residual layers of stage 1 need {layers} depths (--denoiser.depths), got {config.depths}"
            )
        if config.width % config.heads:
            raise ValueError(f"a width of {config.width} cannot be shared by {config.heads} heads")
        if len(config.alibi_slopes) != config.heads:
            raise ValueError(
                f"{config.heads} heads need {config.heads} alibi_slopes, got {config.alibi_slopes}"
            )
        self.config = config
        self.latent_width, self.layers = latent_width, layers
        self.condition = ConditionEncoder(config.width, config.condition)
        self.transformers = nn.ModuleList(
            Transformer(latent_width, r * latent_width + (config.width if r else 0), depth, config)
            for r, depth in enumerate(config.depths)
        )
        self.register_buffer("lowest", torch.full((layers, latent_width), -torch.inf))
        self.register_buffer("highest", torch.full((layers, latent_width), torch.inf))
        self.register_buffer("bodies", torch.zeros(2, len(JOINTS), 3))
        alibi = alibi_bias(config.block, config.alibi_slopes)
        mask = causal_bias(config.block) if config.mask == "causal" else torch.zeros(())
        self.register_buffer("positions", position_table(config), persistent=False)
        self.register_buffer("attention", alibi + mask, persistent=False)
        self.register_buffer("alibi", alibi, persistent=False)

    def forward(
        self, x: Tensor, time: Tensor, memory: Tensor, valid: Tensor, keep_leader: Tensor, keep_music: Tensor
    ) -> Tensor:
        """x0 of all layers in one block.

        x: (N, block, R, C) normalised noisy latents; time: (N,) or (1,) in [0, 1]; memory: (N, block, 2 D);
        valid: (N, block) 1 for tokens of the clip, 0 for padding; keep_leader, keep_music: (N, R) 1 or 0 per layer.
        """
        masks = self.masks(valid)
        outputs: list[Tensor] = []
        hidden: Tensor | None = None
        for r, transformer in enumerate(self.transformers):
            seen = x[:, :, : r + 1].reshape(-1, x.shape[1], (r + 1) * self.latent_width)
            if hidden is not None:
                seen = torch.cat([seen, hidden], dim=-1)
            x0, hidden = transformer(seen, time, memory, keep_leader[:, r], keep_music[:, r], masks)
            outputs.append(x0)
        return torch.stack(outputs, dim=2)

    def masks(self, valid: Tensor) -> AttentionMasks:
        """valid: (N, block)."""
        padding = (valid[:, None, None, :] - 1) * 1e4
        # Padding comes last, so a causal mask hides it from the tokens of the clip.
        attention = self.attention if self.config.mask == "causal" else self.attention + padding
        return AttentionMasks(self.positions, attention, self.alibi + padding)
