"""Puts a dancer on the floor y = 0."""

from __future__ import annotations

import numpy as np

from training.motion.skeleton import TOES

# Height of the toe joint (ball of the foot) of a planted foot: about half the thickness of a shoe there.
TOE_REST = 0.03
# Share of frames whose lower toe may lie below a planted one: noise and glitches, not the floor.
TOE_PERCENTILE = 10.0


def lower_toe(motion: np.ndarray) -> np.ndarray:
    """(T,) height of the lower of the two toe joints of (T, 22, 3)."""
    return motion[:, list(TOES), 1].min(axis=1)


def floor_height(motion: np.ndarray) -> float:
    """Height of the floor under a dancer, from planted toes.

    motion: (T, 22, 3) metres, y up. In almost every frame of a dance one foot stands, so a low percentile
    over time of the lower toe is a planted toe, which rests TOE_REST above the floor. Frames that are not finite do
    not count, so that whoever checks the motion afterwards can name them.
    """
    heights = lower_toe(motion)
    known = heights[np.isfinite(heights)]
    return float(np.percentile(known, TOE_PERCENTILE)) - TOE_REST if len(known) else 0.0


def put_on_floor(motion: np.ndarray) -> np.ndarray:
    """The same (T, 22, 3) motion with its floor at y = 0.

    Each dancer is measured alone. Both stand on one floor, so a difference between the two measures is an
    error of capture or conversion (up to 3.5 cm in the salsa, and not constant over its trials); and a leader
    must come out the same whether or not the reactor is known.
    """
    shift = np.array([0.0, floor_height(motion), 0.0], dtype=np.float32)
    return (motion - shift).astype(np.float32)
