"""Whether a dance of two minutes repeats itself: held-out dances one after the other, as one leader.

No single trial lasts that long. Each dance is followed by the next and, when all have been danced, by their
mirror images, which count as new movement; its first frame is put where the dance before it ended.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from training.data.augment import mirror
from training.data.duet import Duet
from training.evaluation.metrics.repetition import repetition
from training.evaluation.protocol import Dancer, Trial
from training.motion.heading import heading

FRAMES = 3600  # two minutes at 30 fps


def _continued(duet: Duet, after: Duet) -> Duet:
    """The duet moved on the floor and turned, so that its leader begins where and as the other's ended."""
    to, of = heading(after.leader[-1:])[0], heading(duet.leader[:1])[0]
    c, s = to @ of, to[0] * of[1] - to[1] * of[0]
    turn = np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]])
    floor = np.array([1.0, 0.0, 1.0])
    start, end = duet.leader[0, 0] * floor, after.leader[-1, 0] * floor

    def moved(motion: np.ndarray) -> np.ndarray:
        return ((motion - start) @ turn + end).astype(np.float32)

    return Duet(duet.name, moved(duet.leader), moved(duet.reactor))


def joined(trials: Sequence[Trial], frames: int = FRAMES) -> Trial:
    """The trials and their mirror images as one, cut to a number of frames, or as long as they last."""
    pieces: list[Duet] = []
    music: list[np.ndarray] = []
    for trial, duet in [(t, t.duet) for t in trials] + [(t, mirror(t.duet)) for t in trials]:
        pieces.append(_continued(duet, pieces[-1]) if pieces else duet)
        if trial.music is not None:
            heard = np.zeros((len(duet), trial.music.shape[1]), np.float32)
            heard[: len(trial.music)] = trial.music[: len(duet)]
            music.append(heard)
    leader, reactor = (
        np.concatenate(parts)[:frames] for parts in zip(*((p.leader, p.reactor) for p in pieces), strict=True)
    )
    whole = np.concatenate(music)[:frames] if len(music) == len(pieces) else None
    return Trial(Duet("long dance", leader, reactor), whole)


def measure_long_dance(
    dancer: Dancer, trials: Sequence[Trial], seeds: Sequence[int]
) -> dict[str, dict[str, float]]:
    """`repetition` of the true and of the generated reactor, the latter in the mean over seeds; and the length."""
    trial = joined(trials)
    made = [repetition(dancer(trial.duet.leader, trial.music, seed)) for seed in seeds]
    return {
        "length": {"frames": float(len(trial.duet))},
        "truth": repetition(trial.duet.reactor),
        "generated": {key: float(np.mean([row[key] for row in made])) for key in made[0]},
    }
