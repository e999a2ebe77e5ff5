"""Amplifies the high frequencies of a decoded motion, which sampling in few steps leaves too weak."""

from __future__ import annotations

import numpy as np
import torch
import torch.nn.functional as F
from scipy.signal import firwin
from torch import Tensor

from training.config import FPS

CUT_HZ = 6.0
RADIUS_FRAMES = 7  # of the filter


def _high_pass() -> np.ndarray:
    taps = -np.asarray(firwin(2 * RADIUS_FRAMES + 1, CUT_HZ, fs=FPS))
    taps[RADIUS_FRAMES] += 1
    return taps.astype(np.float32)


HIGH_PASS = _high_pass()


def sharpen(values: Tensor, gain: float) -> Tensor:
    """(T, c) at 30 frames a second, T at least 2, plus `gain` times its part above 6 Hz.

    The filter has no phase shift and leaves a constant velocity as it is; both ends are extrapolated linearly.
    """
    kernel = torch.from_numpy(HIGH_PASS).to(values)[None, None]
    steps = torch.arange(1, RADIUS_FRAMES + 1).to(values)[:, None]
    before = values[:1] + steps.flip(0) * (values[:1] - values[1:2])
    after = values[-1:] + steps * (values[-1:] - values[-2:-1])
    rows = torch.cat([before, values, after]).T[:, None]
    return values + gain * F.conv1d(rows, kernel)[:, 0].T
