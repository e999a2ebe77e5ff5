"""The frame of reference of leader features and reactor streams: the leader's heading, smoothed over time.

Everything is a function of the whole clip, so it does not depend on where windows or blocks begin. Rotating
or moving the couple in the world changes nothing inside the frame.
"""

from __future__ import annotations

import torch
from torch import Tensor

from training.config import FrameConfig
from training.motion.heading import hip_heading
from training.motion.smoothing import gaussian_mean

# The Gaussian of the leader's place on the floor, frames.
PLACE_SIGMA, PLACE_RADIUS = 2.0, 6

# WebGPU's own atan, sin and cos may be wrong by half a thousandth, which is half a millimetre at arm's length:
# these are as exact everywhere as sums and products are.


def arctangent(x: Tensor) -> Tensor:
    """atan(x), to 5e-7."""
    for _ in range(3):  # atan(x) = 2 atan(x / (1 + sqrt(1 + x^2))), down to x of 0.2
        x = x / (1 + (1 + x * x).sqrt())
    y = x * x
    return 8 * x * (1 + y * (-1 / 3 + y * (1 / 5 + y * (-1 / 7 + y / 9))))


def cosine_sine(angle: Tensor) -> tuple[Tensor, Tensor]:
    """cos and sin of angles of up to two turns (radians), to 3e-6: of a sixteenth, doubled four times."""
    x = angle / 16
    y = x * x
    sine = x * (1 + y * (-1 / 6 + y * (1 / 120 + y * (-1 / 5040 + y / 362880))))
    cosine = 1 + y * (-1 / 2 + y * (1 / 24 + y * (-1 / 720 + y / 40320)))
    for _ in range(4):
        sine, cosine = 2 * sine * cosine, 1 - 2 * sine * sine
    return cosine, sine


def smoothed_heading(leader: Tensor, config: FrameConfig) -> Tensor:
    """Unit heading of the leader in the floor plane.

    leader: (T, 22, 3) metres, y up. Returns (T, 2): x and z of the direction the hips face, its angle
    smoothed with a Gaussian. The angle is unwrapped first, so that a leader who spins turns the frame
    evenly: an average of directions would pass through zero and flip. At the ends the Gaussian weighs the
    frames that exist.
    """
    facing = hip_heading(leader)
    before, after = facing[:-1], facing[1:]
    cross = before[:, 1] * after[:, 0] - before[:, 0] * after[:, 1]
    dot = (before * after).sum(-1)
    turns = 2 * arctangent(cross / (1 + dot).clamp_min(1e-6))
    angle = torch.cat([turns.new_zeros(1), turns]).cumsum(0)

    ahead = gaussian_mean(angle[None], config.sigma, config.radius)[0] - angle
    c, s = cosine_sine(ahead)
    x, z = facing.unbind(-1)
    return torch.stack([c * x + s * z, c * z - s * x], dim=-1)


def smoothed_root(leader: Tensor) -> Tensor:
    """The leader's root (T, 1, 3) with its place on the floor smoothed with a Gaussian.

    leader: (T, 22, 3) metres, y up. A reactor who is placed relative to it does not take over the jerks of a capture
    or of a video, and steps in the same place.
    """
    x, y, z = leader[:, 0].unbind(-1)
    x, z = gaussian_mean(torch.stack([x, z]), PLACE_SIGMA, PLACE_RADIUS)
    return torch.stack([x, y, z], dim=-1)[:, None]
