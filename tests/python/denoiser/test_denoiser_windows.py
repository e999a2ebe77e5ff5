"""Windows of stage 2: aligned parts, the leader's shift and blur, the share of windows at the ends of clips, yaw."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import torch

from tests.python.support.duets import made_duet
from training.config import STRIDE, ConditionConfig, FrameConfig, HfsqConfig
from training.data.augment import mirror_motion, warped_length
from training.data.duet import Solo
from training.data.made import made_dancer
from training.data.music_pairing import Variant
from training.denoiser.clips import Augmentation, Clip, augmented_clips, make_clip, solo_pair_clips
from training.denoiser.windows import Windows
from training.hfsq.autoencoder import Autoencoder
from training.motion.leader_frame import smoothed_heading
from training.motion.skeleton import body_height
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
        found = [s for s in range(-3, 4) if torch.equal(seen, clip.features[max(0, start + s)])]
        assert found
        shifts += found if start else []
    assert set(shifts) == set(range(-3, 4))
    assert shifts.count(0) > 20, "half of the windows are left as they are"


def test_a_shifted_leader_holds_its_first_and_last_pose(clip: Clip) -> None:
    """Zeros would be no pose, and far from every leader of training."""
    batch = windows(clip, replace(PLAIN, leader_shift=3)).batch(
        60, np.random.default_rng(0), short=0.0, song_ends=0.0, ends=1.0
    )
    poses = {tuple(row) for row in clip.features.tolist()}
    for n in range(60):
        inside = batch.features[n, batch.inside[n].repeat_interleave(STRIDE) > 0]
        assert all(tuple(row) in poses for row in inside.tolist())


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


def test_a_dance_shorter_than_a_block_is_one_window_from_its_beginning(clip: Clip) -> None:
    block = len(clip) + 5
    made = Windows([clip], block, MARGIN, STRIDE, PLAIN)
    for ends in (0.0, 1.0):
        batch = made.batch(12, np.random.default_rng(0), short=0.0, song_ends=0.0, ends=ends)
        for n in range(12):
            assert batch.valid[n].tolist() == [1.0] * len(clip) + [0.0] * 5
            assert torch.equal(batch.latents[n, :-5], clip.latents)
            assert torch.equal(batch.leader[n, : -5 * STRIDE], clip.leader)


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


def test_a_window_cut_short_knows_nothing_beyond_either_end(clip: Clip) -> None:
    batch = Windows([clip], 12, MARGIN, STRIDE, PLAIN).batch(
        200, np.random.default_rng(0), short=1.0, song_ends=0.0, ends=0.0
    )
    lengths = batch.valid.sum(1).int()
    assert set(lengths.tolist()) == set(range(8, 13))
    for n, length in enumerate(lengths):
        assert torch.equal(
            batch.inside[n], torch.cat([torch.zeros(MARGIN), batch.valid[n], torch.zeros(MARGIN)])
        )
        assert torch.equal(batch.music_valid[n], batch.inside[n].repeat_interleave(STRIDE))
        assert not batch.latents[n, length:].any()
        assert batch.latents[n, :length].any()


def test_blocks_too_short_to_be_cut_stay_whole(clip: Clip) -> None:
    batch = windows(clip, PLAIN).batch(20, np.random.default_rng(0), short=1.0)
    assert batch.valid.all()


def test_the_share_of_songs_that_stop_is_that_asked_for(clip: Clip) -> None:
    batch = windows(clip, PLAIN).batch(300, np.random.default_rng(0), short=0.0, song_ends=0.5, ends=0.0)
    inside = batch.inside.repeat_interleave(STRIDE, dim=1)
    stops = (batch.music_valid < inside).any(1)
    assert stops.float().mean() == pytest.approx(0.5, abs=0.1)
    after = batch.music_valid[stops]
    assert not ((after.diff(dim=1) > 0) & (inside[stops].diff(dim=1) <= 0)).any(), "and do not begin again"


def test_the_song_is_any_of_the_clip_or_none_as_often_as_asked(clip: Clip) -> None:
    two = replace(clip, music=[clip.music[0], clip.music[0] + 1000])
    whole = {"short": 0.0, "song_ends": 0.0, "ends": 0.0}
    batch = windows(two, replace(PLAIN, drop_music=0.3)).batch(400, np.random.default_rng(0), **whole)
    silent = ~batch.music_valid.any(1)
    assert silent.float().mean() == pytest.approx(0.3, abs=0.07)
    assert (batch.music.amax((1, 2)) >= 1000).float().mean() == pytest.approx(0.5, abs=0.07)
    without = windows(replace(clip, music=[]), PLAIN).batch(20, np.random.default_rng(0), **whole)
    assert not without.music_valid.any()


def test_duets_are_danced_at_every_tempo_mirrored_in_both_roles_to_the_music_of_that_tempo(
    hfsq: Autoencoder,
) -> None:
    duet = made_duet(160, 0, "one")
    # Music says its tempo and its frame.
    bank = {
        "one": {
            Variant(warp, "synth", 0): np.full((warped_length(160, warp), 54), warp, np.float32)
            + np.arange(warped_length(160, warp), dtype=np.float32)[:, None]
            for warp in (0.9, 1.0)
        }
    }
    options = Augmentation(tempos=(0.9, 1.0), scales=(1.0, 1.0), yaw=0.0, copies=2)
    clips = augmented_clips([duet], bank, hfsq, FrameConfig(), options, ConditionConfig(), seed=1)
    assert len(clips) == 2 * 2 * 2 * 2
    for clip, tempo in zip(clips, [0.9] * 8 + [1.0] * 8, strict=True):
        assert [round(float(music[0, 0] % 1), 3) for music in clip.music] == [tempo % 1]
    plain = [clip for clip in clips[8:12]]
    assert [clip.role for clip in plain] == [0, 0, 1, 1]
    for clip in plain:
        start = int(clip.music[0][0, 0] - 1)  # the grid's offset cuts music and dancers alike
        leader, reactor = (duet.reactor, duet.leader) if clip.role else (duet.leader, duet.reactor)
        frames = slice(start, start + len(clip.leader))
        assert torch.allclose(clip.leader, torch.from_numpy(leader[frames]), atol=1e-5)
        assert torch.allclose(clip.reactor, torch.from_numpy(reactor[frames]), atol=1e-5)


def yaw_of(clip: Clip) -> float:
    """Degrees by which the frame of reference is turned from the leader's heading, the same in all frames."""
    x, z = smoothed_heading(clip.leader, FrameConfig()).unbind(-1)
    turned_x, turned_z = clip.heading.unbind(-1)
    yaw = torch.atan2(z * turned_x - x * turned_z, x * turned_x + z * turned_z).rad2deg()
    assert yaw.std() < 1e-2
    return float(yaw.mean())


