"""Windows of stage 2: aligned parts, the leader's shift and blur, the share of windows at the ends of clips, yaw."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import torch

from tests.python.support.duets import made_duet
from training.config import STRIDE, ConditionConfig, FrameConfig, HfsqConfig
from training.denoiser.clips import Clip, make_clip
from training.denoiser.windows import Windows
from training.hfsq.autoencoder import Autoencoder
from training.motion.leader_frame import smoothed_heading
from training.motion.streams import from_streams, to_streams

BLOCK, MARGIN = 6, 2
PLAIN = replace(ConditionConfig(), leader_shift=0, blurred=0.0, drop_music=0.0)


@pytest.fixture(scope="module")
def hfsq() -> Autoencoder:
    torch.manual_seed(0)
    config = HfsqConfig(groups=2, widths=(16, 16, 8), depth=1, refine_width=8)
    return Autoencoder(config).requires_grad_(False).eval()


@pytest.fixture(scope="module")
def clip(hfsq: Autoencoder) -> Clip:
    duet = made_duet(160, 0)
    music = np.arange(160)[:, None] * np.ones((1, 54))
    return make_clip(duet, [music], 0.0, hfsq, FrameConfig(), blur=6.0)


def windows(clip: Clip, config: ConditionConfig) -> Windows:
    return Windows([clip], BLOCK, MARGIN, STRIDE, config)


def test_all_parts_of_a_window_are_of_the_same_frames(clip: Clip) -> None:
    batch = windows(clip, PLAIN).batch(20, np.random.default_rng(0), short=0.0, song_ends=0.0)
    for n in range(20):
        start = int(batch.music[n, STRIDE * MARGIN, 0]) if batch.inside[n, MARGIN] else 0
        frames = slice(start, start + STRIDE * BLOCK)
        inner = slice(STRIDE * MARGIN, STRIDE * (MARGIN + BLOCK))
        assert torch.equal(batch.leader[n], clip.leader[frames])
        assert torch.equal(batch.reactor[n], clip.reactor[frames])
        assert torch.equal(batch.features[n, inner], clip.features[frames])
        assert torch.equal(batch.latents[n], clip.latents[start // STRIDE : start // STRIDE + BLOCK])


def test_leader_shift_moves_the_leader_features_alone(clip: Clip) -> None:
    batch = windows(clip, replace(PLAIN, leader_shift=3)).batch(
        60, np.random.default_rng(0), short=0.0, song_ends=0.0
    )
    shifts = []
    for n in range(60):
        start = int(batch.music[n, STRIDE * MARGIN, 0])
        assert torch.equal(batch.reactor[n], clip.reactor[start : start + STRIDE * BLOCK])
        seen = batch.features[n, STRIDE * MARGIN]
        found = [s for s in range(-3, 4) if start + s >= 0 and torch.equal(seen, clip.features[start + s])]
        assert found or start == 0, "before the clip there is nothing"
        shifts += found
    assert set(shifts) == set(range(-3, 4))
    assert shifts.count(0) > 20, "half of the windows are left as they are"


def test_blurred_leader_features_keep_their_mean_and_lose_acceleration(clip: Clip) -> None:
    batch = windows(clip, replace(PLAIN, blurred=1.0)).batch(
        5, np.random.default_rng(0), short=0.0, song_ends=0.0
    )
    for n in range(5):
        start = int(batch.music[n, STRIDE * MARGIN, 0])
        assert torch.equal(batch.features[n, STRIDE * MARGIN], clip.blurred[start])
    assert torch.allclose(clip.blurred.mean(0), clip.features.mean(0), atol=0.2)
    sway, blurred = (f.diff(dim=0).diff(dim=0).abs().mean() for f in (clip.features, clip.blurred))
    assert blurred < 0.5 * sway


def test_the_share_of_windows_at_the_ends_of_clips_is_that_asked_for(clip: Clip) -> None:
    last = len(clip) - BLOCK
    for share in (0.0, 0.5):
        batch = windows(clip, PLAIN).batch(
            300, np.random.default_rng(0), short=0.0, song_ends=0.0, ends=share
        )
        first, final = (
            sum(torch.equal(latents, clip.latents[s : s + BLOCK]) for latents in batch.latents)
            for s in (0, last)
        )
        expected = 300 * (share / 2 + (1 - share) / (last + 1))
        assert expected / 1.6 < first < expected * 1.6
        assert expected / 1.6 < final < expected * 1.6


def test_yaw_turns_heading_streams_and_features(hfsq: Autoencoder, clip: Clip) -> None:
    music = [np.zeros((160, 54))]
    turned = make_clip(made_duet(160, 0), music, 0.0, hfsq, FrameConfig(), blur=6.0, yaw=0.3)
    plain = smoothed_heading(clip.leader, FrameConfig())
    cosine = (turned.heading * plain).sum(-1)
    assert torch.allclose(cosine, torch.full_like(cosine, np.cos(0.3)), atol=1e-5)
    streams = to_streams(turned.leader, turned.reactor, turned.heading)
    assert torch.allclose(from_streams(*streams, turned.leader, turned.heading), turned.reactor, atol=1e-5)
    assert torch.equal(turned.latents, hfsq.normalise(hfsq.encode([s[None] for s in streams]))[0])
    assert not torch.allclose(turned.features[:, :63], clip.features[:, :63], atol=1e-2)
    assert torch.allclose(turned.features[:, 63], clip.features[:, 63], atol=1e-5), "heights do not turn"
