"""What evaluation takes: a model as a function, held-out duets with their music, and how much to measure.

Every motion is (T, 22, 3) metres, y up, at 30 fps; music is (T, 54) features of the same frames.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from training.data.duet import Duet

# Rows of an evaluation that are not named by what was passed in.
TRUTH, GENERATED, COARSE_ALONE = "truth", "generated", "generated, coarse alone"


class ReactorGenerator(Protocol):
    """A model as evaluation sees it: a function from a leader and music to a reactor."""

    def __call__(
        self,
        leader: np.ndarray,
        music: np.ndarray | None,
        seed: int,
        *,
        condition_leader: np.ndarray | None = None,
        guidance: tuple[float, float] | None = None,
        music_guidance: float | None = None,
        variety: float | None = None,
        role: float = 0.0,
    ) -> np.ndarray:
        """The reactor (T, 22, 3) metres, at the leader's own size.

        leader: (T, 22, 3) metres. music: (T', 54) features, None for silence. condition_leader: (T, 22, 3),
        takes the leader's place in the condition, while the reactor is still decoded beside `leader`.
        guidance of the coarse and the fine layer, music_guidance and variety: weights of the controls, None for the
        model's defaults; fine -1 leaves the coarse layer alone. role: 0 generates the reactor, 1 the leader of a
        partner in the leader's place.
        """
        ...


class Solver(Protocol):
    """Fits a skeleton of constant bone lengths to generated joints, as they are drawn and exported."""

    def __call__(
        self, motions: Sequence[np.ndarray], leader: np.ndarray, music: np.ndarray | None, /
    ) -> list[np.ndarray]:
        """The fitted form of each motion (T, 22, 3), as a partner of the leader (T, 22, 3) to the music (T', 54);
        metres.
        """
        ...


@dataclass(frozen=True)
class HeldOutDuet:
    """A duet that was not trained on and its music, (T, 54) features or None."""

    duet: Duet
    music: np.ndarray | None


@dataclass(frozen=True, eq=False)
class ControlledDance:
    """A leader beside whom the controls are moved, with two songs, and the true reactor where there is one."""

    leader: np.ndarray
    music: np.ndarray | None
    other_music: np.ndarray | None
    reactor: np.ndarray | None


@dataclass(frozen=True)
class Settings:
    """How much is measured."""

    seeds: tuple[int, ...] = (0, 1, 2, 3, 4)
    seam_starts: tuple[int, ...] = (0, 60, 120, 180)  # frames cut off the start, to move the boundaries
    response_seeds: int = 3  # seeds with which conditions are changed
    two_sample: bool = True  # train networks to tell generated from true windows
    phase_seeds: int = 0  # seeds of the half-beat test; 0 leaves it out, 16 are needed for p < 0.01
    guidance_grid: tuple[float, ...] = ()
    """Values of coarse and fine guidance at every step to try (the paper's Table 4); none leaves it out."""
    controls: bool = False  # move every control over its travel
    controlled_leaders: tuple[str, ...] = ()
    """Names of out-of-distribution leaders beside whom controls are moved too."""
    beats_unknown: tuple[str, ...] = ()
    """Held-out duets whose music has no reliable beats: their beat alignment has no threshold."""
    seen_leaders: tuple[str, ...] = ()
    """How the names of out-of-distribution leaders begin whose dances were in the training data; when left out, as the
    checkpoint says of its trainings."""


Motions = dict[str, list[np.ndarray]]
"""By name of the held-out duet: one motion (T, 22, 3) per seed, or a single one where nothing is random."""


def fit_length(values: np.ndarray, frames: int) -> np.ndarray:
    """Values per frame (T, ...), cut or played forwards and backwards in turn until there are `frames` of them."""
    period = np.concatenate([values, values[-2:0:-1]])
    return np.concatenate([period] * (frames // len(period) + 1))[:frames]
