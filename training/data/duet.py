"""The types of motion that all readers return: `Duet`, and `Solo` for one dancer."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from training.config import FPS
from training.motion.skeleton import JOINTS

# Largest distance from the origin, and of a joint from the pelvis, metres; those of the page's reader of BVH files.
_MAX_PLACE = 50.0
_MAX_REACH = 3.0

__all__ = ["FPS", "Duet", "Solo"]


def _check(name: str, role: str, motion: np.ndarray) -> None:
    where = f"{role} of {name}"
    if motion.ndim != 3 or motion.shape[1:] != (len(JOINTS), 3):
        raise ValueError(f"{where}: expected (T, {len(JOINTS)}, 3), got {motion.shape}")
    if motion.dtype != np.float32:
        raise ValueError(f"{where}: expected float32, got {motion.dtype}")
    if len(motion) == 0:
        raise ValueError(f"{where}: no frames")
    bad = ~np.isfinite(motion).all(axis=(1, 2))
    if bad.any():
        raise ValueError(f"{where}: {int(bad.sum())} frames are not finite, the first is {int(bad.argmax())}")
    far = (np.linalg.norm(motion.astype(np.float64), axis=-1) > _MAX_PLACE).any(axis=1)
    if far.any():
        raise ValueError(f"{where}: frame {int(far.argmax())} is more than {_MAX_PLACE:g} m from the origin")
    wide = (np.linalg.norm(motion - motion[:, :1], axis=-1) > _MAX_REACH).any(axis=1)
    if wide.any():
        raise ValueError(
            f"{where}: in frame {int(wide.argmax())} a joint is more than {_MAX_REACH:g} m from the pelvis"
        )


@dataclass(frozen=True, eq=False)
class Duet:
    """Two dancers in one world: metres, y up, right-handed, 30 fps, floor at 0, SMPL-22 joint order.

    leader, reactor: (T, 22, 3) float32, frame by frame in sync. song: an audio file in sync with frame 0, if
    any. Raises ValueError when a shape, type or length is wrong, a coordinate is not finite, or a joint is where no
    dancer's joint can be.
    """

    name: str
    leader: np.ndarray
    reactor: np.ndarray
    song: Path | None = None

    def __post_init__(self) -> None:
        _check(self.name, "leader", self.leader)
        _check(self.name, "reactor", self.reactor)
        if len(self.leader) != len(self.reactor):
            raise ValueError(
                f"{self.name}: the leader has {len(self.leader)} frames, the reactor {len(self.reactor)}"
            )

    def __len__(self) -> int:
        """Number of frames."""
        return len(self.leader)


@dataclass(frozen=True, eq=False)
class Solo:
    """One dancer alone, in the same units and joint order as a Duet; material for stage 1."""

    name: str
    motion: np.ndarray

    def __post_init__(self) -> None:
        _check(self.name, "motion", self.motion)

    def __len__(self) -> int:
        """Number of frames."""
        return len(self.motion)
