"""Whether a dance of two minutes repeats itself: held-out duets one after the other, as one leader.

No single one lasts that long. Each duet is followed by the next and, after the last, by their mirror images, which
count as new movement; its first frame is put where the duet before it ended.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from training.config import FPS
from training.data.augment import mirror
from training.data.duet import Duet
from training.evaluation.metrics.repetition import repetition
from training.evaluation.protocol import HeldOutDuet, ReactorGenerator
from training.motion.heading import heading

FRAMES = 120 * FPS  # two minutes


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


def joined(held_out: Sequence[HeldOutDuet]) -> HeldOutDuet:
    """The duets and their mirror images as one, cut to `FRAMES` if they last longer.

    Music is (T, F) features, zero where a duet's music ends before the duet; None if a duet has none.
    """
    pieces: list[Duet] = []
    music: list[np.ndarray] = []
    for item, duet in [(i, i.duet) for i in held_out] + [(i, mirror(i.duet)) for i in held_out]:
        pieces.append(_continued(duet, pieces[-1]) if pieces else duet)
        if item.music is not None:
            padded = np.zeros((len(duet), item.music.shape[1]), np.float32)
            padded[: len(item.music)] = item.music[: len(duet)]
            music.append(padded)
    leader, reactor = (
        np.concatenate(parts)[:FRAMES] for parts in zip(*((p.leader, p.reactor) for p in pieces), strict=True)
    )
    whole = np.concatenate(music)[:FRAMES] if len(music) == len(pieces) else None
    return HeldOutDuet(Duet("long dance", leader, reactor), whole)


def measure_long_dance(
    generate: ReactorGenerator, held_out: Sequence[HeldOutDuet], seeds: Sequence[int]
) -> dict[str, dict[str, float]]:
    """`repetition` of the true and of the generated reactor, the latter in the mean over seeds; and the length."""
    whole = joined(held_out)
    made = [repetition(generate(whole.duet.leader, whole.music, seed)) for seed in seeds]
    return {
        "length": {"frames": float(len(whole.duet))},
        "truth": repetition(whole.duet.reactor),
        "generated": {key: float(np.mean([row[key] for row in made])) for key in made[0]},
    }
