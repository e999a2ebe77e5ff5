"""Geometric features of one dancer (FID_g): in what share of frames each of 32 poses or gestures is seen.

After Müller et al. 2005 (Efficient content-based retrieval of motion capture data) as used by the AIST++, Duolando
and ReactDance evaluations; rewritten from fairmotion (THIRD_PARTY.md has its licence). Thresholds are multiples of a
humerus, a shoulder width and a hip width of one fixed body, so dancers should be compared at the same scale.
"""

from __future__ import annotations

import numpy as np

from training.config import FPS
from training.evaluation.metrics.modes import Mode, feature_pose

HUMERUS, SHOULDERS, HIPS = 0.2568381, 0.3908484, 0.1192471  # metres

ROOT, LHIP, RHIP, BELLY, LKNEE, RKNEE = 0, 1, 2, 3, 4, 5
LANKLE, RANKLE, CHEST, LTOES, RTOES, NECK = 7, 8, 9, 10, 11, 12
LSHOULDER, RSHOULDER, LELBOW, RELBOW, LWRIST, RWRIST = 16, 17, 18, 19, 20, 21

BENT = (0.0, 110.0)  # degrees, elbows and knees


def _unit(vector: np.ndarray) -> np.ndarray:
    return vector / np.maximum(np.linalg.norm(vector, axis=-1, keepdims=True), 1e-12)


def _dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return (a * b).sum(axis=-1)


class _Primitives:
    """The relations that features are made of, over frames 1..T-1; points are joint indices or (T, 3)
    arrays.
    """

    def __init__(self, pose: np.ndarray, rate: float) -> None:
        self.pose, self.rate = pose, rate

    def at(self, point: int | np.ndarray) -> np.ndarray:
        return self.pose[:, point] if isinstance(point, int) else point

    def _normal(self, a: int, b: int, c: int) -> np.ndarray:
        """Unit normal of the plane through a, b and c, (T, 3)."""
        return _unit(np.cross(self.at(c) - self.at(a), self.at(b) - self.at(a)))

    def _along(self, moving: int, base: int, direction: np.ndarray) -> np.ndarray:
        """Speed of one joint against another along a direction, (T-1,) m/s."""
        relative = self.at(moving) - self.at(base)
        return _dot(np.diff(relative, axis=0), direction[1:]) * self.rate

    def nmove(self, a: int, b: int, c: int, d: int, threshold: float) -> np.ndarray:
        """Does d move against a along the normal of the plane a, b, c?"""
        return self._along(d, a, self._normal(a, b, c)) > threshold

    def move(self, a: int, b: int, c: int, _d: int, threshold: float) -> np.ndarray:
        """Does c move against a in the direction from a to b? The fourth joint counts for nothing, as
        published.
        """
        return self._along(c, a, _unit(self.at(b) - self.at(a))) > threshold

    def plane(self, a: int, b: int, c: int, d: int, threshold: float) -> np.ndarray:
        """Is d farther than the threshold in front of the plane a, b, c?"""
        return _dot(self._normal(a, b, c), self.at(d) - self.at(a))[1:] > threshold

    def nplane(
        self, a: int | np.ndarray, b: int | np.ndarray, c: int | np.ndarray, d: int, threshold: float
    ) -> np.ndarray:
        """Is d farther than the threshold from c in the direction from a to b?"""
        return _dot(_unit(self.at(b) - self.at(a)), self.at(d) - self.at(c))[1:] > threshold

    def angle(
        self, a: int, b: int, c: int | np.ndarray, d: int | np.ndarray, limits: tuple[float, float]
    ) -> np.ndarray:
        """Is the angle between a->b and c->d inside the open interval, degrees?"""
        cosine = _dot(_unit(self.at(b) - self.at(a)), _unit(self.at(d) - self.at(c)))[1:]
        degrees = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
        return (degrees > limits[0]) & (degrees < limits[1])

    def fast(self, a: int, threshold: float) -> np.ndarray:
        """Is the joint faster than the threshold?"""
        return np.linalg.norm(np.diff(self.at(a), axis=0), axis=-1) * self.rate > threshold


