"""Moves the whole body over the floor so that planted feet slide less.

A sampled pose and its place come from latents that do not agree to the centimetre, so feet slide. The root is moved by
an offset e(t) (2 axes, metres) that minimises

    strength * sum_t g_t |v_t + e'_t|  +  sum_t |e_t|^2 / (2 RETURN^2)  +  STIFFNESS / 2 * sum_t |e''_t|^2

where v is the velocity of the planted foot (m/s) and g in [0, 1] says how planted it is. The first sum is of lengths,
not of squares: slow slides stop altogether, while a foot that is turned or dragged goes on. Solved with the
alternating direction method of multipliers (ADMM, Boyd et al. 2011, section 3). Its linear step is one convolution, so
the whole becomes a few nodes of the decode graph.
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

RETURN = 0.45  # seconds in which the offset goes back to zero
STIFFNESS = 0.012  # s^2, weight of the offset's acceleration
RHO = 1.5  # penalty of ADMM: changes how fast it converges, not the result
ITERATIONS = 12
REST_HEIGHTS = (0.08, 0.08, TOE_REST, TOE_REST)  # metres above the floor at which ankles and toes rest
SPEED_SCALE = 0.1  # m/s; of two planted feet the slower one counts for more
RADIUS_FRAMES = 60  # half the length of the kernel; beyond it the response is almost 0


@cache
def _step_response() -> np.ndarray:
    """(2 RADIUS_FRAMES) offset at frames RADIUS to -RADIUS + 1 after a foot's unit of velocity at frame 1/2.

    As a kernel of `conv1d`: the linear step (D'D rho + 1 / RETURN^2 + STIFFNESS D2'D2)^-1 rho D' far from the ends,
    with the first difference D and the second difference D2.
    """
    size = 64 * RADIUS_FRAMES
    omega = 2 * np.pi * np.fft.rfftfreq(size)
    first = (np.exp(1j * omega) - 1) * FPS
    second = (2 - 2 * np.cos(omega)) * FPS**2
    spectrum = np.conj(first) * RHO
    spectrum /= RHO * np.abs(first) ** 2 + RETURN**-2 + STIFFNESS * second**2
    lags = np.arange(RADIUS_FRAMES, -RADIUS_FRAMES, -1)
    return np.fft.irfft(spectrum, size)[lags].astype(np.float32)


def _linear_step(velocity: Tensor) -> Tensor:
    """Offset (2, T) metres that follows velocities (2, T - 1) m/s and returns to zero."""
    kernel = torch.from_numpy(_step_response()).to(velocity)[None, None]
    return F.conv1d(velocity[:, None], kernel, padding=RADIUS_FRAMES)[:, 0]


def _planted_velocity(motion: Tensor) -> tuple[Tensor, Tensor]:
    """Velocity (2, T - 1) over the floor, m/s, of the feet that are planted, and (T - 1) how planted they are, 0 to 1.

    The limits of `foot_contact` as smooth weights, so that contact does not begin or end within one frame.
    """
    feet = motion[:, list(FEET)]
    velocity = (feet[1:] - feet[:-1]) * FPS
    height = ((feet[1:, :, 1] + feet[:-1, :, 1]) / 2 - torch.tensor(REST_HEIGHTS).to(motion)).clamp_min(0)
    planted = torch.exp(-((height / HEIGHT) ** 4) - (velocity[..., 1] / VERTICAL_SPEED) ** 4)
    horizontal = velocity[..., ::2]
    weight = planted / (horizontal.square().sum(-1) + SPEED_SCALE**2)
    mean = (weight[..., None] * horizontal).sum(1) / (weight.sum(1) + 1e-4)[:, None]
    return mean.T, 1 - (1 - planted).prod(dim=1)


def correct_foot_contact(motion: Tensor, strength: float) -> Tensor:
    """Joints (T, 22, 3), metres at the model's height over a floor at y = 0, with the offset added to all of them.

    T is at least 2. strength: m/s; 0 leaves the motion as it is.
    """
    if strength == 0:
        return motion
    velocity, planted = _planted_velocity(motion)
    threshold = strength / RHO * planted
    dual = torch.zeros_like(velocity)
    offset = _linear_step(-velocity)
    for _ in range(ITERATIONS):
        slide = velocity + (offset[:, 1:] - offset[:, :-1]) * FPS + dual
        length = slide.square().sum(0).clamp_min(1e-8).sqrt()
        shrunk = slide * (1 - threshold / length).clamp_min(0)
        dual = slide - shrunk
        offset = _linear_step(shrunk - velocity - dual)
    return motion + torch.stack([offset[0], torch.zeros_like(offset[0]), offset[1]], dim=-1)[:, None]
