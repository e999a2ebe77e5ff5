"""Blocks that tile a dance of any length, and windows that overlap."""

from __future__ import annotations

import pytest
import torch

from training.diffusion.blocks import gather, overlapping, partition, scatter


@pytest.mark.parametrize("frames", [1, 29, 59, 60, 61, 90, 119, 120, 121, 541])
def test_blocks_tile_any_length(frames: int) -> None:
    blocks = partition(frames, 60)
    assert [i for b in blocks for i in range(b.start, b.start + b.length)] == list(range(frames))
    assert all(b.length == 60 for b in blocks[:-1])
    values = torch.randn(frames, 2, 3)
    packed = gather(values, blocks, 60)
    assert packed.shape == (len(blocks), 60, 2, 3)
    assert (packed[-1, blocks[-1].length :] == 0).all(), "the last block is padded"
    assert torch.allclose(scatter(packed, blocks, frames), values, atol=1e-6)


def test_stitched_windows_overlap_by_half_and_cross_fade() -> None:
    blocks = overlapping(150, 60)
    assert [b.start for b in blocks] == [0, 30, 60, 90]
    parts = torch.stack([torch.full((60,), float(i)) for i in range(len(blocks))])
    mixed = scatter(parts, blocks, 150)
    assert mixed[0] == 0
    assert mixed[149] == 3
    assert (mixed.diff() >= 0).all(), "a cross-fade from window to window"
    assert mixed.diff().max() < 0.1
