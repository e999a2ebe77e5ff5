"""The video shows each couple in a column of its own, from two sides."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from tests.python.support.couple import couple
from tests.python.support.read_webm import frames
from training.evaluation.report.filmstrip import LEADER, REACTOR
from training.evaluation.report.video import CAPTION_PIXELS, CELL_PIXELS, pictures, write_video


def pixels(picture: np.ndarray, colour: str) -> np.ndarray:
    """Where a colour is, (N, 2) rows and columns."""
    distance = np.abs(picture.astype(float) - np.array(to_rgb(colour)) * 255).max(axis=-1)
    return np.argwhere(distance < 12)


def cell(picture: np.ndarray, column: int, row: int) -> np.ndarray:
    top, left = CAPTION_PIXELS + row * CELL_PIXELS[1], column * CELL_PIXELS[0]
    return picture[top : top + CELL_PIXELS[1], left : left + CELL_PIXELS[0]]


def test_a_film_of_two_couples(tmp_path: Path):
    leader, truth = couple(45)
    made = truth + np.linspace(0, 0.6, 45)[:, None, None] * np.array([0.0, 0.0, 1.0])
    path = write_video(leader, {"truth": truth, "generated": made}, tmp_path / "two.webm")
    read = frames(path.read_bytes())
    assert len(read) == 45
    assert read[-1][0] == pytest.approx(44 / 30 * 1000, abs=1)
    last = np.asarray(read[-1][1])
    assert last.shape == (2 * CELL_PIXELS[1] + CAPTION_PIXELS, 2 * CELL_PIXELS[0], 3)
    for column in (0, 1):
        for row in (0, 1):
            for colour in (LEADER, REACTOR):  # VP8 blurs colours, heads are large enough to keep theirs
                lenient = np.abs(cell(last, column, row) - np.array(to_rgb(colour)) * 255).max(axis=-1) < 40
                assert lenient.sum() > 50, (column, row, colour)


def test_true_and_generated_stand_where_they_are():
    leader, truth = couple(30)
    made = truth + np.linspace(0, 0.6, 30)[:, None, None] * np.array([0.0, 0.0, 1.0])
    shown = [np.asarray(picture) for picture in pictures(leader, {"truth": truth, "generated": made})]

    def apart(picture: np.ndarray, column: int, row: int) -> float:
        """Pixels between the middles of leader and reactor."""
        part = cell(picture, column, row)
        return abs(float(np.median(pixels(part, REACTOR)[:, 1]) - np.median(pixels(part, LEADER)[:, 1])))

    # From the front they stand 0.8 m apart, the generated reactor at last 1.4 m.
    assert apart(shown[0], 1, 0) == pytest.approx(apart(shown[0], 0, 0), abs=2)
    assert apart(shown[-1], 1, 0) / apart(shown[-1], 0, 0) == pytest.approx(1.4 / 0.8, rel=0.05)
    # From the side one stands behind the other.
    assert apart(shown[-1], 1, 1) < 0.4 * apart(shown[-1], 1, 0)
    # Feet are at the bottom of the cell, heads above them.
    rows = np.argwhere((cell(shown[0], 0, 0) < 200).any(axis=(1, 2)))[
        :, 0
    ]  # darker than the line of the floor
    assert 0.85 * CELL_PIXELS[1] < rows.max() < 0.97 * CELL_PIXELS[1]
    assert pixels(cell(shown[0], 0, 0), LEADER)[:, 0].min() < 0.5 * CELL_PIXELS[1]


def test_one_couple_fills_the_picture():
    leader, truth = couple(20)
    first = np.asarray(next(pictures(leader, {"generated": truth})))
    assert first.shape == (2 * CELL_PIXELS[1] + CAPTION_PIXELS, CELL_PIXELS[0], 3)
    assert len(pixels(first, LEADER)) > 50
    with pytest.raises(ValueError, match="20 frames"):
        next(pictures(leader, {}))


def test_nobody_leaves_the_picture():
    leader, truth = couple(20)
    far = truth + np.array([0.0, 0.0, 4.0])
    last = np.asarray(list(pictures(leader, {"truth": truth, "generated": far}))[-1])
    columns = pixels(cell(last, 1, 0), REACTOR)[:, 1]
    assert len(columns) > 50
    assert 2 < columns.min() < columns.max() < CELL_PIXELS[0] - 2
    with pytest.raises(ValueError, match="side by side"):
        next(pictures(leader, {"truth": truth[:5], "generated": far}))
