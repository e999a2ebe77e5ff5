"""Inter-penetration rate (IPR) of two dancers whose bodies are capsules round their bones: `IPR (capsules)`.

The paper uses SMPL meshes and generalised winding numbers. Without a body model each bone gets a radius of
human size, so the number does not compare with the paper's. Hands have no capsule: touching hands are a
dance hold, not a collision.
"""

from __future__ import annotations

import numpy as np

from training.motion.skeleton import JOINTS, body_height

# (from, to, radius in metres, share of the bone's length by which it goes on past its end)
CAPSULES: tuple[tuple[str, str, float, float], ...] = (
    ("left_hip", "right_hip", 0.10, 0.0),
    ("pelvis", "spine1", 0.11, 0.0),
    ("spine1", "spine2", 0.11, 0.0),
    ("spine2", "spine3", 0.11, 0.0),
    ("spine3", "neck", 0.09, 0.0),
    ("neck", "head", 0.06, 0.0),
    ("neck", "head", 0.08, 0.6),
    ("left_collar", "left_shoulder", 0.06, 0.0),
    ("right_collar", "right_shoulder", 0.06, 0.0),
    ("left_shoulder", "left_elbow", 0.045, 0.0),
    ("right_shoulder", "right_elbow", 0.045, 0.0),
    ("left_elbow", "left_wrist", 0.035, 0.0),
    ("right_elbow", "right_wrist", 0.035, 0.0),
    ("left_hip", "left_knee", 0.07, 0.0),
    ("right_hip", "right_knee", 0.07, 0.0),
    ("left_knee", "left_ankle", 0.05, 0.0),
    ("right_knee", "right_ankle", 0.05, 0.0),
    ("left_ankle", "left_foot", 0.04, 0.0),
    ("right_ankle", "right_foot", 0.04, 0.0),
)
RADII = np.array([radius for _, _, radius, _ in CAPSULES])
REFERENCE_HEIGHT = 1.4  # metres of leg plus spine (training.motion.skeleton.body_height) of the radii' body
DEEP = 0.01  # metres; a shallower overlap does not count


def capsules(motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Start and end (T, K, 3) of every capsule's axis for a motion (T, 22, 3)."""
    first = motion[:, [JOINTS.index(a) for a, _, _, _ in CAPSULES]].astype(np.float64)
    last = motion[:, [JOINTS.index(b) for _, b, _, _ in CAPSULES]].astype(np.float64)
    beyond = np.array([extra for _, _, _, extra in CAPSULES])[:, None]
    start = np.where(beyond > 0, last, first)  # the skull begins at the head joint
    return start, last + (last - first) * beyond


def segment_distance(p0: np.ndarray, p1: np.ndarray, q0: np.ndarray, q1: np.ndarray) -> np.ndarray:
    """Smallest distance between the segments p0-p1 and q0-q1, (N, 3) each to (N,); points are allowed.

    Clamped closest points after Ericson, Real-Time Collision Detection, 5.1.9.
    """
    p, q, gap = p1 - p0, q1 - q0, p0 - q0
    pp, qq, pq = (p * p).sum(-1), (q * q).sum(-1), (p * q).sum(-1)
    pg, qg = (p * gap).sum(-1), (q * gap).sum(-1)
    tiny = 1e-12
    across = pp * qq - pq**2
    s = np.where(across > tiny, np.clip((pq * qg - pg * qq) / np.maximum(across, tiny), 0, 1), 0.0)
    t = np.clip((pq * s + qg) / np.maximum(qq, tiny), 0, 1)
    s = np.where(pp > tiny, np.clip((pq * t - pg) / np.maximum(pp, tiny), 0, 1), 0.0)
    return np.linalg.norm(gap + s[:, None] * p - t[:, None] * q, axis=-1)


def depth(leader: np.ndarray, reactor: np.ndarray) -> np.ndarray:
    """Deepest overlap of any capsule of one with any of the other in every frame of (T, 22, 3) metres, (T,) metres;
    0 without an overlap.

    Radii follow the size of each body.
    """
    (a0, a1), (b0, b1) = capsules(leader), capsules(reactor)
    radius_a = RADII * body_height(leader) / REFERENCE_HEIGHT
    radius_b = RADII * body_height(reactor) / REFERENCE_HEIGHT
    # Only pairs whose bounding spheres meet can overlap: a few in a hundred.
    centre = np.linalg.norm((a0 + a1)[:, :, None] / 2 - (b0 + b1)[:, None] / 2, axis=-1)
    reach_a = np.linalg.norm(a1 - a0, axis=-1) / 2 + radius_a
    reach_b = np.linalg.norm(b1 - b0, axis=-1) / 2 + radius_b
    frame, i, j = np.nonzero(centre < reach_a[:, :, None] + reach_b[:, None])
    distance = segment_distance(a0[frame, i], a1[frame, i], b0[frame, j], b1[frame, j])
    result = np.zeros(len(leader))
    np.maximum.at(result, frame, radius_a[i] + radius_b[j] - distance)
    return result


def penetration(leader: np.ndarray, reactor: np.ndarray) -> dict[str, float]:
    """ipr_capsules: share of frames with an overlap deeper than 1 cm; depth_p50_mm and depth_p95_mm: percentiles of
    the depth over all frames, mm.
    """
    deepest = depth(leader, reactor)
    half, most = np.percentile(deepest, [50, 95]) * 1000
    return {
        "ipr_capsules": float((deepest > DEEP).mean()),
        "depth_p50_mm": float(half),
        "depth_p95_mm": float(most),
    }
