"""Blockwise local context (paper 3.4): a dance of any length as blocks of one length, and back."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor


@dataclass(frozen=True)
class Block:
    """Latent frames [start, start + length) at positions 0 .. length - 1 of a block, the rest is padding."""

    start: int
    length: int


def partition(frames: int, block: int) -> list[Block]:
    """Blocks that tile `frames` latent frames; the last one may be shorter."""
    return [Block(start, min(block, frames - start)) for start in range(0, frames, block)]


def overlapping(frames: int, block: int) -> list[Block]:
    """Windows half a block apart, for latent stitching (the paper's Table 3, after EDGE)."""
    starts = range(0, max(frames - block // 2, 1), block // 2)
    return [Block(start, min(block, frames - start)) for start in starts]


def gather(values: Tensor, blocks: list[Block], block: int) -> Tensor:
    """(L, ...) to (B, block, ...), padded with zeros."""
    out = values.new_zeros(len(blocks), block, *values.shape[1:])
    for i, b in enumerate(blocks):
        out[i, : b.length] = values[b.start : b.start + b.length]
    return out


def scatter(values: Tensor, blocks: list[Block], frames: int) -> Tensor:
    """Inverse of `gather`; where blocks overlap, a cross-fade."""
    out = values.new_zeros(frames, *values.shape[2:])
    total = values.new_zeros(frames)
    extra = (1,) * (values.dim() - 2)
    for i, b in enumerate(blocks):
        ramp = torch.minimum(torch.arange(1, b.length + 1), torch.arange(b.length, 0, -1)).to(values.dtype)
        out[b.start : b.start + b.length] += values[i, : b.length] * ramp.view(-1, *extra)
        total[b.start : b.start + b.length] += ramp
    return out / total.view(-1, *extra)
