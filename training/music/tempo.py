"""A constant tempo in counts of eight."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

CYCLE = 8
"""Beats after which the steps of salsa repeat: the eight counts."""


@dataclass(frozen=True)
class Tempo:
    """A constant tempo and phase: count 1 of the eight is `first` + k * 8 * 60 / `bpm` seconds after frame 0."""

    bpm: float
    first: float

    def warped(self, factor: float) -> Tempo:
        """The tempo of the same dance `factor` times as fast."""
        return Tempo(self.bpm * factor, self.first / factor)

    def counts(self, seconds: np.ndarray) -> np.ndarray:
        """Position in the eight counts, from 0, of times in seconds; in [0, 8)."""
        return (seconds - self.first) * self.bpm / 60 % CYCLE

    def beats(self, duration: float) -> tuple[np.ndarray, np.ndarray]:
        """Times in seconds of all beats in [0, duration), and the count of each: 0 to 7."""
        period = 60 / self.bpm
        start = int(np.ceil(-self.first / period))
        stop = int(np.ceil((duration - self.first) / period))
        index = np.arange(start, stop)
        return self.first + index * period, index % CYCLE
