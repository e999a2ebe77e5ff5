"""Reactors that need no model, to read a model's numbers against: the nearest neighbour among the training duets, the
mean pose, the mirrored leader.

All see the leader in its own heading of each frame, so that turning or moving the couple changes nothing.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from training.data.duet import Duet
from training.evaluation.metrics.distance import root_distance
from training.evaluation.protocol import HeldOutDuet, Motions
from training.motion.heading import heading as facing
from training.motion.heading import turn_in, turn_out
from training.motion.skeleton import MIRROR

WINDOW_FRAMES = 60  # copied in one piece
# The root's displacement in so many frames weighs as much as a displacement of a joint of the same length.
LOOKAHEAD_FRAMES = 5.0


def baselines(held_out: Sequence[HeldOutDuet], train: Sequence[Duet]) -> dict[str, Motions]:
    """One row for each baseline, learned from the training duets."""
    distance = median_distance(train)
    return {
        "nearest neighbour": {i.duet.name: [nearest_neighbour(train, i.duet.leader)] for i in held_out},
        "mean pose": {i.duet.name: [mean_pose(train, i.duet.leader)] for i in held_out},
        "mirrored leader": {i.duet.name: [mirrored_leader(i.duet.leader, distance)] for i in held_out},
    }


def leader_description(leader: np.ndarray) -> np.ndarray:
    """Pose, root velocity and turn rate of a leader (T, 22, 3) metres, (T, 70): metres and radians of similar size."""
    heading = facing(leader)
    pose = turn_in(leader - leader[:, :1], heading).reshape(len(leader), -1)
    velocity = turn_in(np.gradient(leader[:, :1], axis=0), heading)[:, 0]
    turn = np.gradient(np.unwrap(np.arctan2(heading[:, 0], heading[:, 1])))[:, None]
    return np.concatenate([pose, velocity * LOOKAHEAD_FRAMES, turn * LOOKAHEAD_FRAMES], axis=1)


def _window_costs(library: np.ndarray, query: np.ndarray) -> np.ndarray:
    """Squared distance of a query (W, F) to every window of W frames of a library clip (T, F), (T - W + 1,)."""
    cross = library @ query.T
    gap = (library**2).sum(axis=1)[:, None] + (query**2).sum(axis=1) - 2 * cross
    starts = len(library) - len(query) + 1
    return sum((gap[k : k + starts, k] for k in range(len(query))), np.zeros(max(starts, 0)))


def nearest_neighbour(train: Sequence[Duet], leader: np.ndarray) -> np.ndarray:
    """For every 60 frames of a leader (T, 22, 3) metres the reactor of the training window with the closest leader,
    which may begin at any frame; (T, 22, 3).

    Raises ValueError if no training duet is as long as such a window.
    """
    descriptions = [leader_description(duet.leader) for duet in train]
    headings = [facing(duet.leader) for duet in train]
    query, heading = leader_description(leader), facing(leader)
    made = np.empty_like(leader)
    for start in range(0, len(leader), WINDOW_FRAMES):
        rows = slice(start, min(start + WINDOW_FRAMES, len(leader)))
        count = rows.stop - start
        best = (np.inf, 0, 0)
        for clip, description in enumerate(descriptions):
            if len(description) >= count:
                costs = _window_costs(description, query[rows])
                best = min(best, (float(costs.min()), clip, int(costs.argmin())))
        _, clip, first = best
        if not np.isfinite(best[0]):
            raise ValueError(f"no training duet has {count} frames")
        copied, source = slice(first, first + count), train[clip]
        offset = source.reactor[copied] - source.leader[copied, :1]
        seen = turn_in(offset, headings[clip][copied])
        made[rows] = turn_out(seen, heading[rows]) + leader[rows, :1]
    return made


def mean_pose(train: Sequence[Duet], leader: np.ndarray) -> np.ndarray:
    """The mean body of the training reactors at their mean place beside the leader, for every frame of a leader
    (T, 22, 3) metres.
    """
    seen = [turn_in(d.reactor - d.leader[:, :1], facing(d.leader)) for d in train]
    body = np.concatenate(seen).mean(axis=0)
    return turn_out(np.repeat(body[None], len(leader), axis=0), facing(leader)) + leader[:, :1]


def median_distance(train: Sequence[Duet]) -> float:
    """Median distance of the roots over all training frames, metres."""
    return float(np.median(np.concatenate([root_distance(d.leader, d.reactor) for d in train])))


def mirrored_leader(leader: np.ndarray, distance: float) -> np.ndarray:
    """The leader (T, 22, 3) metres in an upright mirror in front of its hips, half the distance (metres) away."""
    heading = facing(leader)
    seen = turn_in(leader - leader[:, :1], heading)
    seen[..., 2] = distance - seen[..., 2]
    return turn_out(seen[:, list(MIRROR)], heading) + leader[:, :1]
