"""Energy by frequency, drawn: over-smoothing, noise, and what the fine layer adds to the coarse one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from training.config import FPS
from training.evaluation.protocol import COARSE_ALONE, GENERATED, TRUTH
from training.evaluation.report.filmstrip import INK, PAPER, REACTOR, RULE

EDGES_HZ = np.geomspace(0.2, 15.0, 25)  # of the bins that are drawn
# What is drawn of an evaluation's rows: line colour and style.
LINES: dict[str, tuple[str, str]] = {
    TRUTH: (INK, "-"),
    "reconstruction": ("#4fa36a", "-"),
    "reconstruction, coarse alone": ("#4fa36a", "--"),
    GENERATED: (REACTOR, "-"),
    COARSE_ALONE: (REACTOR, "--"),
}


def spectrum(motion: np.ndarray, edges: np.ndarray = EDGES_HZ) -> np.ndarray:
    """Power density of the joint velocities of (T, J, 3) metres between each two edges (Hz), (m/s)^2 per Hz.

    One periodogram of the whole clip under a Hann window, summed over x, y, z and averaged over joints and the
    bin's frequencies; NaN in bins narrower than the clip can tell apart.
    """
    velocity = np.diff(motion.astype(np.float64), axis=0) * FPS
    window = np.hanning(len(velocity))
    power = np.abs(np.fft.rfft(velocity * window[:, None, None], axis=0)) ** 2
    density = 2 * power.sum(axis=2).mean(axis=1) / (FPS * (window**2).sum())
    bins = np.digitize(np.fft.rfftfreq(len(velocity), 1 / FPS), edges) - 1
    bins[bins == len(edges) - 1] = -1  # above the last edge
    inside = bins >= 0
    count = np.bincount(bins[inside], minlength=len(edges) - 1)
    total = np.bincount(bins[inside], density[inside], minlength=len(edges) - 1)
    return np.where(count > 0, total / np.maximum(count, 1), np.nan)


def draw_spectra(rows: Mapping[str, Sequence[np.ndarray]], path: Path) -> Path:
    """PNG with a line for each row of `LINES` that is there: the mean spectrum of its motions."""
    figure = Figure(figsize=(8, 4.5), facecolor=PAPER)
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    middle = np.sqrt(EDGES_HZ[1:] * EDGES_HZ[:-1])
    for name, (colour, style) in LINES.items():
        if name not in rows:
            continue
        mean = np.mean([spectrum(motion) for motion in rows[name]], axis=0)
        known = np.isfinite(mean) & (mean > 0)
        axes.loglog(middle[known], mean[known], label=name, color=colour, linestyle=style, linewidth=1.8)
    axes.set(xlabel="Hz", ylabel="joint velocity, (m/s)² per Hz")
    axes.grid(color=RULE)
    axes.legend(frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    return path
