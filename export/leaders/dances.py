"""The four dances: a slow one, a quick one, one that turns and a playful one."""

from __future__ import annotations

from collections.abc import Callable

from export.leaders import figures as f
from export.leaders.steps import Dance

DANCES: dict[str, Callable[[Dance], None]] = {}


def dance(tell: Callable[[Dance], None]) -> Callable[[Dance], None]:
    DANCES[tell.__name__] = tell
    return tell


@dance
def slow(dance: Dance) -> None:
    f.slow_basic(dance, 1)
    f.slow_basic(dance, -1)
    f.slow_box(dance)
    f.slow_walk(dance, 100)
    f.slow_box(dance)
    f.slow_side(dance)
    f.slow_basic(dance, 1)
    f.slow_basic(dance, -1)
    f.slow_lunge(dance, -1)
    f.slow_box(dance)


@dance
def quick(dance: Dance) -> None:
    f.basic(dance)
    f.side_basic(dance)
    f.double_time(dance)
    f.cross_body(dance)
    f.partner_turn(dance)
    f.crossing(dance)
    f.double_time(dance)
    f.spot_turn(dance)
    f.cross_body(dance)
    f.basic(dance, 0.34)


@dance
def turning(dance: Dance) -> None:
    f.basic(dance)
    f.spot_turn(dance)
    f.travelling_turn(dance, 1)
    f.travelling_turn(dance, -1)
    f.cross_body(dance)
    f.spot_turn(dance)
    f.partner_turn(dance)
    f.cross_body(dance)
    f.travelling_turn(dance, 1)
    f.spot_turn(dance)


@dance
def playful(dance: Dance) -> None:
    f.kicks(dance)
    f.charleston(dance)
    f.shimmies(dance)
    f.hops(dance)
    f.crossing(dance)
    f.charleston(dance)
    f.double_time(dance)
    f.kicks(dance)
    f.shimmies(dance)
    f.hops(dance)
