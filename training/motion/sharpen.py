"""What diffusion in few steps leaves too quiet, made as loud as in a dance: the quick end of the motion."""

from __future__ import annotations

import numpy as np
import torch
import torch.nn.functional as F
from scipy.signal import firwin
from torch import Tensor

from training.config import FPS

CUT = 6.0  # Hz
RADIUS = 7  # frames


def _high_pass() -> np.ndarray:
    taps = -np.asarray(firwin(2 * RADIUS + 1, CUT, fs=FPS))
    taps[RADIUS] += 1
    return taps.astype(np.float32)


HIGH_PASS = _high_pass()


def sharpen(values: Tensor, gain: float) -> Tensor:
    """(T, c) at 30 frames a second, T at least 2, plus `gain` times what is quicker than 6 Hz.

    The phase stays, and a straight movement is left as it is; at both ends the motion is taken to go on straight.
    """
    kernel = torch.from_numpy(HIGH_PASS).to(values)[None, None]
    steps = torch.arange(1, RADIUS + 1).to(values)[:, None]
    before = values[:1] + steps.flip(0) * (values[:1] - values[1:2])
    after = values[-1:] + steps * (values[-1:] - values[-2:-1])
    rows = torch.cat([before, values, after]).T[:, None]
    return values + gain * F.conv1d(rows, kernel)[:, 0].T
