"""A known oscillation has its power where it belongs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.image import imread

from training.evaluation.protocol import COARSE_ALONE
from training.evaluation.report.filmstrip import REACTOR
from training.evaluation.report.spectra import EDGES_HZ, draw_spectra, spectrum


def swinging(hertz: float, frames: int = 900) -> np.ndarray:
    """22 joints that swing with 1 m/s at most along x."""
    x = np.sin(2 * np.pi * hertz * np.arange(frames) / 30) / (2 * np.pi * hertz)
    return x[:, None, None] * np.ones((1, 22, 1)) * np.array([1.0, 0.0, 0.0])


def test_power_is_where_the_oscillation_is():
    edges = np.array([0.2, 1.0, 3.0, 6.0, 15.0])
    slow = spectrum(swinging(2.0), edges)
    assert slow.argmax() == 1
    assert slow[1] * 2.0 == pytest.approx(0.5, rel=0.02)  # (m/s)^2: the mean square of a sine's speed
    assert slow[[0, 2, 3]] == pytest.approx(np.zeros(3), abs=1e-3)
    # Ten times the speed, a hundred times the power; a joint that stands still counts as well.
    assert spectrum(10 * swinging(2.0), edges)[1] == pytest.approx(100 * slow[1])
    half = swinging(2.0)
    half[:, :11] = 0
    assert spectrum(half, edges)[1] == pytest.approx(slow[1] / 2)
    assert np.isnan(spectrum(swinging(2.0, 40), EDGES_HZ)[0])  # 0.04 Hz wide, of 1.3 s


def test_the_picture_has_a_line_for_each_known_row(tmp_path: Path):
    def orange(rows: dict[str, list[np.ndarray]]) -> int:
        image = imread(draw_spectra(rows, tmp_path / "spectra.png"))[..., :3]
        return int((np.abs(image - np.array(to_rgb(REACTOR))).max(axis=-1) < 0.02).sum())

    noise = np.cumsum(np.random.default_rng(0).normal(scale=0.01, size=(600, 22, 3)), axis=0)
    none = orange({"truth": [noise], "mean pose": [noise]})
    one = orange({"truth": [noise], "generated": [2 * noise]})
    two = orange({"truth": [noise], "generated": [2 * noise], COARSE_ALONE: [noise]})
    assert none == 0 < one < two
