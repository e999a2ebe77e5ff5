"""The four dances: a slow one, a quick one, one that turns and a playful one."""

from __future__ import annotations

from export.leaders import half_tempo, play, salsa
from export.leaders.steps import Dance


def slow(dance: Dance) -> None:
    half_tempo.basic(dance, 1)
    half_tempo.basic(dance, -1)
    half_tempo.box(dance)
    half_tempo.walk(dance, 100)
    half_tempo.box(dance)
    half_tempo.side(dance)
    half_tempo.basic(dance, 1)
    half_tempo.basic(dance, -1)
    half_tempo.lunge(dance, -1)
    half_tempo.box(dance)


def quick(dance: Dance) -> None:
    salsa.basic(dance)
    salsa.side_basic(dance)
    salsa.double_time(dance)
    salsa.cross_body(dance)
    salsa.partner_turn(dance)
    salsa.crossing(dance)
    salsa.double_time(dance)
    salsa.spot_turn(dance)
    salsa.cross_body(dance)
    salsa.basic(dance, 0.34)


def turning(dance: Dance) -> None:
    salsa.basic(dance)
    salsa.spot_turn(dance)
    salsa.travelling_turn(dance, 1)
    salsa.travelling_turn(dance, -1)
    salsa.cross_body(dance)
    salsa.spot_turn(dance)
    salsa.partner_turn(dance)
    salsa.cross_body(dance)
    salsa.travelling_turn(dance, 1)
    salsa.spot_turn(dance)


def playful(dance: Dance) -> None:
    play.kicks(dance)
    play.charleston(dance)
    play.shimmies(dance)
    play.hops(dance)
    salsa.crossing(dance)
    play.charleston(dance)
    salsa.double_time(dance)
    play.kicks(dance)
    play.shimmies(dance)
    play.hops(dance)


DANCES = {"slow": (slow, 4), "quick": (quick, 5), "turning": (turning, 7), "playful": (playful, 7)}
"""By name what is danced, and the seed of its small irregularities."""
