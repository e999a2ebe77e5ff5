"""Figures at half the tempo, of eight counts each. Counts are from 0: the "1" of a dancer is 0."""

from __future__ import annotations

from export.leaders.hands import HELD, LOW, OPEN, RAISED, ROUND, WIDE
from export.leaders.steps import Dance, sides


def side(dance: Dance) -> None:
    """A long step to the left on 1, the other foot drawn up on 3, a sway on 5 and 7."""
    dance.step(0, "left", 0.0, 0.0, move=(0.36, 0.0), swing=1.5, lift=0.04)
    dance.step(2.4, "right", 0.02, 0.0, swing=1.7, lift=0.02)
    dance.step(4.4, "left", 0.20, -0.02, swing=1.3, lift=0.035)
    dance.step(6.6, "right", 0.05, 0.03, swing=1.5, lift=0.02, weight=False)
    dance.hand(0, "left", HELD)
    dance.hand(0.4, "right", ROUND)
    dance.hand(4.5, "left", WIDE)
    dance.hand(6.2, "left", (0.34, 0.10, 0.2))
    dance.hand(8, "left", HELD)
    dance.key(dance.twist, (2, 0), (4.6, 14), (7.6, 0))
    dance.key(dance.lean, (3, 0), (5, 3), (7.5, 0))
    dance.key(dance.crouch, (-1, 0), (0.3, 0.03), (2.4, 0.0), (4.6, 0.035), (7.4, 0.0))
    dance.next()
    # What was only tapped is where the next figure begins.
    dance.place = dance.place + dance.axes() @ (0.1, 0.0)


def basic(dance: Dance, sense: float) -> None:
    """Forward and back to close over eight counts, or backwards for sense -1, with time for the hips."""
    first, other = sides(sense)
    dance.step(0, first, 0.0, sense * 0.36, swing=1.2)
    dance.step(2, other, 0.0, 0.02, swing=1.0, lift=0.03)
    dance.step(4, first, swing=1.2)
    dance.step(6.2, other, 0.06, -sense * 0.05, swing=1.0, lift=0.02, weight=False)
    dance.both(0.4, (LOW[0], LOW[1] + 0.03, LOW[2] + sense * 0.08))
    dance.hand(4.4, "left", RAISED if sense < 0 else (0.1, -0.12, 0.28))
    dance.hand(4.4, "right", OPEN if sense < 0 else LOW)
    dance.hand(7.4, "left", LOW)
    dance.hand(7.4, "right", LOW)
    dance.key(dance.twist, (0, 0), (2, 7), (4, -7), (7, 0))
    dance.key(dance.crouch, (-0.6, 0.0), (0.4, 0.03), (2.4, 0.0), (4.2, 0.015), (6, 0))
    dance.next()


def box(dance: Dance) -> None:
    """Forward, side, close, then back, side, close, each of two counts or more."""
    dance.step(0, "left", 0.0, 0.34, swing=1.4)
    dance.step(1.9, "right", -0.16, 0.30, swing=1.4, lift=0.03)
    dance.step(3.3, "left", -0.14, 0.30, swing=1.0, lift=0.025)
    dance.step(4.6, "right", -0.06, -0.10, swing=1.1)
    dance.step(6.1, "left", 0.10, -0.04, swing=1.2, lift=0.03)
    dance.step(7.4, "right", swing=1.0, lift=0.025)
    dance.hand(0.5, "left", HELD)
    dance.hand(0.5, "right", ROUND)
    dance.key(dance.crouch, (-0.6, 0.0), (0.4, 0.035), (3.2, 0.0), (4.8, 0.035), (7.5, 0.0))
    dance.key(dance.twist, (0, 0), (2.2, -8), (4, 0), (6.4, 8), (8, 0))
    dance.next()


def walk(dance: Dance, turn: float) -> None:
    """Four slow steps along a curve."""
    for k, sign in enumerate((1, -1, 1, -1)):
        side, _ = sides(sign)
        dance.step(2 * k, side, -sign * 0.03, 0.06, turn=turn / 4, move=(0.0, 0.27), swing=1.25, lift=0.05)
    dance.hand(1, "left", OPEN)
    dance.hand(1, "right", OPEN)
    dance.hand(4, "left", HELD)
    dance.hand(4, "right", ROUND)
    dance.key(dance.crouch, (0, 0.01), (8, 0.01))
    dance.next()


def lunge(dance: Dance, sign: float) -> None:
    """A wide step with a bent knee, arms open, held, and back up."""
    near, far = sides(sign)
    dance.step(0.2, near, sign * 0.50, 0.10, swing=1.5, lift=0.06)
    dance.hand(-0.6, near, HELD)
    dance.hand(2.2, near, (0.44, 0.16, 0.16))
    dance.hand(2.2, far, (0.40, -0.22, -0.02))
    dance.key(dance.crouch, (-0.8, 0.0), (1.6, 0.13), (3.6, 0.12), (5.6, 0.0))
    dance.key(dance.twist, (0, 0), (2.4, sign * 22), (4.4, sign * 16), (6.4, 0))
    dance.key(dance.lean, (0.4, 0), (2.4, -6), (6, 0))
    dance.step(5.0, far, sign * 0.02, 0.0, swing=0.9, lift=0.02)
    dance.step(6.9, near, sign * 0.02, 0.0, swing=1.5, lift=0.03)
    dance.hand(6.6, near, HELD)
    dance.hand(6.6, far, ROUND)
    dance.step(8.0, far, swing=0.8, lift=0.02)
    dance.next()
