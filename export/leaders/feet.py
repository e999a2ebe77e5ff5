"""Where feet and weight are at every moment, from the steps of a dance."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.ndimage import gaussian_filter1d

from export.leaders.steps import Dance, Side, Step
from training.config import FPS

PIVOT = np.radians(28)
"""How far the body turns over a standing foot before the foot turns with it, radians."""
HEEL = np.radians(30)
"""By how much a heel rises when its foot pushes off a step of `FULL_STEP`, radians."""
FULL_STEP = 0.3
RISE_BEFORE = 0.45
"""Counts before a foot leaves the floor at which its heel begins to rise."""
SHIFT = (-0.3, 0.5)
"""Counts about a landing in which the weight comes onto the foot."""


def ease(share: np.ndarray) -> np.ndarray:
    """From 0 to 1 with the least jerk."""
    share = np.clip(share, 0, 1)
    return share**3 * (10 - 15 * share + 6 * share**2)


def bump(share: np.ndarray) -> np.ndarray:
    """From 0 over 1 back to 0; 0 outside of [0, 1]."""
    return np.where((share > 0) & (share < 1), np.sin(np.pi * np.clip(share, 0, 1)) ** 2, 0.0)


@dataclass(frozen=True)
class Foot:
    """One foot over T frames."""

    ball: np.ndarray
    """(T, 3) of the toe joint above the floor it stands on, metres: 0 is standing."""
    heading: np.ndarray
    """(T,) radians."""
    heel: np.ndarray
    """(T,) radians by which the heel is higher than in a flat foot."""


def foot_motion(dance: Dance, side: Side, counts: np.ndarray, body: np.ndarray) -> Foot:
    """One foot at counts (T,); `body`: heading of the body (T,), radians."""
    steps = sorted((step for step in dance.steps if step.side == side), key=lambda step: step.count)
    ball = np.zeros((len(counts), 3))
    heading = np.full(len(counts), steps[0].heading)
    heel = np.zeros(len(counts))
    ball[:, [0, 2]] = steps[0].place
    for before, step in pairwise(steps):
        start = step.count - step.swing
        share = (counts - start) / step.swing
        moved = share > 0
        eased = ease(share)[:, None]
        way = before.place * (1 - eased) + step.place * eased
        if step.over is not None:
            way = way + bump(share)[:, None] * (step.over - (before.place + step.place) / 2)
        ball[moved] = np.stack([way[:, 0], step.lift * bump(share), way[:, 1]], axis=1)[moved]
        heading[moved] = (before.heading + (step.heading - before.heading) * eased[:, 0])[moved]
        length = float(np.linalg.norm(step.place - before.place)) + step.lift
        push = (counts - start + RISE_BEFORE) / (RISE_BEFORE + 0.8 * step.swing)
        heel += HEEL * min(1.0, length / FULL_STEP) * bump(push)
    follow = np.clip(body - heading, -PIVOT, PIVOT)
    return Foot(ball, gaussian_filter1d(body - follow, 0.05 * FPS), heel)


def weight_on_left(dance: Dance, counts: np.ndarray) -> np.ndarray:
    """(T,) share of the weight on the left foot."""
    weight = np.full(len(counts), 0.5)
    for step in _weighted(dance):
        share = ease((counts - step.count - SHIFT[0]) / (SHIFT[1] - SHIFT[0]))
        weight = weight * (1 - share) + (1.0 if step.side == "left" else 0.0) * share
    return weight


def support(dance: Dance, counts: np.ndarray) -> np.ndarray:
    """(T, 2) the place that carries the body, going from one standing foot to the next."""
    first, second = dance.steps[0], dance.steps[1]
    place = np.repeat((first.place + second.place)[None] / 2, len(counts), axis=0)
    for step in _weighted(dance):
        share = ease((counts - step.count - SHIFT[0]) / (SHIFT[1] - SHIFT[0]))[:, None]
        place = place * (1 - share) + step.place * share
    return place


def _weighted(dance: Dance) -> list[Step]:
    return sorted((step for step in dance.steps[2:] if step.weight), key=lambda step: step.count)
