"""Features of the pair (FID_cd): mean distances between ten joints of one dancer and ten of the other."""

from __future__ import annotations

import numpy as np

# Root, ankles, feet, head, shoulders and wrists, as in the Duolando evaluation.
CROSS_JOINTS: tuple[int, ...] = (0, 7, 8, 10, 11, 15, 16, 17, 20, 21)


def cross_distances(leader: np.ndarray, reactor: np.ndarray) -> np.ndarray:
    """(T, 22, 3) metres each to (100,): reactor joint by leader joint, the mean distance over time in
    metres.
    """
    joints = list(CROSS_JOINTS)
    gap = reactor[:, joints, None] - leader[:, None, joints]
    return np.linalg.norm(gap.astype(np.float64), axis=-1).mean(axis=0).reshape(-1)
