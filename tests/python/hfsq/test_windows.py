"""Training windows of stage 1, their statistics, and what each layer of a reconstruction says."""

from __future__ import annotations

import numpy as np
import pytest
import torch
from torch import Tensor

from tests.python.support.duets import made_duet
from training.config import FrameConfig, HfsqConfig
from training.data.duet import Solo
from training.data.made import made_dancer
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.reconstruct import reconstruct
from training.hfsq.statistics import bins_used, set_input_statistics, set_latent_statistics
from training.hfsq.windows import Clip, Streams, Windows, training_clips
from training.motion.streams import STREAM_WIDTHS

SMALL = HfsqConfig(groups=2, widths=(16, 16, 8), depth=1, refine_width=8)
FRAME = FrameConfig()


def numbered(frames: int) -> Streams:
    """Bodies whose joints stay at different places, and a placement that counts the frames."""
    upper, lower = (torch.linspace(0.1, 1, width).expand(frames, -1) for width in STREAM_WIDTHS[:2])
    return upper, lower, torch.arange(float(frames))[:, None].expand(-1, 3)


def angles(stream: Tensor, first: Tensor) -> Tensor:
    """By how much each window's joints are turned about the vertical, (N, k) radians."""
    now, then = (value.unflatten(-1, (-1, 3)) for value in (stream[:, 0], first[0]))
    return torch.atan2(now[..., 0], now[..., 2]) - torch.atan2(then[..., 0], then[..., 2])


def test_windows_are_stretches_from_all_over_the_clips_whose_bodies_turn_together_or_not_at_all() -> None:
    streams = numbered(40)
    slow = tuple(0.5 * stream for stream in streams)
    made, low = Windows([Clip(streams, (slow[0], slow[1], slow[2]))], 8).batch(400, np.random.default_rng(0))
    starts = made[2][:, 0, 0]
    assert torch.equal(made[2], starts[:, None, None] + torch.arange(8.0)[None, :, None].expand(400, 8, 3))
    assert set(starts.int().tolist()) == set(range(33)), "the last window ends with the clip"
    turns = torch.cat([angles(made[i], streams[i]) for i in (0, 1)], dim=1).remainder(2 * np.pi)
    assert (turns - turns[:, :1]).abs().max() < 1e-4, "upper and lower body by the same angle"
    still = torch.minimum(turns[:, 0], 2 * np.pi - turns[:, 0]) < 1e-4
    assert still.float().mean() == pytest.approx(0.5, abs=0.1)
    for i in range(3):
        assert torch.allclose(low[i], 0.5 * made[i], atol=1e-6), "the slow motion is that of the same window"
        height = (made[i] if i == 2 else made[i].unflatten(-1, (-1, 3))[..., 1]) ** 2
        assert i == 2 or torch.allclose(height[0], height[1])


def test_every_window_of_all_clips_is_drawn_as_often() -> None:
    long, short = numbered(47), numbered(17)
    other = (short[0], short[1], short[2] + 1000)  # 10 windows beside 40
    made, _ = Windows([Clip(long, long), Clip(other, other)], 8).batch(2000, np.random.default_rng(0))
    assert (made[2][:, 0, 0] < 1000).float().mean() == pytest.approx(0.8, abs=0.03)


def test_duets_are_learned_mirrored_in_both_roles_at_every_tempo_and_solos_mirrored() -> None:
    duet, solo = made_duet(120, 1), Solo("alone", made_dancer(90, 2))
    clips = training_clips([duet], [solo], (0.9, 1.0), FRAME, None, 8)
    assert len(clips) == 2 * 4 + 2
    first = [clip.streams[2][:60] for clip in clips]
    assert all(not torch.allclose(a, b) for i, a in enumerate(first[:8]) for b in first[:i])
    # The soloist is beside nobody: only the height is left of the place.
    for clip in clips[-2:]:
        assert len(clip) == 90
        assert clip.streams[2][:, [0, 2]].abs().max() < 1e-5
    assert len(training_clips([duet], [solo], (1.0,), FRAME, None, 120)) == 4
    with pytest.raises(ValueError, match="no dance to train on has 121 frames"):
        training_clips([duet], [solo], (1.0,), FRAME, None, 121)


def test_statistics_are_a_mean_of_each_dimension_and_one_deviation_of_each_stream() -> None:
    torch.manual_seed(0)
    places = [3 * torch.randn(width) for width in STREAM_WIDTHS]
    upper, lower, placement = (place + 0.5 * torch.randn(4000, len(place)) for place in places)
    clip = Clip((upper, lower, placement), (upper, lower, placement))
    model = Autoencoder(SMALL).eval()
    set_input_statistics(model, [clip])
    for stream, place in zip(model.each, places, strict=True):
        assert (stream.mean - place).abs().max() < 0.05
        assert float(stream.std) == pytest.approx(0.5, abs=0.02)


def test_every_latent_of_the_training_clips_is_normalised_by_its_own_mean_and_deviation() -> None:
    torch.manual_seed(0)
    model = Autoencoder(SMALL).eval()
    streams = tuple(torch.randn(800, width) for width in STREAM_WIDTHS)
    clip = Clip((streams[0], streams[1], streams[2]), (streams[0], streams[1], streams[2]))
    set_latent_statistics(model, [clip])
    with torch.no_grad():
        latents = model.encode([stream[None] for stream in streams])
    normal = model.normalise(latents)[0]
    moves = latents[0].std(0) > 0
    assert moves.float().mean() > 0.9
    assert normal.mean(0).abs().max() < 1e-3
    assert (normal.std(0)[moves] - 1).abs().max() < 1e-3


def test_a_latent_that_never_changes_is_normalised_to_a_number() -> None:
    still = tuple(torch.zeros(80, width) for width in STREAM_WIDTHS)
    model = Autoencoder(SMALL).eval()
    clip = Clip((still[0], still[1], still[2]), (still[0], still[1], still[2]))
    set_latent_statistics(model, [clip])
    assert model.normalise(model.encode([s[None] for s in still])).isfinite().all()


def test_a_reconstruction_of_one_layer_leaves_the_fine_one_out() -> None:
    torch.manual_seed(0)
    model, duet = Autoencoder(SMALL).eval(), made_duet(122, 1)
    whole, coarse = reconstruct(model, duet, FRAME), reconstruct(model, duet, FRAME, 1)
    assert whole.shape == coarse.shape == (120, 22, 3)
    assert np.array_equal(reconstruct(model, duet, FRAME, 2), whole)
    with torch.no_grad():
        for stream in model.each:
            stream.quantiser.up[1] += 1  # pyright: ignore
    assert np.array_equal(reconstruct(model, duet, FRAME, 1), coarse)
    assert np.abs(reconstruct(model, duet, FRAME) - whole).max() > 1e-3


def test_the_share_of_bins_in_use_is_counted_by_layer() -> None:
    """The first of four dimensions, with eight levels, has all of them; the others, with five, and the fine layer have
    one."""
    torch.manual_seed(0)
    model = Autoencoder(SMALL).eval()
    with torch.no_grad():
        for stream in model.each:
            stream.quantiser.down[0, ..., 1:] = 0  # pyright: ignore
            stream.quantiser.down[1] = 0  # pyright: ignore
    streams = tuple(50 * torch.randn(1200, width) for width in STREAM_WIDTHS)
    clip = Clip((streams[0], streams[1], streams[2]), (streams[0], streams[1], streams[2]))
    coarse, fine = bins_used(model, [clip])
    assert coarse == pytest.approx((8 / 8 + 3 / 5) / 4, abs=0.02)
    assert fine == pytest.approx((1 / 8 + 3 / 5) / 4)
