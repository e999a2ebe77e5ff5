"""Out-of-distribution leaders: other people in other dances, for whom there is no true reactor to compare with.

What can be measured is whether the partner is finite, on the floor, near the leader and not much faster than the
leader. Leaders whose solos were in the training data are reported apart from those that were not.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.ndimage import maximum_filter1d

from training.config import FPS
from training.data.bvh.reader import read_bvh
from training.data.duet import Solo
from training.data.npz import read_solo
from training.evaluation.metrics.distance import root_distance
from training.evaluation.metrics.penetration import DEEP, depth, penetration
from training.evaluation.metrics.speed import joint_speed
from training.evaluation.protocol import HeldOutDuet, ReactorGenerator, Settings, Solver, fit_length
from training.motion.floor import lower_toe
from training.motion.skeleton import FEET

# Metres above the leader's floor between which the lower of the two toe joints has to be in 98 % of frames. A
# planted toe rests at 0.03; true reactors of the salsa stay within 0.01 and 0.09.
MIN_TOE_HEIGHT, MAX_TOE_HEIGHT = -0.03, 0.15
MAX_DISTANCE = 3.0  # metres between the roots
MAX_SPEED_RATIO, MAX_SPEED_EXTRA = 2.0, 0.3  # times the leader's mean speed, plus m/s

# What looks wrong in single frames of a drawn reactor.
MAX_FAULTS = 0.05  # of the frames of a dance may have one of these
GLIDE_RATIO = 1.5  # times the leader's greatest speed within GLIDE_REACH seconds to each side, of the root
GLIDE_REACH = 0.5
GLIDE_SPEED = 1.5  # m/s, a root may always have it
ROUNDING = 1e-3  # of the speed of a root that is held to just that limit in single precision
MAX_ACCELERATION = 100.0  # m/s^2, of any joint
TIPTOE_HEIGHT = 0.08  # metres, of the lower toe, while the bodies overlap
SLIDE_SPEED = 0.6  # m/s over the floor, of the slowest joint of both feet
FAULTS = {
    "gliding_share": f"gliding: the root faster than {GLIDE_RATIO:g} times the leader's greatest speed within "
    f"{GLIDE_REACH:g} s, and than {GLIDE_SPEED:g} m/s",
    "snapping_share": f"snapping: a joint accelerates by more than {MAX_ACCELERATION:g} m/s²",
    "floating_share": f"floating: lower toe above {MAX_TOE_HEIGHT:g} m",
    "tiptoe_share": f"on tiptoe inside the leader: lower toe above {TIPTOE_HEIGHT:g} m while bodies overlap",
    "sliding_share": f"sliding on both feet: each of their joints faster than {SLIDE_SPEED:g} m/s over the floor, the "
    f"lower toe below {TIPTOE_HEIGHT:g} m",
}
"""Measures of `measure_faults` and what they mean."""


@dataclass(frozen=True)
class OutOfDistributionDance:
    """A leader and the reactor generated for it, fitted to a skeleton where there is a solver; both (T, 22, 3)
    metres.
    """

    name: str
    leader: np.ndarray
    reactor: np.ndarray


def read_leaders(sources: Sequence[Path]) -> list[Solo]:
    """Solo dances of npz archives and single BVH files, floors at 0.

    Raises ValueError for two leaders of one name.
    """
    leaders = [
        solo for path in sources for solo in (read_solo(path) if path.suffix == ".npz" else [read_bvh(path)])
    ]
    names = [leader.name for leader in leaders]
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise ValueError(f"out-of-distribution leaders have the same name: {', '.join(twice)}")
    return leaders


def measure_partner(leader: np.ndarray, reactor: np.ndarray) -> dict[str, Any]:
    """Measures of a reactor beside a leader, (T, 22, 3) metres on the floor y = 0; `checks` says which
    requirements it meets, `passed` whether all.

    toe_low_m and toe_high_m: 1st and 99th percentile over frames of the lower toe joint's height, metres.
    speed and leader_speed: mean joint speeds, m/s. overlap_share: of the frames, see `penetration`.
    """
    low, high = np.percentile(lower_toe(reactor), [1, 99])
    apart = root_distance(leader, reactor)
    row = {
        "frames": len(reactor),
        "toe_low_m": float(low),
        "toe_high_m": float(high),
        "distance_median_m": float(np.median(apart)),
        "distance_max_m": float(apart.max()),
        "speed": joint_speed(reactor),
        "leader_speed": joint_speed(leader),
        "overlap_share": penetration(leader, reactor)["ipr_capsules"],
    }
    checks = {
        "finite": bool(np.isfinite(reactor).all()),
        "on the floor": row["toe_low_m"] >= MIN_TOE_HEIGHT and row["toe_high_m"] <= MAX_TOE_HEIGHT,
        "near": row["distance_median_m"] < MAX_DISTANCE and row["distance_max_m"] < MAX_DISTANCE,
        "speed": row["speed"] < MAX_SPEED_RATIO * row["leader_speed"] + MAX_SPEED_EXTRA,
    }
    return {**row, "checks": checks, "passed": all(checks.values())}


def measure_faults(leader: np.ndarray, reactor: np.ndarray) -> dict[str, float]:
    """Shares of the frames in which something looks wrong about a reactor as it is drawn beside a leader, both
    (T, 22, 3) metres on the floor y = 0; FAULTS says what each means.
    """
    root, leading = (_level_speed(motion[:, 0]) for motion in (reactor, leader))
    allowed = np.maximum(
        GLIDE_SPEED, GLIDE_RATIO * maximum_filter1d(leading, 2 * round(GLIDE_REACH * FPS) + 1, mode="nearest")
    )
    acceleration = np.linalg.norm(np.diff(reactor, n=2, axis=0), axis=2).max(axis=1) * FPS**2
    toe = lower_toe(reactor)
    overlapping = depth(leader, reactor) > DEEP
    slowest = _level_speed(reactor[:, FEET]).min(axis=1)
    return {
        "gliding_share": float((root > allowed * (1 + ROUNDING)).mean()),
        "snapping_share": float((acceleration > MAX_ACCELERATION).mean()),
        "floating_share": float((toe > MAX_TOE_HEIGHT).mean()),
        "tiptoe_share": float(((toe > TIPTOE_HEIGHT) & overlapping).mean()),
        "sliding_share": float(((slowest > SLIDE_SPEED) & (toe[:-1] < TIPTOE_HEIGHT)).mean()),
    }


def _level_speed(points: np.ndarray) -> np.ndarray:
    """Speed over the floor from each frame to the next, m/s; points (T, ..., 3) metres, (T - 1, ...) returned."""
    return np.linalg.norm(np.diff(points[..., [0, 2]], axis=0), axis=-1) * FPS


def measure_out_of_distribution(
    generate: ReactorGenerator,
    leaders: Sequence[Solo],
    held_out: Sequence[HeldOutDuet],
    settings: Settings,
    solve: Solver | None = None,
) -> tuple[dict[str, Any], list[OutOfDistributionDance]]:
    """`measure_partner` for every leader, with the first seed and the held-out duets' songs in turn; and the dances.
    For a reactor that a solver has drawn also `measure_faults`.

    The numbers have the groups `seen` and `unseen` (whether the leader's name begins with one of
    `settings.seen_leaders`), each with its `count`, how many `passed` and its `leaders` by name. solve: the
    skeleton that is then drawn; its overlaps are overlap_share_solved, beside those of the joints before.
    """
    rows: dict[str, dict[str, Any]] = {"seen": {}, "unseen": {}}
    dances = []
    for index, leader in enumerate(leaders):
        song = held_out[index % len(held_out)].music
        music = None if song is None else fit_length(song, len(leader))
        reactor = generate(leader.motion, music, settings.seeds[0])
        row = measure_partner(leader.motion, reactor)
        if solve:
            (reactor,) = solve([reactor], leader.motion, music)
            row["overlap_share_solved"] = penetration(leader.motion, reactor)["ipr_capsules"]
            row |= measure_faults(leader.motion, reactor)
        group = "seen" if leader.name.startswith(settings.seen_leaders) else "unseen"
        rows[group][leader.name] = row
        dances.append(OutOfDistributionDance(leader.name, leader.motion, reactor))
    groups = {
        name: {"count": len(group), "passed": sum(row["passed"] for row in group.values()), "leaders": group}
        for name, group in rows.items()
    }
    return groups, dances
