"""Training windows of stage 1: clips of the three streams from augmented duets and solo dances."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import cast

import numpy as np
import torch
from torch import Tensor

from training.config import FrameConfig
from training.data.augment import mirror, swap_roles, tempo_warp
from training.data.duet import Duet, Solo
from training.hfsq.masking import slow_motion
from training.motion.leader_frame import smoothed_heading
from training.motion.streams import to_streams

Streams = tuple[Tensor, Tensor, Tensor]


@dataclass(frozen=True)
class Clip:
    """One augmented dance as streams."""

    streams: Streams  # (T, c) each
    slow: Streams  # the same below the masking's cutoff

    def __len__(self) -> int:
        return len(self.streams[0])


def streams_of(duet: Duet, frame: FrameConfig) -> Streams:
    """The reactor in the leader's smoothed frame."""
    leader, reactor = torch.from_numpy(duet.leader), torch.from_numpy(duet.reactor)
    return to_streams(leader, reactor, smoothed_heading(leader, frame))


def training_clips(
    duets: Sequence[Duet],
    solos: Sequence[Solo],
    tempos: Sequence[float],
    frame: FrameConfig,
    cutoff: float | None,
    shortest: int,
) -> list[Clip]:
    """Every training duet and solo, also mirrored, duets also role-swapped and at other tempos.

    cutoff: Hz, that of the masking. Clips of fewer than `shortest` frames are left out; raises ValueError where none is
    as long.
    """
    clips: list[Streams] = []
    for duet in duets:
        for tempo in tempos:
            warped = tempo_warp(duet, tempo)
            for variant in (warped, mirror(warped)):
                clips += [streams_of(variant, frame), streams_of(swap_roles(variant), frame)]
    for solo in solos:
        # The soloist is leader and reactor: body streams are as in a duet, the placement stream has the height alone.
        alone = Duet(solo.name, solo.motion, solo.motion)
        clips += [streams_of(variant, frame) for variant in (alone, mirror(alone))]
    if all(len(streams[0]) < shortest for streams in clips):
        raise ValueError(f"no dance to train on has {shortest} frames")
    return [
        Clip(streams, cast(Streams, tuple(slow_motion(stream, cutoff) for stream in streams)))
        for streams in clips
        if len(streams[0]) >= shortest
    ]


class Windows:
    """Random windows of the clips, turned by a random angle about the vertical in half of the cases."""

    def __init__(self, clips: list[Clip], size: int) -> None:
        self.clips, self.size = clips, size
        starts = np.array([len(c) - size + 1 for c in clips], dtype=np.float64)
        self.shares = starts / starts.sum()

    def batch(self, n: int, random: np.random.Generator) -> tuple[Streams, Streams]:
        """Three tensors (n, size, c), and the same three of the slow motion."""
        chosen = [self.clips[i] for i in random.choice(len(self.clips), n, p=self.shares)]
        starts = [int(random.integers(0, len(clip) - self.size + 1)) for clip in chosen]
        angle = random.uniform(-np.pi, np.pi, n) * (random.random(n) < 0.5)
        angles = torch.from_numpy(angle).float()

        def cut(streams: list[Streams]) -> Streams:
            upper, lower, placement = (
                torch.stack([each[i][at : at + self.size] for each, at in zip(streams, starts, strict=True)])
                for i in range(3)
            )
            return turn(upper, angles), turn(lower, angles), placement

        return cut([clip.streams for clip in chosen]), cut([clip.slow for clip in chosen])


def turn(stream: Tensor, angle: Tensor) -> Tensor:
    """Turn joint positions (N, T, 3 k) about the vertical by (N,) radians."""
    joints = stream.unflatten(-1, (-1, 3))
    c, s = angle.cos()[:, None, None], angle.sin()[:, None, None]
    x, y, z = joints.unbind(-1)
    return torch.stack([c * x + s * z, y, c * z - s * x], dim=-1).flatten(-2)
