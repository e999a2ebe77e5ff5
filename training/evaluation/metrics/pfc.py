"""Physical foot contact score (PFC) of EDGE, Tseng et al. 2023: root accelerations without a foot to push
from.
"""

from __future__ import annotations

import numpy as np

UP, HORIZONTAL = 1, [0, 2]
DT = 1 / 30


def physical_foot_contact(motion: np.ndarray) -> float:
    """PFC of (T, 22, 3) metres, y up, 30 fps; lower is better, and it depends on the clip's length.

    1e4 * mean(min(v7, v10) * min(v8, v11) * a): v the horizontal metres per frame of ankle and foot of each
    side, a the root's acceleration without its falling part, divided by its largest value in the clip.
    """
    root = np.diff(motion[:, 0].astype(np.float64), n=2, axis=0) / DT**2
    root[:, UP] = np.maximum(root[:, UP], 0.0)
    acceleration = np.linalg.norm(root, axis=-1)
    largest = acceleration.max()
    if largest == 0:
        return 0.0
    feet = motion[:, [7, 10, 8, 11]].astype(np.float64)
    speed = np.linalg.norm(np.diff(feet, axis=0)[1:][..., HORIZONTAL], axis=-1)
    left, right = speed[:, :2].min(axis=1), speed[:, 2:].min(axis=1)
    return float((left * right * acceleration / largest).mean() * 1e4)
