"""Planted feet hold the body: where a planted foot would slide, the whole body gives way over the floor.

A sampled body and its place come from latents that do not agree to the centimetre, so the feet slide. A dancer's place
follows from their feet. The way e (2 axes, metres) that the body is moved is least in

    strength * sum_t g_t |v_t + e'_t|  +  sum_t |e_t|^2 / (2 RETURN^2)  +  STIFFNESS / 2 * sum_t |e''_t|^2

with the planted foot's velocity v (m/s) and g in [0, 1], how planted it is. The first sum is of lengths, not of
squares: feet that hardly slide stop, while a foot that is turned or dragged goes on. Solved with the alternating
direction method of multipliers (Boyd et al. 2011, section 3); its linear step is one convolution, so the whole becomes
a few nodes of a graph.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import torch
import torch.nn.functional as F
from torch import Tensor

from training.config import FPS
from training.motion.floor import TOE_REST
from training.motion.foot_contact import HEIGHT, VERTICAL_SPEED
from training.motion.skeleton import FEET

RETURN = 0.45  # seconds in which the body comes back to its place
STIFFNESS = 0.012  # s^2; the body gives way without jolts
PENALTY = 1.5  # the method's rho, which sets how fast it converges, not where to
ROUNDS = 12
REST = (0.08, 0.08, TOE_REST, TOE_REST)  # metres above the floor at which ankles and toes rest
SLOW = 0.1  # m/s; of two planted feet the slower one holds the body
RADIUS = 60  # frames; the answer to one step of the foot has all but faded out by then


@cache
def _answer() -> np.ndarray:
    """(2 RADIUS) How the body moves at frames RADIUS to -RADIUS + 1 after a foot's unit of velocity at frame 1/2.

    As a kernel of `conv1d`: the linear step (D'D rho + 1 / RETURN^2 + STIFFNESS D2'D2)^-1 rho D' far from the ends.
    """
    size = 64 * RADIUS
    turns = 2 * np.pi * np.fft.rfftfreq(size)
    step = (np.exp(1j * turns) - 1) * FPS
    bend = (2 - 2 * np.cos(turns)) * FPS**2
    spectrum = np.conj(step) * PENALTY
    spectrum /= PENALTY * np.abs(step) ** 2 + RETURN**-2 + STIFFNESS * bend**2
    lags = np.arange(RADIUS, -RADIUS, -1)
    return np.fft.irfft(spectrum, size)[lags].astype(np.float32)


def _follow(steps: Tensor) -> Tensor:
    """The way (2, T) that follows velocities (2, T - 1) and comes back."""
    kernel = torch.from_numpy(_answer()).to(steps)[None, None]
    return F.conv1d(steps[:, None], kernel, padding=RADIUS)[:, 0]


def _held(motion: Tensor) -> tuple[Tensor, Tensor]:
    """Velocity (2, T - 1) over the floor, m/s, of whichever foot is planted, and (T - 1) how planted it is, 0 to 1."""
    feet = motion[:, list(FEET)]
    speed = (feet[1:] - feet[:-1]) * FPS
    over = ((feet[1:, :, 1] + feet[:-1, :, 1]) / 2 - torch.tensor(REST).to(motion)).clamp_min(0)
    planted = torch.exp(-((over / HEIGHT) ** 4) - (speed[..., 1] / VERTICAL_SPEED) ** 4)
    level = speed[..., ::2]
    share = planted / (level.square().sum(-1) + SLOW**2)
    held = (share[..., None] * level).sum(1) / (share.sum(1) + 1e-4)[:, None]
    return held.T, 1 - (1 - planted).prod(dim=1)


def grip(motion: Tensor, strength: float) -> Tensor:
    """Joints (T, 22, 3), metres at the model's height over a floor at y = 0, moved over the floor so that planted feet
    slide less; T at least 2. `strength` in m/s, 0 leaves the motion as it is.
    """
    if strength == 0:
        return motion
    velocity, planted = _held(motion)
    most = strength / PENALTY * planted
    step = -velocity
    price = torch.zeros_like(velocity)
    way = _follow(step)
    for _ in range(ROUNDS):
        slide = velocity + (way[:, 1:] - way[:, :-1]) * FPS + price
        length = slide.square().sum(0).clamp_min(1e-8).sqrt()
        left = slide * (1 - most / length).clamp_min(0)
        price = slide - left
        way = _follow(left - velocity - price)
    return motion + torch.stack([way[0], torch.zeros_like(way[0]), way[1]], dim=-1)[:, None]
