"""Pure functions that make new duets of old ones: metres, y up, (T, 22, 3) float32 in and out."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

from training.data.duet import Duet
from training.motion.skeleton import MIRROR


def mirror_motion(motion: np.ndarray) -> np.ndarray:
    """A (T, 22, 3) motion seen in a mirror: x turns to -x, left joints to right ones."""
    return motion[:, MIRROR] * np.array([-1, 1, 1], dtype=motion.dtype)


def mirror(duet: Duet) -> Duet:
    """Both dancers seen in the same mirror; twice is the identity."""
    return replace(duet, leader=mirror_motion(duet.leader), reactor=mirror_motion(duet.reactor))


def swap_roles(duet: Duet) -> Duet:
    """The reactor as leader and the leader as reactor. The model is told by its role input."""
    return replace(duet, leader=duet.reactor, reactor=duet.leader)


def warped_length(frames: int, factor: float) -> int:
    """Frames of a motion of `frames` frames danced `factor` times as fast; first and last frame are kept."""
    if factor <= 0:
        raise ValueError(f"a dance cannot run {factor} times as fast")
    return max(2, round((frames - 1) / factor) + 1) if frames > 1 else 1


def warp_factor(frames: int, factor: float) -> float:
    """The factor that whole frames leave of `factor`: what music for the warped motion must use."""
    return (frames - 1) / (warped_length(frames, factor) - 1) if frames > 1 else 1.0


def warp_motion(motion: np.ndarray, factor: float) -> np.ndarray:
    """The (T, 22, 3) motion `factor` times as fast: (warped_length(T, factor), 22, 3), by cubic splines.

    Linear interpolation would flatten fast swings where new frames fall between old ones.
    """
    frames = len(motion)
    if frames < 2:
        return motion
    times = np.linspace(0, frames - 1, warped_length(frames, factor))
    return CubicSpline(np.arange(frames), motion, axis=0)(times).astype(motion.dtype)


def tempo_warp(duet: Duet, factor: float) -> Duet:
    """Both dancers `factor` times as fast; the song, if any, no longer fits and is dropped."""
    if factor == 1:
        return duet
    return replace(
        duet, leader=warp_motion(duet.leader, factor), reactor=warp_motion(duet.reactor, factor), song=None
    )


def scale_leader(duet: Duet, factor: float) -> Duet:
    """A leader `factor` times as tall, standing on the same floor and between the same steps of the couple.

    The body is scaled about the floor point under its root, frame by frame, so root height scales and the
    horizontal distance between the roots, which the reactor keeps, does not change. Planted feet then slide
    by (factor - 1) times the root's own path: keep the factor within about 0.9 to 1.1.
    """
    floor_point = duet.leader[:, :1] * np.array([1, 0, 1], dtype=np.float32)
    leader = floor_point + (duet.leader - floor_point) * np.float32(factor)
    return replace(duet, leader=leader.astype(np.float32))
