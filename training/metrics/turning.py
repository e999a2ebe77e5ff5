"""numpy entrance to the frame of reference: vectors as a dancer sees them, and back."""

from __future__ import annotations

import numpy as np
import torch

from training.frame import into_frame, out_of_frame


def turn_in(vectors: np.ndarray, heading: np.ndarray) -> np.ndarray:
    """World vectors (T, N, 3) as seen from a body that faces heading (T, 2): +z is forward, +x its left."""
    return into_frame(torch.from_numpy(vectors), torch.from_numpy(heading)).numpy()


def turn_out(vectors: np.ndarray, heading: np.ndarray) -> np.ndarray:
    """Inverse of `turn_in`."""
    return out_of_frame(torch.from_numpy(vectors), torch.from_numpy(heading)).numpy()
