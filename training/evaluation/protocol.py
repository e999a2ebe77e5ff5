"""What evaluation takes: a model as a function, held-out duets with their music, and how much to measure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from training.data.duet import Duet


class Dancer(Protocol):
    """A model as evaluation sees it."""

    def __call__(
        self,
        leader: np.ndarray,
        music: np.ndarray | None,
        seed: int,
        heard_leader: np.ndarray | None = None,
        guidance: tuple[float, float] | None = None,
        coarse_only: bool = False,
        role: float = 0.0,
    ) -> np.ndarray:
        """The reactor (T, 22, 3) metres, at the leader's own size, to a leader (T, 22, 3) and music (T',
        54) or None.

        heard_leader: (T, 22, 3), what the condition is made of where that is not the leader it dances with.
        guidance: coarse and fine for all streams, None for the default. coarse_only: decoded without the
        fine layer. role: 0 dances the reactor, 1 the leader, to a partner in the leader's place.
        """
        ...


class Solver(Protocol):
    """What makes a body of constant bone lengths of generated joints, to be drawn and exported."""

    def __call__(self, motion: np.ndarray, leader: np.ndarray, /) -> np.ndarray:
        """The motion (T, 22, 3) metres, solved beside the leader (T, 22, 3) that it dances with."""
        ...


@dataclass(frozen=True)
class Trial:
    """A held-out duet and the music it is danced to, (T, 54) features or None."""

    duet: Duet
    music: np.ndarray | None


@dataclass(frozen=True)
class Settings:
    seeds: tuple[int, ...] = (0, 1, 2, 3, 4)
    seam_spacing: int = 240  # frames between block boundaries; half of it with alternating block phase
    seam_starts: tuple[int, ...] = (0, 60, 120, 180)  # frames cut off the start, to move the boundaries
    response_seeds: int = 3  # seeds with which conditions are changed
    two_sample: bool = True  # train networks to tell generated from true windows
    phase_seeds: int = 0  # seeds of the half-beat test; 0 leaves it out, 16 are needed for p < 0.01
    guidance_grid: tuple[float, ...] = ()  # values of coarse and fine guidance to try; none leaves it out


Motions = dict[str, list[np.ndarray]]
"""By name of the trial: one motion per seed, or a single one where there is no chance in it."""


def fit_length(motion: np.ndarray, frames: int) -> np.ndarray:
    """Cut, or played forth and back, to a number of frames: longer without a jump."""
    period = np.concatenate([motion, motion[-2:0:-1]])
    return np.concatenate([period] * (frames // len(period) + 1))[:frames]
