"""Windows of stage 2: everything in a window speaks of the same moments."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import torch

from training.config import STRIDE, ConditionConfig, FrameConfig, HfsqConfig
from training.data.made import made_duet
from training.frame import smoothed_heading
from training.hfsq.autoencoder import Autoencoder
from training.stage2_data import Clip, Windows, make_clip
from training.streams import from_streams, to_streams

BLOCK, MARGIN = 6, 2
PLAIN = replace(ConditionConfig(), drop_music=0.0)


@pytest.fixture(scope="module")
def hfsq() -> Autoencoder:
    torch.manual_seed(0)
    config = HfsqConfig(groups=2, widths=(16, 16, 8), depth=1, refine_width=8)
    return Autoencoder(config).requires_grad_(False).eval()


@pytest.fixture(scope="module")
def clip(hfsq: Autoencoder) -> Clip:
    duet = made_duet(160, 0)
    music = np.arange(160)[:, None] * np.ones((1, 54))
    return make_clip(duet, [music], 0.0, hfsq, FrameConfig())


def windows(clip: Clip, config: ConditionConfig) -> Windows:
    return Windows([clip], BLOCK, MARGIN, STRIDE, config, seed=0)


def test_a_window_is_cut_from_one_moment(clip: Clip) -> None:
    batch = windows(clip, PLAIN).batch(20, short=0.0, song_ends=0.0)
    for n in range(20):
        start = int(batch.music[n, STRIDE * MARGIN, 0]) if batch.inside[n, MARGIN] else 0
        frames = slice(start, start + STRIDE * BLOCK)
        inner = slice(STRIDE * MARGIN, STRIDE * (MARGIN + BLOCK))
        assert torch.equal(batch.leader[n], clip.leader[frames])
        assert torch.equal(batch.reactor[n], clip.reactor[frames])
        assert torch.equal(batch.features[n, inner], clip.features[frames])
        assert torch.equal(batch.latents[n], clip.latents[start // STRIDE : start // STRIDE + BLOCK])


def test_a_turned_frame_turns_streams_and_features_alike(hfsq: Autoencoder, clip: Clip) -> None:
    music = [np.zeros((160, 54))]
    turned = make_clip(made_duet(160, 0), music, 0.0, hfsq, FrameConfig(), yaw=0.3)
    plain = smoothed_heading(clip.leader, FrameConfig())
    cosine = (turned.heading * plain).sum(-1)
    assert torch.allclose(cosine, torch.full_like(cosine, np.cos(0.3)), atol=1e-5)
    streams = to_streams(turned.leader, turned.reactor, turned.heading)
    assert torch.allclose(from_streams(*streams, turned.leader, turned.heading), turned.reactor, atol=1e-5)
    assert torch.equal(turned.latents, hfsq.normalise(hfsq.encode([s[None] for s in streams]))[0])
    assert not torch.allclose(turned.features[:, :63], clip.features[:, :63], atol=1e-2)
    assert torch.allclose(turned.features[:, 63], clip.features[:, 63], atol=1e-5), "heights do not turn"
