"""Duets made from formulas."""

from __future__ import annotations

import numpy as np

from training.data.duet import Duet
from training.data.made import made_dancer


def made_duet(frames: int, seed: int, name: str | None = None) -> Duet:
    """Two made dancers 0.8 m apart; the reactor follows the leader's root a quarter of a second late."""
    leader, reactor = made_dancer(frames, seed), made_dancer(frames, seed + 1000)
    delayed = np.concatenate([np.repeat(leader[:1, :1], 8, axis=0), leader[:-8, :1]])[:frames]
    shift = (delayed - reactor[:, :1]) * np.array([1, 0, 1], dtype=np.float32)
    shift = shift + np.array([0.8, 0, 0], dtype=np.float32)
    return Duet(name or f"made_{seed}", leader, (reactor + shift).astype(np.float32))
