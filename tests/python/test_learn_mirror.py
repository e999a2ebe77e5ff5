"""The network that mirrors latents learns what decoding, mirroring and encoding would give."""

from __future__ import annotations

import numpy as np
import torch

from training.config import FrameConfig, HfsqConfig
from training.data.augment import mirror
from training.data.made import made_duet
from training.hfsq.autoencoder import Autoencoder
from training.learn_mirror import MirrorTraining, between, learn_mirror, mirror_fit, mirrored_by_decoding
from training.train_hfsq import streams_of


def test_it_learns_from_the_autoencoder_and_changes_nothing_else() -> None:
    torch.manual_seed(0)
    random = np.random.default_rng(0)
    model = Autoencoder(
        HfsqConfig(groups=2, widths=(16, 16, 8), depth=1, refine_width=8, mirror_width=32, mirror_depth=1)
    ).eval()
    dances = [made_duet(400, seed) for seed in range(3)]
    dances += [mirror(dance) for dance in dances]
    clips = [streams_of(dance, FrameConfig()) for dance in dances]
    for i, stream in enumerate(model.each):
        values = torch.cat([clip[i] for clip in clips])
        stream.mean.copy_(values.mean(0))
        stream.std.copy_(values.std(0).mean())
    latents = torch.cat([model.encode([s[None] for s in clip])[0] for clip in clips])
    model.latent_mean.copy_(latents.mean(0))
    model.latent_std.copy_(latents.std(0).clamp_min(1e-3))

    def windows(n: int) -> list[torch.Tensor]:
        chosen = [(clips[random.integers(6)], int(random.integers(0, 160))) for _ in range(n)]
        return [torch.stack([clip[i][at : at + 240] for clip, at in chosen]) for i in range(3)]

    unseen = [s[None] for s in streams_of(made_duet(400, 7), FrameConfig())]
    untrained = mirror_fit(model, unseen)
    before = {name: value.clone() for name, value in model.state_dict().items()}
    losses = learn_mirror(model, windows, MirrorTraining(windows=64, steps=200, batch=16))
    assert np.mean(losses[-20:]) < 0.5 * np.mean(losses[:20])
    assert mirror_fit(model, unseen) > max(untrained, 0) + 0.2
    for name, value in model.state_dict().items():
        assert torch.equal(value, before[name]) is not name.startswith("mirror."), name


def test_what_it_is_taught_is_the_mirrored_dance() -> None:
    """With an autoencoder that loses nothing, mirroring latents is mirroring the dance."""
    model = Autoencoder(HfsqConfig(quantiser="none", layers=1, scales=(1.0,), masking=None)).eval()
    duet = made_duet(120, 1)
    streams, other = ([s[None] for s in streams_of(dance, FrameConfig())] for dance in (duet, mirror(duet)))
    taught = mirrored_by_decoding(model, model.normalise(model.encode(streams)))
    assert torch.allclose(taught, model.normalise(model.encode(other))[:, :, 0], atol=1e-4)


def test_half_of_what_it_learns_from_lies_between_dances() -> None:
    torch.manual_seed(0)
    latents = torch.randn(400, 5, 1, 3)
    mixed = between(latents)
    same = (mixed == latents).flatten(1).all(1)
    assert 0.4 < same.float().mean() < 0.6
    assert mixed[~same].square().mean() < 0.9 * latents.square().mean(), "a mean of two varies less"
