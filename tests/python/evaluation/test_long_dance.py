"""A dance of two minutes made of shorter ones: seamless for the leader, and measured against its own truth."""

from __future__ import annotations

import numpy as np
import pytest

from tests.python.support.duets import made_duet
from training.data.augment import mirror
from training.evaluation.long_dance import joined, measure_long_dance
from training.evaluation.metrics.distance import root_distance
from training.evaluation.protocol import HeldOutDuet
from training.motion.heading import heading


@pytest.fixture(scope="module")
def held_out() -> list[HeldOutDuet]:
    return [HeldOutDuet(made_duet(frames, seed), None) for frames, seed in ((300, 1), (260, 2))]


def test_each_dance_begins_where_and_as_the_one_before_ended(held_out: list[HeldOutDuet]) -> None:
    whole = joined(held_out).duet
    assert len(whole) == 2 * (300 + 260)
    for border in (300, 560, 860):
        before, after = whole.leader[border - 1 : border], whole.leader[border : border + 1]
        assert np.abs(after[0, 0, [0, 2]] - before[0, 0, [0, 2]]).max() < 1e-4
        assert heading(after)[0] == pytest.approx(heading(before)[0], abs=1e-4)


def test_both_dancers_are_moved_together(held_out: list[HeldOutDuet]) -> None:
    whole, second = joined(held_out).duet, held_out[1].duet
    part = slice(300, 560)
    apart = root_distance(whole.leader[part], whole.reactor[part])
    assert apart == pytest.approx(root_distance(second.leader, second.reactor), abs=1e-4)
    mirrored = mirror(second)
    part = slice(860, 1120)
    assert root_distance(whole.leader[part], whole.reactor[part]) == pytest.approx(
        root_distance(mirrored.leader, mirrored.reactor), abs=1e-4
    )
    bones = np.linalg.norm(whole.leader[part, 4] - whole.leader[part, 1], axis=-1)
    assert bones == pytest.approx(
        np.linalg.norm(mirrored.leader[:, 4] - mirrored.leader[:, 1], axis=-1), abs=1e-4
    )


def test_music_follows_its_dance_and_falls_silent_with_it(held_out: list[HeldOutDuet]) -> None:
    with_music = [
        HeldOutDuet(t.duet, np.full((250, 54), i + 1.0, np.float32)) for i, t in enumerate(held_out)
    ]
    music = joined(with_music).music
    assert music is not None
    assert [music[i, 0] for i in (0, 249, 250, 300, 549, 550, 560)] == [1, 1, 0, 2, 2, 0, 1]


def test_a_looped_motion_repeats_and_the_truth_scores_as_itself(held_out: list[HeldOutDuet]) -> None:
    def loop(leader: np.ndarray, *_: object, **__: object) -> np.ndarray:
        return np.concatenate([held_out[0].duet.reactor[:150]] * (len(leader) // 150 + 1))[: len(leader)]

    measured = measure_long_dance(loop, held_out, [0])
    assert measured["generated"]["repeat_share"] > 0.9
    assert measured["length"]["frames"] == 1120

    def truth(leader: np.ndarray, *_: object, **__: object) -> np.ndarray:
        return joined(held_out).duet.reactor

    same = measure_long_dance(truth, held_out, [0, 1])
    assert same["generated"] == same["truth"]
