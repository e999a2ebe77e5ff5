"""Held-out duets and generator functions made from formulas, whose responses are known."""

from __future__ import annotations

import numpy as np

from tests.python.support.duets import made_duet
from training.data.duet import Duet
from training.evaluation.baselines import mirrored_leader
from training.evaluation.metrics.beats import BEAT_COLUMN
from training.evaluation.protocol import HeldOutDuet


def made_music(frames: int, period: int, first: int = 0) -> np.ndarray:
    """Features (frames, 54) with a beat every `period` frames from `first` on."""
    features = np.zeros((frames, 54), np.float32)
    features[first::period, BEAT_COLUMN] = 1.0
    return features


def made_held_out() -> list[HeldOutDuet]:
    """Two duets, `one` and `two`, with music."""
    return [
        HeldOutDuet(made_duet(560, 1, "one"), made_music(560, 20)),
        HeldOutDuet(made_duet(500, 2, "two"), made_music(500, 24)),
    ]


def made_train() -> list[Duet]:
    return [made_duet(400, seed) for seed in (3, 4)]


def generate_mirrored(
    leader, music, seed, condition_leader=None, guidance=None, music_guidance=None, variety=None, role=0.0
) -> np.ndarray:
    """Mirrors the leader of the condition; the head leans by a seed's random offset and nods on every beat."""
    condition = leader if condition_leader is None else condition_leader
    made = mirrored_leader(condition, 0.8).astype(np.float64)
    made += leader[:, :1] - condition[:, :1]
    made[:, 15] += np.random.default_rng(seed).normal(scale=0.05, size=3)
    if music is not None:
        made[: len(music), 15, 1] -= 0.2 * music[: len(made), BEAT_COLUMN]
    return made
