"""Measures of generated reactors, each in a module of its own; `quick_report` is the few that are watched during
training.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from training.evaluation.metrics.distance import root_distance
from training.evaluation.metrics.errors import mpjpe, root_error, root_error_per_frame
from training.evaluation.metrics.speed import joint_speed


def quick_report(leader: np.ndarray, truth: np.ndarray, generated: np.ndarray) -> dict[str, float]:
    """The numbers that select a model while it trains; all motions (T, 22, 3) metres.

    mpjpe_mm, root_error_mm and root_error_median_mm are errors in mm; the median over frames is not affected by
    the seconds in which the couple stands far apart. speed_ratio (mean joint speed) and distance_ratio (median
    distance of the roots) are generated over true, 1 is right.
    """
    return {
        "mpjpe_mm": mpjpe(truth, generated),
        "root_error_mm": root_error(leader, truth, generated),
        "root_error_median_mm": float(np.median(root_error_per_frame(leader, truth, generated)) * 1000),
        "speed_ratio": joint_speed(generated) / joint_speed(truth),
        "distance_ratio": float(
            np.median(root_distance(leader, generated)) / np.median(root_distance(leader, truth))
        ),
    }


def mean_report(rows: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """The mean over reports of every measure that all of them have; none of no reports."""
    if not rows:
        return {}
    return {key: float(np.mean([row[key] for row in rows])) for key in rows[0] if all(key in r for r in rows)}
