"""Filmstrips show both dancers, from the angles they claim, at the moments they claim."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.image import imread

from tests.python.support.couple import couple
from training.evaluation.report.filmstrip import LEADER, REACTOR, TRUTH, filmstrip, views


def share(image: np.ndarray, colour: str) -> float:
    """Share of pixels that are nearly of a colour."""
    return float((np.abs(image[..., :3] - np.array(to_rgb(colour))).max(axis=-1) < 0.05).mean())


def test_views_are_right_handed_and_look_across_the_couple():
    leader, reactor = couple()
    front, side, top = views(leader, reactor)
    for view in (front, side, top):
        assert np.linalg.norm([view.right, view.up, view.eye], axis=1) == pytest.approx(np.ones(3))
        assert np.cross(view.right, view.up) == pytest.approx(view.eye)
    assert abs(front.right[2]) == pytest.approx(1.0)  # the two stand side by side on the page
    assert abs(side.right[0]) == pytest.approx(1.0)
    assert top.eye == pytest.approx(np.array([0.0, 1.0, 0.0]))  # seen from above, not from below
    assert front.up == pytest.approx(np.array([0.0, 1.0, 0.0]))


def test_both_dancers_are_drawn(tmp_path: Path):
    leader, reactor = couple()
    image = imread(filmstrip(leader, reactor, tmp_path / "strip.png", poses=4))
    assert image.shape[1] > image.shape[0] / 2
    assert share(image, LEADER) > 0.002
    assert share(image, REACTOR) > 0.002
    assert share(image, "#ffffff") > 0.5


def test_the_truth_is_drawn_only_when_given(tmp_path: Path):
    leader, reactor = couple()
    plain = imread(filmstrip(leader, reactor, tmp_path / "a.png", poses=3))
    ghost = imread(filmstrip(leader, reactor, tmp_path / "b.png", truth=reactor + 0.1, poses=3))
    assert share(ghost, TRUTH) > share(plain, TRUTH)


def test_only_the_moments_asked_for_are_drawn(tmp_path: Path):
    leader, reactor = couple()
    moved = reactor.copy()
    moved[:30] += 0.3
    moved[151:] += 0.3
    one = imread(filmstrip(leader, reactor, tmp_path / "a.png", poses=5, start=1.0, seconds=4.0))
    same = imread(filmstrip(leader, moved, tmp_path / "b.png", poses=5, start=1.0, seconds=4.0))
    other = imread(filmstrip(leader, moved, tmp_path / "c.png", poses=5, start=1.0, seconds=5.0))
    assert (one == same).all()
    assert other.shape != one.shape or (other != one).any()
    with pytest.raises(ValueError, match="nothing to show"):
        filmstrip(leader, reactor, tmp_path / "d.png", start=20.0)
