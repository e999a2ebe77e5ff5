"""Training clips of stage 2: augmented duets and pairs from solos, as latents of the frozen HFSQ with conditions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from scipy.ndimage import gaussian_filter1d
from torch import Tensor

from training.config import STRIDE, ConditionConfig, FrameConfig, check_limits
from training.data.augment import mirror, mirror_motion, scale_leader, swap_roles, tempo_warp
from training.data.duet import Duet, Solo
from training.data.music_pairing import MusicBank
from training.data.solo_pairs import AHEAD, solo_pair
from training.hfsq.autoencoder import Autoencoder
from training.motion.leader_frame import smoothed_heading
from training.motion.streams import leader_features, to_streams

SOLO_YAW_DEGREES = 20.0  # the frame of reference of a soloist is turned by up to this much


@dataclass(frozen=True)
class Augmentation:
    tempos: tuple[float, ...] = (0.9, 1.0, 1.1)
    mirror: bool = True
    roles: bool = True
    scales: tuple[float, float] = (0.94, 1.06)  # leaders of other sizes
    yaw: float = 20.0  # degrees; the frame of reference is turned by up to this much
    copies: int = 3  # of every combination, each with its own grid offset, leader scale and yaw

    def __post_init__(self) -> None:
        check_limits(self, copies=(1, math.inf), scales=(0.1, 10))
        if self.scales[0] > self.scales[1]:
            raise ValueError(f"--scales are the least and the greatest, got {self.scales}")


@dataclass(frozen=True)
class Clip:
    """One augmented duet, everything on its own time axis; T = 4 L."""

    latents: Tensor  # (L, R, C) normalised
    features: Tensor  # (T, 68) of the leader
    blurred: Tensor  # (T, 68) the same smoothed over time, without its beat
    music: list[Tensor]  # several pieces (T, 54), or none: silence
    leader: Tensor  # (T, 22, 3)
    reactor: Tensor  # (T, 22, 3)
    heading: Tensor  # (T, 2)
    role: float  # 0 reactor wanted, 1 leader wanted

    def __len__(self) -> int:
        return len(self.latents)


def feature_values(clips: Sequence[Clip]) -> tuple[Tensor, Tensor]:
    """All leader features (n, 68) and music features (m, 54) of clips. Raises ValueError where there are none."""
    if not any(clip.music for clip in clips):
        raise ValueError("there is nothing to train on: no duet, or no music beside it")
    return torch.cat([c.features for c in clips]), torch.cat([m for c in clips for m in c.music])


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
    """Every duet at every tempo, mirrored or not, in both roles; all clips of a tempo share its music."""
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


def solo_pair_clips(
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
            pair = solo_pair(Solo(solo.name, motion), random.uniform(*AHEAD))
            cut = int(random.integers(STRIDE))
            pair = Duet(pair.name, pair.leader[cut:], pair.reactor[cut:])
            yaw = np.radians(random.uniform(-SOLO_YAW_DEGREES, SOLO_YAW_DEGREES))
            clips.append(make_clip(pair, [], 0.0, hfsq, frame, config.leader_blur, yaw))
    return clips