def test_every_copy_of_a_duet_has_its_own_grid_offset_leader_size_and_yaw(hfsq: Autoencoder) -> None:
    duet = made_duet(160, 0, "one")
    music = np.arange(160, dtype=np.float32)[:, None].repeat(54, axis=1)
    options = Augmentation(tempos=(1.0,), mirror=False, roles=False, scales=(0.9, 1.1), yaw=20.0, copies=40)
    bank = {"one": {Variant(1.0, "synth", 0): music}}
    clips = augmented_clips([duet], bank, hfsq, FrameConfig(), options, ConditionConfig(), seed=1)
    sizes = [body_height(clip.leader.numpy()) / body_height(duet.leader) for clip in clips]
    for values, low, high in ((sizes, 0.9, 1.1), ([yaw_of(clip) for clip in clips], -20, 20)):
        assert low - 1e-3 <= min(values) < low + 0.2 * (high - low)
        assert high - 0.2 * (high - low) < max(values) <= high + 1e-3
    starts = [int(clip.music[0][0, 0]) for clip in clips]
    assert set(starts) == {0, 1, 2, 3}
    for clip, start in zip(clips, starts, strict=True):
        assert torch.equal(clip.reactor, torch.from_numpy(duet.reactor[start : start + len(clip.reactor)]))


def test_pairs_of_a_solo_dance_are_silent_mirrored_too_and_turned(hfsq: Autoencoder) -> None:
    solo = Solo("alone", made_dancer(160, 3))
    clips = solo_pair_clips([solo], 5, hfsq, FrameConfig(), ConditionConfig(), seed=1)
    assert len(clips) == 10
    for clip, motion in zip(clips, [solo.motion, mirror_motion(solo.motion)] * 5, strict=True):
        frames = len(clip.leader)
        assert any(torch.equal(clip.leader, torch.from_numpy(motion[c : c + frames])) for c in range(4))
        assert (clip.music, clip.role) == ([], 0.0)
    yaws = [yaw_of(clip) for clip in clips]
    assert -20.001 < min(yaws) < -5
    assert 5 < max(yaws) < 20.001