def geometric_flags(motion: np.ndarray, mode: Mode) -> np.ndarray:
    """The 32 features of every frame from the second on, (T-1, 32) bool, of a motion (T, 22, 3) metres."""
    pose = feature_pose(motion, mode)
    p = _Primitives(pose, 120.0 if mode == "paper" else FPS)
    hl, sw, hw = HUMERUS, SHOULDERS, HIPS
    zero = np.zeros_like(pose[:, 0])
    up = zero + np.array([0.0, 1.0, 0.0])
    lowest = up * pose[:, :, 1].min(axis=1, keepdims=True)
    return np.stack(
        [
            p.nmove(NECK, RHIP, LHIP, RWRIST, 1.8 * hl),
            p.nmove(NECK, LHIP, RHIP, LWRIST, 1.8 * hl),
            p.nplane(CHEST, NECK, NECK, RWRIST, 0.2 * hl),
            p.nplane(CHEST, NECK, NECK, LWRIST, 0.2 * hl),
            p.move(BELLY, CHEST, CHEST, RWRIST, 1.8 * hl),
            p.move(BELLY, CHEST, CHEST, LWRIST, 1.8 * hl),
            p.angle(RELBOW, RSHOULDER, RELBOW, RWRIST, BENT),
            p.angle(LELBOW, LSHOULDER, LELBOW, LWRIST, BENT),
            p.nplane(LSHOULDER, RSHOULDER, LWRIST, RWRIST, 2.5 * sw),
            p.move(LWRIST, RWRIST, RWRIST, LWRIST, 1.4 * hl),
            p.move(RWRIST, ROOT, LWRIST, ROOT, 1.4 * hl),
            p.move(LWRIST, ROOT, RWRIST, ROOT, 1.4 * hl),
            p.fast(RWRIST, 2.5 * hl),
            p.fast(LWRIST, 2.5 * hl),
            p.plane(ROOT, LHIP, LTOES, RANKLE, 0.38 * hl),
            p.plane(ROOT, RHIP, RTOES, LANKLE, 0.38 * hl),
            p.nplane(zero, up, lowest, RANKLE, 1.2 * hl),
            p.nplane(zero, up, lowest, LANKLE, 1.2 * hl),
            p.nplane(LHIP, RHIP, LANKLE, RANKLE, 2.1 * hw),
            p.angle(RKNEE, RHIP, RKNEE, RANKLE, BENT),
            p.angle(LKNEE, LHIP, LKNEE, LANKLE, BENT),
            p.fast(RANKLE, 2.5 * hl),
            p.fast(LANKLE, 2.5 * hl),
            p.angle(NECK, ROOT, RSHOULDER, RELBOW, (25.0, 180.0)),
            p.angle(NECK, ROOT, LSHOULDER, LELBOW, (25.0, 180.0)),
            p.angle(NECK, ROOT, RHIP, RKNEE, (50.0, 180.0)),
            p.angle(NECK, ROOT, LHIP, LKNEE, (50.0, 180.0)),
            p.plane(RANKLE, NECK, LANKLE, ROOT, 0.5 * hl),
            p.angle(NECK, ROOT, zero, up, (70.0, 110.0)),
            p.nplane(zero, -up, lowest, RWRIST, -1.2 * hl),
            p.nplane(zero, -up, lowest, LWRIST, -1.2 * hl),
            p.fast(ROOT, 2.3 * hl),
        ],
        axis=-1,
    )


def geometric_features(motion: np.ndarray, mode: Mode) -> np.ndarray:
    """Share of frames in which each of the 32 features holds, (32,), for a motion (T, 22, 3) in metres."""
    return geometric_flags(motion, mode).mean(axis=0)
