"""Experiments on generators made from formulas, whose seams and beats are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.python.support.held_out import generate_mirrored
from training.evaluation.metrics.beats import BEAT_COLUMN
from training.evaluation.probes import measure_beat_following, measure_responses, measure_seams
from training.evaluation.protocol import HeldOutDuet, Settings, fit_length


def test_a_motion_is_made_longer_forwards_and_backwards():
    motion = np.arange(4.0)[:, None, None] * np.ones((1, 22, 3))
    assert list(fit_length(motion, 9)[:, 0, 0]) == [0, 1, 2, 3, 2, 1, 0, 1, 2]
    assert list(fit_length(motion, 2)[:, 0, 0]) == [0, 1]


def test_seams_are_found_at_block_boundaries(held_out: list[HeldOutDuet]):
    """A motion that jumps at every 240th frame of what is generated, wherever the leader was cut."""

    def jumping(
        leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
    ):
        reactor = next(
            i.duet.reactor[-len(leader) :] for i in held_out if np.array_equal(i.duet.leader[-1], leader[-1])
        )
        return reactor + np.where((np.arange(len(leader)) // 240) % 2 == 1, 0.05, 0.0)[:, None, None]

    whole = {i.duet.name: [jumping(i.duet.leader, None, 0)] for i in held_out}
    settings = Settings(seeds=(0,), seam_starts=(0, 60, 120))
    found = measure_seams(jumping, held_out, whole, 240, settings)
    assert found["seams"] == 2 + 2 + 1 + 2 + 1 + 1
    assert found["ratio"] > 3
    assert found["paper_jitter_mm"] > found["paper_jitter_truth_mm"]

    def true(
        leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
    ):
        return next(
            i.duet.reactor[-len(leader) :] for i in held_out if np.array_equal(i.duet.leader[-1], leader[-1])
        )

    seamless = measure_seams(true, held_out, {i.duet.name: [i.duet.reactor] for i in held_out}, 240, settings)
    assert seamless["ratio"] == pytest.approx(1.0)  # compared with the truth at the same frames
    assert seamless["paper_jitter_mm"] == pytest.approx(seamless["paper_jitter_truth_mm"])
    between = measure_seams(jumping, held_out, whole, 200, replace(settings, seam_starts=(0,)))
    assert between["ratio"] == pytest.approx(1.0, abs=0.01)


def test_motion_that_slows_down_on_the_beat_is_told_from_motion_that_ignores_the_music(
    held_out: list[HeldOutDuet],
):
    def pulsing(
        leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
    ):
        beats = np.flatnonzero(music[:, BEAT_COLUMN])
        phase = (np.arange(len(leader)) - beats[0]) / 20
        speed = (
            1.0 - np.cos(2 * np.pi * phase) + np.random.default_rng(seed).normal(scale=0.1, size=len(leader))
        )
        return (np.cumsum(speed) * 0.01)[:, None, None] * np.ones((1, 22, 3))

    def unchanging(
        leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
    ):
        return pulsing(leader, held_out[0].music, seed)

    assert measure_beat_following(pulsing, held_out[:1], 12)["one"]["p"] < 0.01
    assert measure_beat_following(unchanging, held_out[:1], 12)["one"]["p"] > 0.5


def test_a_single_duet_has_no_other_leader_and_no_other_song(held_out: list[HeldOutDuet]):
    motions = {
        i.duet.name: [generate_mirrored(i.duet.leader, i.music, seed) for seed in (0, 1)] for i in held_out
    }
    both, alone = (
        measure_responses(generate_mirrored, duets, motions, Settings(seeds=(0, 1), response_seeds=2))
        for duets in (held_out, held_out[:1])
    )
    others = {
        "change_other_leader",
        "root_error_other_leader_mm",
        "change_other_song",
        "other_leader_raises_root_error",
        "song_over_leader",
    }
    assert set(both) - set(alone) == others
    assert alone["change_half_beat"] > 0
    raised = both["root_error_other_leader_mm"] / both["root_error_mm"] - 1
    assert both["other_leader_raises_root_error"] == pytest.approx(raised)
    assert both["song_over_leader"] == pytest.approx(both["change_other_song"] / both["change_other_leader"])
