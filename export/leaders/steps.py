"""A dance as steps: which foot lands where, at which count, and what arms and trunk do meanwhile.

Places are seen from the dancer, who has a place on the floor and a heading: `across` is to the left, `ahead` to the
front, metres. Counts are beats of the song; count 0 is the first "1".
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from export.leaders.hands import LOW, Hand

Side = Literal["left", "right"]
SIGN: dict[Side, float] = {"left": 1.0, "right": -1.0}


def sides(sign: float) -> tuple[Side, Side]:
    """The left side first for signs above 0, the right one first for others."""
    return ("left", "right") if sign > 0 else ("right", "left")


STANCE = 0.115
"""Metres from the dancer's middle to a standing foot."""


@dataclass(frozen=True)
class Step:
    """A foot that leaves the floor `swing` counts before `count` and lands at `count`."""

    count: float
    side: Side
    place: np.ndarray
    """(2,) x and z of the ball of the foot in the room, metres."""
    heading: float
    """Radians about the vertical; 0 looks along z, positive turns to the left."""
    swing: float
    lift: float
    """Height of the ball of the foot in the middle of its way, metres."""
    weight: bool
    """Whether the body comes to stand on it; a tap leaves it on the other foot."""
    over: np.ndarray | None
    """(2,) the place over which the foot swings, where that is not its straight way: a kick."""


@dataclass
class Track:
    """A value over the counts, which eases from key to key."""

    keys: list[tuple[float, np.ndarray]] = field(default_factory=list)

    def to(self, count: float, value: float | tuple[float, ...]) -> None:
        self.keys.append((count, np.atleast_1d(np.asarray(value, dtype=float))))

    def at(self, counts: np.ndarray) -> np.ndarray:
        """(T, n) for counts (T,): cubic easing (smoothstep) between keys, constant before and after them."""
        keys = sorted(self.keys, key=lambda key: key[0])
        times = np.array([count for count, _ in keys])
        values = np.stack([value for _, value in keys])
        after = np.clip(np.searchsorted(times, counts, side="right"), 1, max(1, len(times) - 1))
        if len(times) == 1:
            return np.repeat(values, len(counts), axis=0)
        share = np.clip((counts - times[after - 1]) / np.maximum(times[after] - times[after - 1], 1e-6), 0, 1)
        eased = (share * share * (3 - 2 * share))[:, None]
        return values[after - 1] * (1 - eased) + values[after] * eased


class Dance:
    """Collects steps, headings and gestures while a dance is told from its beginning."""

    def __init__(self) -> None:
        self.count = 0.0
        self.place = np.zeros(2)
        self.heading = 0.0
        self.steps: list[Step] = []
        self.headings = Track()
        self.hands: dict[Side, Track] = {"left": Track(), "right": Track()}
        self.crouch = Track()
        """Metres by which the pelvis is lowered."""
        self.hop = Track()
        """Metres by which the body is in the air."""
        self.lean = Track()
        """Degrees by which the chest bends forward."""
        self.twist = Track()
        """Degrees by which the chest is turned to the left against the pelvis."""
        self.shimmy = Track()
        """Degrees by which the shoulders shake, twice a count."""
        self.headings.to(-1.0, 0.0)
        for track in (self.crouch, self.hop, self.lean, self.twist, self.shimmy):
            track.to(-1.0, 0.0)
        for hand in self.hands.values():
            hand.to(-1.0, LOW)
        for side in SIGN:
            self.steps.append(self._step(-4.0, side, 0.0, 0.0, 0.5, 0.0, True, None))

    def step(
        self,
        count: float,
        side: Side,
        across: float = 0.0,
        ahead: float = 0.0,
        *,
        turn: float = 0.0,
        move: tuple[float, float] = (0.0, 0.0),
        swing: float = 0.72,
        lift: float = 0.045,
        weight: bool = True,
        over: tuple[float, float] | None = None,
    ) -> None:
        """A step in the present eight counts, with the foot `across` and `ahead` of where it stands in rest.

        turn: degrees to the left by which the dancer turns with it. move: across and ahead, by which the dancer's
        place goes on, in the axes after the turn.
        """
        at = self.count + count
        if turn:
            self.headings.to(at - swing, self.heading)
            self.heading += np.radians(turn)
            self.headings.to(at + 0.15, self.heading)
        self.place = self.place + self.axes() @ np.array(move)
        self.steps.append(self._step(at, side, across, ahead, swing, lift, weight, over))

    def _step(
        self,
        count: float,
        side: Side,
        across: float,
        ahead: float,
        swing: float,
        lift: float,
        weight: bool,
        over: tuple[float, float] | None,
    ) -> Step:
        rest = np.array([SIGN[side] * STANCE + across, ahead])
        place = self.place + self.axes() @ rest
        way = None if over is None else self.place + self.axes() @ np.array(over)
        # Toes point outwards a little.
        heading = self.heading + SIGN[side] * np.radians(9)
        return Step(count, side, place, heading, swing, lift, weight, way)

    def axes(self) -> np.ndarray:
        """(2, 2) from across and ahead to x and z of the room."""
        cos, sin = np.cos(self.heading), np.sin(self.heading)
        return np.array([[cos, sin], [-sin, cos]])

    def hand(self, count: float, side: Side, place: Hand) -> None:
        self.hands[side].to(self.count + count, place)

    def both(self, count: float, place: Hand) -> None:
        self.hand(count, "left", place)
        self.hand(count, "right", place)

    def key(self, track: Track, *keys: tuple[float, float]) -> None:
        """Keys of a track at counts of the present eight."""
        for count, value in keys:
            track.to(self.count + count, value)

    def next(self, counts: float = 8.0) -> None:
        """Ends a figure of so many counts."""
        self.count += counts
