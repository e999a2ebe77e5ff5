"""Windows for stage 2: latents of the frozen HFSQ with leader and music around them, from augmented duets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import torch
from scipy.ndimage import gaussian_filter1d
from torch import Tensor

from training.config import STRIDE, ConditionConfig, FrameConfig
from training.data.augment import mirror, mirror_motion, scale_leader, swap_roles, tempo_warp
from training.data.duet import Duet, Solo
from training.data.music_pairing import MusicBank
from training.data.solo_pairs import AHEAD, improvised
from training.hfsq.autoencoder import Autoencoder
from training.motion.leader_frame import smoothed_heading
from training.motion.streams import leader_features, to_streams
from training.music.recipe import MUSIC_FEATURES

SOLO_YAW = 20.0  # degrees; the frame of reference of a soloist is turned by up to this much


@dataclass(frozen=True)
class Augmentation:
    tempos: tuple[float, ...] = (0.9, 1.0, 1.1)
    mirror: bool = True
    roles: bool = True
    scales: tuple[float, float] = (0.94, 1.06)  # leaders of other sizes
    yaw: float = 20.0  # degrees; the frame of reference is turned by up to this much
    copies: int = 3  # of every combination, each with its own grid offset, leader scale and yaw


@dataclass(frozen=True)
class Clip:
    """One augmented duet, everything on its own time axis; T = 4 L."""

    latents: Tensor  # (L, R, C) normalised
    features: Tensor  # (T, 68) of the leader
    blurred: Tensor  # (T, 68) the same without its beat
    music: list[Tensor]  # several pieces (T, 54), or none: silence
    leader: Tensor  # (T, 22, 3)
    reactor: Tensor  # (T, 22, 3)
    heading: Tensor  # (T, 2)
    role: float  # 0 reactor wanted, 1 leader wanted

    def __len__(self) -> int:
        return len(self.latents)


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


@torch.no_grad()
def make_clip(
    duet: Duet,
    music: Sequence[np.ndarray],
    role: float,
    hfsq: Autoencoder,
    frame: FrameConfig,
    blur: float,
    yaw: float = 0.0,
) -> Clip:
    """Encode a duet; its length is cut to a multiple of 4. yaw: radians that the frame is turned by."""
    frames = len(duet) // STRIDE * STRIDE
    leader = torch.from_numpy(duet.leader[:frames])
    reactor = torch.from_numpy(duet.reactor[:frames])
    heading = turned(smoothed_heading(leader, frame), yaw)
    latents = hfsq.encode([s[None] for s in to_streams(leader, reactor, heading)])
    features = leader_features(leader, heading)
    return Clip(
        latents=hfsq.normalise(latents)[0],
        features=features,
        blurred=torch.from_numpy(gaussian_filter1d(features.numpy(), blur, axis=0, mode="nearest")),
        music=[torch.from_numpy(m[:frames]).float() for m in music],
        leader=leader,
        reactor=reactor,
        heading=heading,
        role=role,
    )


def turned(heading: Tensor, yaw: float) -> Tensor:
    """Headings (T, 2) turned by yaw radians."""
    x, z = heading.unbind(-1)
    c, s = np.cos(yaw), np.sin(yaw)
    return torch.stack([c * x + s * z, c * z - s * x], dim=-1)


def augmented_clips(
    duets: Sequence[Duet],
    bank: MusicBank,
    hfsq: Autoencoder,
    frame: FrameConfig,
    options: Augmentation,
    config: ConditionConfig,
    seed: int,
) -> list[Clip]:
    """Every duet at every tempo, mirrored or not, in both roles; the music of a tempo is shared by all of
    them.
    """
    random = np.random.default_rng(seed)
    clips: list[Clip] = []
    for duet in duets:
        for tempo in options.tempos:
            music = [m for variant, m in bank[duet.name].items() if variant.warp == tempo]
            warped = tempo_warp(duet, tempo)
            for mirrored in (False, True) if options.mirror else (False,):
                for role in (0.0, 1.0) if options.roles else (0.0,):
                    for _ in range(options.copies):
                        made = mirror(warped) if mirrored else warped
                        made = scale_leader(
                            swap_roles(made) if role else made, random.uniform(*options.scales)
                        )
                        cut = int(random.integers(STRIDE))
                        made = Duet(made.name, made.leader[cut:], made.reactor[cut:])
                        cut_music = [m[cut:] for m in music]
                        yaw = np.radians(random.uniform(-options.yaw, options.yaw))
                        clips.append(make_clip(made, cut_music, role, hfsq, frame, config.leader_blur, yaw))
    return clips


def improvised_clips(
    solos: Sequence[Solo],
    copies: int,
    hfsq: Autoencoder,
    frame: FrameConfig,
    config: ConditionConfig,
    seed: int,
) -> list[Clip]:
    """`copies` silent clips of every solo dance and of its mirror image, each with its own distance, grid offset
    and yaw.
    """
    random = np.random.default_rng(seed)
    clips: list[Clip] = []
    for solo in solos:
        for motion in [solo.motion, mirror_motion(solo.motion)] * copies:
            pair = improvised(Solo(solo.name, motion), random.uniform(*AHEAD))
            cut = int(random.integers(STRIDE))
            pair = Duet(pair.name, pair.leader[cut:], pair.reactor[cut:])
            yaw = np.radians(random.uniform(-SOLO_YAW, SOLO_YAW))
            clips.append(make_clip(pair, [], 0.0, hfsq, frame, config.leader_blur, yaw))
    return clips


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
        self, clips: Sequence[Clip], block: int, margin: int, stride: int, config: ConditionConfig, seed: int
    ) -> None:
        self.clips, self.block, self.margin, self.config = clips, block, margin, config
        self.starts: list[tuple[int, int]] = [
            (i, s)
            for i, clip in enumerate(clips)
            for s in range(0, max(len(clip) - block, 0) + 1, max(stride // STRIDE, 1))
        ]
        # How a couple comes together and parts is in few windows, and nothing else is like it.
        self.ends = [(i, s) for i, clip in enumerate(clips) for s in (0, max(len(clip) - block, 0))]
        self.random = np.random.default_rng(seed)

    def batch(self, n: int, short: float = 0.15, song_ends: float = 0.05, ends: float = 0.15) -> Batch:
        """short: share of windows cut short at either end; song_ends: of those in which the song stops; ends: of
        those at the beginning or the end of a dance."""
        windows = []
        for at_end in self.random.random(n) < ends:
            among = self.ends if at_end else self.starts
            windows.append(self._window(*among[int(self.random.integers(len(among)))], short, song_ends))
        stacked = [torch.stack([w[k] for w in windows]) for k in range(10)]
        return Batch(*stacked)

    def _window(self, index: int, start: int, short: float, song_ends: float) -> tuple[Tensor, ...]:
        clip, block, margin = self.clips[index], self.block, self.margin
        stop = min(start + block, len(clip))
        first, last = 0, len(clip)  # where this window's world begins and ends, in latent frames
        if self.random.random() < short:
            last = stop = start + int(self.random.integers(8, block + 1)) if stop - start == block else stop
        if self.random.random() < short:
            first = start
        low, high = start - margin, start + block + margin
        rows = torch.arange(low, high)
        inside = ((rows >= first) & (rows < last)).float()
        by_frame = inside.repeat_interleave(STRIDE)
        shift = int(self.random.integers(-self.config.leader_shift, self.config.leader_shift + 1))
        shift *= int(self.random.integers(2))
        features = clip.blurred if self.random.random() < self.config.blurred else clip.features
        features = slice_padded(features, STRIDE * low + shift, STRIDE * high + shift)
        if clip.music:
            music = clip.music[int(self.random.integers(len(clip.music)))]
        else:
            music = clip.features.new_zeros(len(clip.features), MUSIC_FEATURES)
        heard = by_frame.clone()
        if self.random.random() < self.config.drop_music or not clip.music:
            heard.zero_()
        elif self.random.random() < song_ends:
            heard[int(self.random.integers(len(heard))) :] = 0
        valid = torch.zeros(block)
        valid[: stop - start] = 1
        frames = (STRIDE * start, STRIDE * (start + block))
        return (
            slice_padded(clip.latents, start, start + block) * valid[:, None, None],
            valid,
            features,
            slice_padded(music, STRIDE * low, STRIDE * high),
            heard,
            inside,
            torch.tensor(clip.role),
            slice_padded(clip.leader, *frames),
            slice_padded(clip.reactor, *frames),
            slice_padded(clip.heading, *frames),
        )
