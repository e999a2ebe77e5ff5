"""Figures of salsa, of eight counts each. Counts are from 0: the "1" of a dancer is 0."""

from __future__ import annotations

from export.leaders.hands import CHEST, LOW, OPEN, RAISED, ROUND, WIDE
from export.leaders.steps import Dance, sides


def basic(dance: Dance, length: float = 0.30) -> None:
    """Salsa's basic step: forward, replace, close; back, replace, close."""
    dance.step(0, "left", 0.01, length)
    dance.step(1, "right", lift=0.03)
    dance.step(2, "left")
    dance.step(4, "right", -0.01, -length)
    dance.step(5, "left", lift=0.03)
    dance.step(6, "right")
    dance.both(0.3, (LOW[0], LOW[1] + 0.02, LOW[2] + 0.06))
    dance.both(4.3, (LOW[0], LOW[1], LOW[2] - 0.05))
    dance.next()


def side_basic(dance: Dance) -> None:
    """To the left, replace, close; to the right, replace, close; arms open with it."""
    dance.step(0, "left", 0.30, -0.03)
    dance.step(1, "right", lift=0.03)
    dance.step(2, "left")
    dance.step(4, "right", -0.30, -0.03)
    dance.step(5, "left", lift=0.03)
    dance.step(6, "right")
    dance.hand(0, "left", OPEN)
    dance.hand(2, "left", LOW)
    dance.hand(4, "right", OPEN)
    dance.hand(6, "right", LOW)
    dance.key(dance.twist, (0, 12), (2, 0), (4, -12), (6, 0))
    dance.next()


def partner_turn(dance: Dance) -> None:
    """A basic step in which the left hand is raised for the partner to turn under."""
    dance.step(0, "left", 0.0, 0.18)
    dance.step(1, "right", lift=0.03)
    dance.step(2, "left")
    dance.step(4, "right", -0.02, -0.2)
    dance.step(5, "left", 0.02, lift=0.03)
    dance.step(6, "right")
    dance.hand(1.6, "left", LOW)
    dance.hand(3.4, "left", RAISED)
    dance.hand(5.6, "left", (0.08, 0.32, 0.20))
    dance.hand(7.4, "left", LOW)
    dance.hand(2.5, "right", LOW)
    dance.hand(4.5, "right", OPEN)
    dance.hand(7.2, "right", LOW)
    dance.key(dance.twist, (3, 0), (4.5, 10), (7, 0))
    dance.next()


def cross_body(dance: Dance) -> None:
    """Cross body lead: out of the partner's way with a quarter turn to the left, then another one."""
    dance.step(0, "left", 0.0, 0.2)
    dance.step(1, "right", lift=0.03)
    dance.step(2, "left", 0.10, -0.02, turn=90, move=(0.05, -0.05))
    dance.hand(1, "right", LOW)
    dance.hand(3, "right", ROUND)
    dance.hand(5, "left", (0.2, -0.22, 0.34))
    dance.step(4, "right", -0.06, -0.16)
    dance.step(5, "left", 0.04, 0.1, turn=90, move=(0.0, 0.12))
    dance.step(6, "right", move=(0.0, 0.08))
    dance.both(7.2, LOW)
    dance.next()


def spot_turn(dance: Dance) -> None:
    """A basic step whose second half is a whole turn on the spot, to the right."""
    dance.step(0, "left", 0.0, 0.2)
    dance.step(1, "right", lift=0.03)
    dance.step(2, "left", turn=-40)
    dance.step(4, "right", -0.02, -0.03, turn=-110, lift=0.03)
    dance.step(5, "left", 0.0, 0.02, turn=-120, lift=0.03)
    dance.step(6, "right", turn=-90, lift=0.03)
    dance.both(2.2, LOW)
    dance.both(4.2, CHEST)
    dance.both(6.2, CHEST)
    dance.both(7.4, LOW)
    dance.key(dance.twist, (2, 0), (3.2, 14), (4.5, -12), (6.5, 0))
    dance.next()


def travelling_turn(dance: Dance, sense: float) -> None:
    """A whole turn in three steps that goes to the side it turns to, then a tap and the arms open."""
    near, far = sides(sense)
    dance.step(0, near, sense * 0.12, 0.0, turn=sense * 80, move=(0.0, 0.16))
    dance.step(1, far, -sense * 0.02, 0.0, turn=sense * 170, move=(0.0, -0.2))
    dance.step(2, near, sense * 0.06, 0.0, turn=sense * 110, move=(sense * 0.14, 0.0))
    dance.step(3.1, far, sense * 0.03, 0.04, weight=False, lift=0.03)
    dance.both(0, CHEST)
    dance.both(2, CHEST)
    dance.both(3.2, WIDE)
    dance.key(dance.lean, (2.4, 0), (3.3, -5), (4.6, 0))
    dance.step(4, far, 0.0, -0.1)
    dance.step(5, near, lift=0.03)
    dance.step(6, far)
    dance.both(5.4, LOW)
    dance.next()


def double_time(dance: Dance) -> None:
    """Quick steps on every half count: a triple to the left and one to the right, twice."""
    for at, sign in ((0, 1), (2, -1)):
        side, other = sides(sign)
        dance.step(at, side, sign * 0.10, 0.06, swing=0.48, lift=0.03)
        dance.step(at + 0.5, other, sign * 0.05, -0.02, swing=0.42, lift=0.025)
        dance.step(at + 1, side, sign * 0.02, 0.0, swing=0.42, lift=0.025)
    dance.step(4, "left", -0.06, 0.20, swing=0.6)
    dance.step(4.5, "right", swing=0.42, lift=0.025)
    dance.step(5, "left", 0.06, -0.18, swing=0.45)
    dance.step(5.5, "right", swing=0.42, lift=0.025)
    dance.step(6, "left", swing=0.45)
    dance.step(7, "right", swing=0.5, lift=0.03)
    dance.both(0, CHEST)
    dance.hand(1, "left", (0.12, -0.2, 0.24))
    dance.hand(1, "right", (-0.14, -0.12, 0.3))
    dance.hand(3, "left", (-0.14, -0.12, 0.3))
    dance.hand(3, "right", (0.12, -0.2, 0.24))
    dance.both(4.5, CHEST)
    dance.both(7.2, LOW)
    dance.key(dance.twist, (0, 0), (1, -14), (3, 14), (4.5, 0))
    dance.key(dance.crouch, (-0.5, 0), (0.5, 0.035), (5.5, 0.035), (7, 0))
    dance.next()


def crossing(dance: Dance) -> None:
    """Suzie Q: one foot crosses in front of the other, side by side, to the left and back."""
    for at, sign in ((0, 1), (4, -1)):
        side, other = sides(sign)
        dance.step(at, other, sign * 0.27, 0.12, swing=0.6)
        dance.step(at + 1, side, sign * 0.16, -0.02, swing=0.6, lift=0.03)
        dance.step(at + 2, other, sign * 0.30, 0.12, swing=0.6)
        dance.step(at + 3, side, 0.0, 0.0, move=(sign * 0.12, 0.0), swing=0.6, lift=0.03)
        dance.key(dance.twist, (at, -sign * 16), (at + 1, sign * 8), (at + 2, -sign * 16), (at + 3, 0))
        dance.hand(at, "left", (0.2, -0.24, 0.2))
        dance.hand(at, "right", (0.2, -0.24, 0.2))
        dance.both(at + 1, CHEST)
        dance.both(at + 2, (0.2, -0.24, 0.2))
        dance.both(at + 3, CHEST)
    dance.step(7.4, "right", swing=0.45, lift=0.03)
    dance.both(7.6, LOW)
    dance.next()
