"""The two-sample test tells what differs and does not tell what does not."""

from __future__ import annotations

import numpy as np
import pytest

from tests.python.support.duets import made_duet
from training.evaluation.metrics.twosample import (
    SEGMENT_FRAMES,
    WINDOW_FRAMES,
    couple_windows,
    truth_against_truth,
    two_sample_accuracy,
)


def couples(frames: int = 750) -> list[tuple[np.ndarray, np.ndarray]]:
    return [(d.leader, d.reactor) for d in (made_duet(frames, 1), made_duet(frames, 2))]


def test_windows_lie_inside_segments_and_ignore_the_room():
    (leader, reactor), _ = couples(400)
    windows, groups = couple_windows([(leader, reactor)])
    assert windows.shape[1:] == (WINDOW_FRAMES, 264)
    assert list(np.unique(groups)) == [0, 1]
    turn = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]], np.float32)
    moved, _ = couple_windows([(leader @ turn + np.float32(3), reactor @ turn + np.float32(3))])
    # Heights are kept, so only the shift along y remains.
    expected = windows.reshape(len(windows), WINDOW_FRAMES, 2, 44, 3) + np.array([[[0, 3, 0]], [[0, 0, 0]]])
    assert moved.reshape(expected.shape) == pytest.approx(expected, abs=1e-4)
    with pytest.raises(ValueError, match=str(SEGMENT_FRAMES)):
        couple_windows([(leader[:100], reactor[:100])])


def test_a_stiff_reactor_is_told_from_a_true_one():
    true = couples()
    stiff = [(lead, lead[:, :1] + (react - lead[:, :1]).mean(axis=0)) for lead, react in true]
    assert two_sample_accuracy(true, stiff) > 0.9


def test_the_same_couples_cannot_be_told_apart():
    true = couples()
    assert two_sample_accuracy(true, true) == pytest.approx(0.5, abs=0.02)
    assert 0.25 < truth_against_truth(true, repeats=1) < 0.75
    with pytest.raises(ValueError, match="same lengths"):
        two_sample_accuracy(true, true[:1])


def test_a_centimetre_of_jitter_is_told_from_the_truth():
    true = couples()
    noise = np.random.default_rng(0).normal(scale=0.01, size=true[0][1].shape)
    assert two_sample_accuracy(true, [(lead, react + noise) for lead, react in true]) > 0.9


@pytest.mark.filterwarnings("error")
def test_too_short_a_truth_has_no_accuracy():
    short = couples(SEGMENT_FRAMES)[:1]
    assert np.isnan(truth_against_truth(short))
    assert np.isnan(two_sample_accuracy(short, short))
