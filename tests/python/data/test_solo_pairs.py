"""Pairs made from solo dances: the mirror image keeps its distance, and there is no song."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from training.config import ConditionConfig, FrameConfig, HfsqConfig
from training.data.duet import Solo
from training.data.made import made_dancer
from training.data.solo_pairs import AHEAD, solo_pair
from training.denoiser.clips import solo_pair_clips
from training.denoiser.windows import Windows
from training.evaluation.metrics.errors import bone_variation
from training.hfsq.autoencoder import Autoencoder
from training.motion.skeleton import JOINTS, MIRROR

LEFT, RIGHT = JOINTS.index("left_wrist"), JOINTS.index("right_wrist")


def test_the_image_stands_ahead_and_moves_the_other_hand() -> None:
    """Someone who faces +z and stands still sees themselves 0.9 m ahead, facing back, left and right changed."""
    still = np.repeat(made_dancer(1, 0), 60, axis=0)
    still -= still[:, :1] * [1, 0, 1]
    pair = solo_pair(Solo("still", still.astype(np.float32)), 0.45)
    offset = pair.reactor[0, 0] - pair.leader[0, 0]
    assert np.linalg.norm(offset[[0, 2]]) == pytest.approx(0.9, abs=1e-3)
    assert offset[1] == pytest.approx(0, abs=1e-5)
    # Mirrored joints are each other's images: as far apart as two points across the mirror, at one height.
    for joint, other in enumerate(MIRROR):
        assert pair.reactor[0, joint, 1] == pytest.approx(pair.leader[0, other, 1], abs=1e-5)
    ahead = offset / np.linalg.norm(offset)
    across = (pair.reactor[0, LEFT] - pair.leader[0, RIGHT]) - ahead * (
        (pair.reactor[0, LEFT] - pair.leader[0, RIGHT]) @ ahead
    )
    assert np.abs(across).max() < 1e-4


def test_the_image_is_a_body_that_never_meets_the_soloist_who_keeps_their_place() -> None:
    motion = made_dancer(240, 3)
    pair = solo_pair(Solo("dance", motion), AHEAD[0])
    assert bone_variation(pair.reactor) == pytest.approx(bone_variation(pair.leader), abs=1e-4)
    gap = np.linalg.norm((pair.reactor - pair.leader)[:, 0, [0, 2]], axis=-1)
    assert gap.min() > 0.4 and gap.max() < 1.4


def test_clips_are_silent_and_differ() -> None:
    torch.manual_seed(0)
    hfsq = Autoencoder(HfsqConfig(groups=2, widths=(16, 16, 8), depth=1, refine_width=8)).eval()
    solos = [Solo("a", made_dancer(120, 1)), Solo("b", made_dancer(90, 2))]
    config = ConditionConfig(drop_music=0.0)
    clips = solo_pair_clips(solos, 2, hfsq, FrameConfig(), config, seed=0)
    assert [len(clip.music) for clip in clips] == [0] * 8
    assert all(clip.role == 0.0 for clip in clips)
    assert not torch.equal(clips[0].reactor[:80], clips[2].reactor[:80])  # another distance
    batch = Windows(clips, 6, 2, 4, config).batch(12, np.random.default_rng(0), short=0.0)
    assert batch.music_valid.abs().max() == 0
    assert batch.inside.max() == 1
