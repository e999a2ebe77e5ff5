"""Transformer layers over one block of latent frames: self-attention, cross-attention to the leader, FiLM."""

from __future__ import annotations

import math

import torch
from torch import Tensor, nn


class Attention(nn.Module):
    def __init__(self, width: int, heads: int) -> None:
        super().__init__()
        self.heads = heads
        self.query = nn.Linear(width, width)
        self.key_value = nn.Linear(width, 2 * width)
        self.out = nn.Linear(width, width)

    def forward(self, x: Tensor, memory: Tensor, bias: Tensor) -> Tensor:
        """x (N, L, D), memory (N, L, D), bias added to the logits, broadcastable to (N, heads, L, L)."""
        # Reshapes name every size but the batch, so that the exported graph has no shape arithmetic.
        length, width = x.shape[1], x.shape[2]
        split = (-1, length, self.heads, width // self.heads)
        q = self.query(x).reshape(split).transpose(1, 2)
        k, v = (part.reshape(split).transpose(1, 2) for part in self.key_value(memory).split(width, dim=-1))
        logits = (q * (width // self.heads) ** -0.5) @ k.transpose(-2, -1) + bias
        y = logits.softmax(dim=-1).to(v.dtype) @ v
        return self.out(y.transpose(1, 2).reshape(-1, length, width))


class ChannelDropout(nn.Module):
    """Drops channels (N, L, D) for all tokens of a window at once, by one draw a window."""

    def __init__(self, rate: float) -> None:
        super().__init__()
        self.rate = rate

    def forward(self, x: Tensor) -> Tensor:
        if not self.training or self.rate == 0:
            return x
        kept = torch.rand(x.shape[0], 1, x.shape[2], device=x.device) >= self.rate
        return x * (kept.to(x.dtype) / (1 - self.rate))


class Layer(nn.Module):
    """Self-attention, cross-attention and MLP; FiLM from (music, time) per token before the first and the last."""

    def __init__(self, width: int, heads: int, mlp: int, dropout: float) -> None:
        super().__init__()
        self.norm_self = nn.LayerNorm(width, elementwise_affine=False)
        self.self_attention = Attention(width, heads)
        self.norm_cross = nn.LayerNorm(width)
        self.cross_attention = Attention(width, heads)
        self.norm_mlp = nn.LayerNorm(width, elementwise_affine=False)
        self.mlp = nn.Sequential(nn.Linear(width, mlp * width), nn.GELU(), nn.Linear(mlp * width, width))
        self.film = nn.Linear(width, 4 * width)
        self.dropout = ChannelDropout(dropout)
        nn.init.zeros_(self.film.weight)
        nn.init.zeros_(self.film.bias)

    def forward(self, x: Tensor, leader: Tensor, film: Tensor, mask: Tensor, cross: Tensor) -> Tensor:
        scale_self, shift_self, scale_mlp, shift_mlp = self.film(film).chunk(4, dim=-1)
        h = self.norm_self(x) * (1 + scale_self) + shift_self
        x = x + self.dropout(self.self_attention(h, h, mask))
        x = x + self.dropout(self.cross_attention(self.norm_cross(x), leader, cross))
        h = self.norm_mlp(x) * (1 + scale_mlp) + shift_mlp
        return x + self.dropout(self.mlp(h))


class TimeEmbedding(nn.Module):
    """Diffusion time in [0, 1], (N,), to (N, 1, D)."""

    rates: Tensor

    def __init__(self, width: int, frequencies: int = 32) -> None:
        super().__init__()
        self.register_buffer("rates", torch.exp(torch.linspace(0, math.log(500), frequencies)))
        self.mlp = nn.Sequential(nn.Linear(2 * frequencies, width), nn.SiLU(), nn.Linear(width, width))

    def forward(self, time: Tensor) -> Tensor:
        angle = time[:, None] * self.rates[None]
        return self.mlp(torch.cat([angle.sin(), angle.cos()], dim=-1))[:, None]


def phase(block: int) -> Tensor:
    """Eq. 8 for one block: (block, 2), sine and cosine of pi i / block."""
    angle = math.pi * torch.arange(block) / block
    return torch.stack([angle.sin(), angle.cos()], dim=-1)


def sinusoidal(block: int) -> Tensor:
    """Positions of Vaswani et al. 2017 for one block: (block, 32), wavelengths from 2 pi to 2000 pi."""
    rates = torch.exp(torch.linspace(0, -math.log(1000), 16))
    angle = torch.arange(block)[:, None] * rates
    return torch.cat([angle.sin(), angle.cos()], dim=-1)


def alibi_bias(block: int, slopes: tuple[float, ...]) -> Tensor:
    """ALiBi (Press et al. 2022, Train Short, Test Long), on both sides of the query, added to the logits.

    (heads, block, block): minus slope times the distance in latent frames, one slope a head.
    Eq. 8's positions turn by half a circle over a block, which is too little to tell neighbours apart from few data;
    a slope of 0 leaves a head as the paper has it.
    """
    index = torch.arange(block)
    return -torch.tensor(slopes)[:, None, None] * (index[:, None] - index[None]).abs()


def causal_bias(block: int) -> Tensor:
    """(block, block): 0 for keys up to the query, a large negative number after it."""
    return torch.triu(torch.full((block, block), -1e4), diagonal=1)
