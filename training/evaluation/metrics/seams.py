"""Boundary jitter: whether the motion jumps at seams, the boundaries between generated blocks. The ratio of
`seam_ratio` is the boundary jitter ratio, in tables "seams over the truth's".

A block boundary at frame s lies between frames s-1 and s. |dv| at frame t is the mean over joints of
||p[t+1] - 2 p[t] + p[t-1]||, in mm per frame^2; frames s-1 and s are the two that see both sides of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

RADIUS = 2.0  # frames on either side that count as the seam
CLEAR = 8.0  # frames on either side that do not count as the motion's interior
PAPER_RADIUS = 30.0  # frames on either side, the paper's window


def velocity_change(motion: np.ndarray) -> np.ndarray:
    """|dv| of (T, J, 3) metres at frames 1..T-2, as (T,) mm per frame^2 with NaN at both ends."""
    change = np.full(len(motion), np.nan)
    second = np.diff(motion.astype(np.float64), n=2, axis=0)
    change[1:-1] = np.linalg.norm(second, axis=-1).mean(axis=-1) * 1000
    return change


def boundaries(frames: int, block: int) -> np.ndarray:
    """Frames of a clip at which a new block begins: block, 2 * block, ..."""
    return np.arange(block, frames, block)


def near(frames: int, seams: np.ndarray, radius: float) -> np.ndarray:
    """(frames,) bool: within `radius` frames of a seam, which lies half a frame before its frame number."""
    if len(seams) == 0:
        return np.zeros(frames, dtype=bool)
    distance = np.abs(np.arange(frames)[:, None] - (np.asarray(seams)[None] - 0.5)).min(axis=1)
    return distance <= radius


def paper_jitter(motion: np.ndarray, seams: np.ndarray) -> float:
    """The paper's boundary jitter (its Table 6): mean |dv| within 30 frames of the seams, mm per frame^2.

    The window is so wide that a jump of ten times the usual |dv| at one frame gives 1.15 times the rest, and a motion
    without any seam 0.8 to 1.3 times its own interior. `seam_ratio` is the measure to judge by.
    """
    return float(np.nanmean(velocity_change(motion)[near(len(motion), seams, PAPER_RADIUS)]))


@dataclass(frozen=True)
class SeamSample:
    """|dv| near the seams of one generated motion, and of the true one at the same frames.

    Velocity changes are sums in mm per frame^2 over `frames` frames of `seams` seams, so that samples of many
    motions add up. `inside` are the generated frames away from seams, to tell a seam from a motion that
    jitters everywhere.
    """

    seams: int
    frames: int
    generated: float
    truth: float
    inside_frames: int
    inside_generated: float
    inside_truth: float


def seam_sample(truth: np.ndarray, generated: np.ndarray, seams: np.ndarray) -> SeamSample:
    """Sums of |dv| within RADIUS frames of the seams of a generated motion (T, J, 3), and of the truth in the
    same frames.

    Raises ValueError for motions of different lengths.
    """
    if len(truth) != len(generated):
        raise ValueError(
            f"motions of {len(truth)} and {len(generated)} frames cannot be compared at their seams"
        )
    true, made = velocity_change(truth), velocity_change(generated)
    known = np.isfinite(made)
    at = near(len(truth), seams, RADIUS) & known
    inside = known & ~near(len(truth), seams, CLEAR)
    return SeamSample(
        seams=len(seams),
        frames=int(at.sum()),
        generated=float(made[at].sum()),
        truth=float(true[at].sum()),
        inside_frames=int(inside.sum()),
        inside_generated=float(made[inside].sum()),
        inside_truth=float(true[inside].sum()),
    )


def against_interior(motion: np.ndarray, seams: np.ndarray) -> float:
    """|dv| at the seams over the same motion's interior: for the page, which has no true motion to compare with.

    1 is seamless on average; any single frame inside a motion gives 0.5 to 2. NaN without a seam. web/quality/seams.ts
    computes the same, and is tested against this.
    """
    own = seam_sample(motion, motion, seams)
    if own.frames == 0 or own.inside_generated == 0:
        return float("nan")
    return (own.generated / own.frames) / (own.inside_generated / own.inside_frames)


def seam_ratio(samples: list[SeamSample]) -> dict[str, float]:
    """Boundary jitter ratio over many motions; 1.0 is seamless.

    seams: their number. ratio: |dv| at the seams over the truth's at the same frames. own: |dv| at the seams over
    the generated motion's own interior, divided by what the truth's is at the same frames, which does not change
    where a motion jitters or is too slow everywhere. NaN where nothing moves.
    """
    made, true = sum(s.generated for s in samples), sum(s.truth for s in samples)
    inside_made, inside_true = sum(s.inside_generated for s in samples), sum(s.inside_truth for s in samples)
    empty = made == 0 or true == 0 or inside_made == 0 or inside_true == 0
    return {
        "seams": float(sum(s.seams for s in samples)),
        "ratio": float("nan") if empty else made / true,
        "own": float("nan") if empty else (made / inside_made) / (true / inside_true),
    }
