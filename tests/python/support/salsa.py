"""Made dancers whose feet plant on known counts."""

from __future__ import annotations

import numpy as np

from training.data.duet import FPS, Duet
from training.data.made import made_dancer
from training.data.step_tempo import BEGINNING_FOOT, OTHER_FOOT
from training.motion.skeleton import JOINTS
from training.music.tempo import Tempo


def salsa_steps(frames: int, tempo: Tempo, begins: int) -> np.ndarray:
    """(frames, 22, 3): a standing body whose feet step forward and back, each step 1.2 beats long and ending on its
    count; the steps on 2 and 6 are small."""
    motion = np.repeat(made_dancer(1, seed=0), frames, axis=0)
    beat = np.arange(frames) / FPS * tempo.bpm / 60 - tempo.first * tempo.bpm / 60
    for foot, (ankle, toe) in enumerate((("left_ankle", "left_foot"), ("right_ankle", "right_foot"))):
        path = np.zeros(frames)
        direction = 1.0
        for cycle in range(-2, frames // 8):
            for count in BEGINNING_FOOT if foot == begins else OTHER_FOOT:
                part = np.clip((beat - (8 * cycle + count - 1.2)) / 1.2, 0, 1)
                path += direction * (0.25 if count in (1, 5) else 0.5) * part**2 * (3 - 2 * part)
                direction = -direction
        motion[:, JOINTS.index(ankle), 2] += path
        motion[:, JOINTS.index(toe), 2] += path
    return motion.astype(np.float32)


def salsa_duet(frames: int, tempo: Tempo, name: str = "made") -> Duet:
    """A leader who begins with the left foot and a reactor who mirrors."""
    return Duet(name, salsa_steps(frames, tempo, 0), salsa_steps(frames, tempo, 1))
