"""Training windows of stage 2: one block of latents with leader and music around it, cut from the clips."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import torch
from torch import Tensor

from training.config import STRIDE, ConditionConfig, check_latent_frames
from training.denoiser.clips import Clip
from training.music.recipe import MUSIC_FEATURES

SHORTEST = 8
"""Latent frames of the shortest window that is cut short; whole blocks that are shorter stay whole."""


class Batch(NamedTuple):
    """N windows of one block. Context arrays have a margin of latent frames on both sides, zero outside the
    clip.
    """

    latents: Tensor  # (N, block, R, C)
    valid: Tensor  # (N, block)
    features: Tensor  # (N, 4 (block + 2 margin), 68)
    music: Tensor  # (N, 4 (block + 2 margin), 54)
    music_valid: Tensor  # (N, 4 (block + 2 margin))
    inside: Tensor  # (N, block + 2 margin)
    role: Tensor  # (N,)
    leader: Tensor  # (N, 4 block, 22, 3)
    reactor: Tensor  # (N, 4 block, 22, 3)
    heading: Tensor  # (N, 4 block, 2)


def slice_padded(values: Tensor, start: int, stop: int) -> Tensor:
    """values[start:stop] with zeros where the indices lie outside."""
    inner = values[max(start, 0) : max(min(stop, len(values)), 0)]
    out = values.new_zeros(stop - start, *values.shape[1:])
    first = max(-start, 0)
    out[first : first + len(inner)] = inner
    return out


class Windows:
    """Dense sliding windows (stride of one latent frame = 4 frames by default), some cut short at either
    end.
    """

    def __init__(
        self, clips: Sequence[Clip], block: int, margin: int, stride: int, config: ConditionConfig
    ) -> None:
        """Raises ValueError where the stride, in frames, is not a multiple of a latent frame's 4."""
        check_latent_frames("stride", stride)
        self.clips, self.block, self.margin, self.config = clips, block, margin, config
        self.starts: list[tuple[int, int]] = [
            (i, s)
            for i, clip in enumerate(clips)
            for s in range(0, max(len(clip) - block, 0) + 1, stride // STRIDE)
        ]
        # Few windows have a couple that comes together or parts, so they are drawn more often.
        self.ends = [(i, s) for i, clip in enumerate(clips) for s in (0, max(len(clip) - block, 0))]

    def batch(
        self,
        n: int,
        random: np.random.Generator,
        short: float = 0.15,
        song_ends: float = 0.05,
        ends: float = 0.15,
    ) -> Batch:
        """short: share of windows cut short at either end; song_ends: of those in which the song stops; ends: of
        those at the beginning or the end of a dance."""
        windows = []
        for at_end in random.random(n) < ends:
            among = self.ends if at_end else self.starts
            start = among[int(random.integers(len(among)))]
            windows.append(self._window(*start, random, short, song_ends))
        return Batch(*(torch.stack(values) for values in zip(*windows, strict=True)))

    def _window(
        self, index: int, start: int, random: np.random.Generator, short: float, song_ends: float
    ) -> tuple[Tensor, ...]:
        clip, block, margin = self.clips[index], self.block, self.margin
        stop = min(start + block, len(clip))
        first, last = 0, len(clip)  # latent frames of the clip that this window has
        if random.random() < short:
            if stop - start == block:
                stop = start + int(random.integers(min(SHORTEST, block), block + 1))
            last = stop
        if random.random() < short:
            first = start
        low, high = start - margin, start + block + margin
        rows = torch.arange(low, high)
        inside = ((rows >= first) & (rows < last)).float()
        by_frame = inside.repeat_interleave(STRIDE)
        shift = int(random.integers(-self.config.leader_shift, self.config.leader_shift + 1))
        shift *= int(random.integers(2))
        features = clip.blurred if random.random() < self.config.blurred else clip.features
        # Before and after the dance the leader stands still, so that the shift brings in nothing that is no pose.
        frames = torch.arange(STRIDE * low, STRIDE * high) + shift
        features = features[frames.clamp(0, len(features) - 1)]
        if clip.music:
            music = clip.music[int(random.integers(len(clip.music)))]
        else:
            music = clip.features.new_zeros(len(clip.features), MUSIC_FEATURES)
        music_valid = by_frame.clone()
        if random.random() < self.config.drop_music or not clip.music:
            music_valid.zero_()
        elif random.random() < song_ends:
            music_valid[int(random.integers(len(music_valid))) :] = 0
        valid = torch.zeros(block)
        valid[: stop - start] = 1
        shown = (STRIDE * start, STRIDE * (start + block))
        return (
            slice_padded(clip.latents, start, start + block) * valid[:, None, None],
            valid,
            features,
            slice_padded(music, STRIDE * low, STRIDE * high),
            music_valid,
            inside,
            torch.tensor(clip.role),
            slice_padded(clip.leader, *shown),
            slice_padded(clip.reactor, *shown),
            slice_padded(clip.heading, *shown),
        )
