"""Figures of eight counts, of which the dances are made. Counts are from 0: the "1" of a dancer is 0."""

from __future__ import annotations

from export.leaders.steps import LOW, Dance, Hand

RAISED: Hand = (0.02, 0.26, 0.22)
"""A hand over the head, under which a partner turns."""
OPEN: Hand = (0.22, -0.16, 0.22)
WIDE: Hand = (0.46, -0.02, 0.08)
HELD: Hand = (0.10, -0.20, 0.24)
"""The leader's left hand in closed hold."""
ROUND: Hand = (-0.02, -0.27, 0.18)
"""The right one on the partner's shoulder blade."""
CHEST: Hand = (-0.08, -0.20, 0.16)
"""Bent arms close to the body, as in shines."""
HIP: Hand = (0.05, -0.40, 0.06)
CLAP: Hand = (-0.185, -0.08, 0.34)
HIGH: Hand = (0.10, 0.40, 0.12)


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


def side_basic(dance: Dance, length: float = 0.30) -> None:
    """To the left, replace, close; to the right, replace, close; arms open with it."""
    dance.step(0, "left", length, -0.03)
    dance.step(1, "right", lift=0.03)
    dance.step(2, "left")
    dance.step(4, "right", -length, -0.03)
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


def spot_turn(dance: Dance, sense: float = -1.0) -> None:
    """A basic step whose second half is a whole turn on the spot; to the right for sense -1."""
    dance.step(0, "left", 0.0, 0.2)
    dance.step(1, "right", lift=0.03)
    dance.step(2, "left", turn=sense * 40)
    dance.step(4, "right", -0.02, -0.03, turn=sense * 110, lift=0.03)
    dance.step(5, "left", 0.0, 0.02, turn=sense * 120, lift=0.03)
    dance.step(6, "right", turn=sense * 90, lift=0.03)
    dance.both(2.2, LOW)
    dance.both(4.2, CHEST)
    dance.both(6.2, CHEST)
    dance.both(7.4, LOW)
    dance.key(dance.twist, (2, 0), (3.2, -sense * 14), (4.5, sense * 12), (6.5, 0))
    dance.next()


def travelling_turn(dance: Dance, sense: float) -> None:
    """A whole turn in three steps that goes to the side it turns to, then a tap and the arms open."""
    near, far = ("left", "right") if sense > 0 else ("right", "left")
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
    for at, side, other, sign in ((0, "left", "right", 1), (2, "right", "left", -1)):
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
    for at, sign, side, other in ((0, 1, "left", "right"), (4, -1, "right", "left")):
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


def slow_side(dance: Dance, sign: float = 1.0) -> None:
    """A long step to the side on 1, the other foot drawn up on 3, a sway on 5 and 7."""
    near, far = ("left", "right") if sign > 0 else ("right", "left")
    dance.step(0, near, 0.0, 0.0, move=(sign * 0.36, 0.0), swing=1.5, lift=0.04)
    dance.step(2.4, far, sign * 0.02, 0.0, swing=1.7, lift=0.02)
    dance.step(4.4, near, sign * 0.20, -0.02, swing=1.3, lift=0.035)
    dance.step(6.6, far, sign * 0.05, 0.03, swing=1.5, lift=0.02, weight=False)
    dance.hand(0, near, HELD)
    dance.hand(0.4, far, ROUND)
    dance.hand(4.5, near, WIDE)
    dance.hand(6.2, near, (0.34, 0.10, 0.2))
    dance.hand(8, near, HELD)
    dance.key(dance.twist, (2, 0), (4.6, sign * 14), (7.6, 0))
    dance.key(dance.lean, (3, 0), (5, 3), (7.5, 0))
    dance.key(dance.crouch, (-1, 0), (0.3, 0.03), (2.4, 0.0), (4.6, 0.035), (7.4, 0.0))
    dance.next()
    # What was only tapped is where the next figure begins.
    dance.place = dance.place + dance._axes() @ (sign * 0.1, 0.0)


def slow_basic(dance: Dance, sense: float) -> None:
    """Forward and back to close over eight counts, or backwards for sense -1, with time for the hips."""
    first, other = ("left", "right") if sense > 0 else ("right", "left")
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


def slow_box(dance: Dance) -> None:
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


def slow_walk(dance: Dance, turn: float) -> None:
    """Four slow steps along a curve."""
    for k, side in enumerate(("left", "right", "left", "right")):
        sign = 1 if side == "left" else -1
        dance.step(2 * k, side, -sign * 0.03, 0.06, turn=turn / 4, move=(0.0, 0.27), swing=1.25, lift=0.05)
    dance.hand(1, "left", OPEN)
    dance.hand(1, "right", OPEN)
    dance.hand(4, "left", HELD)
    dance.hand(4, "right", ROUND)
    dance.key(dance.crouch, (0, 0.01), (8, 0.01))
    dance.next()


def slow_lunge(dance: Dance, sign: float = 1.0) -> None:
    """A wide step with a bent knee, arms open, held, and back up."""
    near, far = ("left", "right") if sign > 0 else ("right", "left")
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


def kicks(dance: Dance) -> None:
    """Kick, step, and a clap, to either side."""
    for at, side, other, sign in ((0, "left", "right", 1), (4, "right", "left", -1)):
        dance.step(at + 1, side, 0.0, -0.04, swing=1.7, lift=0.34, over=(sign * 0.05, 0.52), weight=True)
        dance.step(at + 2, other, -sign * 0.03, 0.05, swing=0.7)
        dance.step(at + 3, side, swing=0.65, lift=0.03)
        dance.key(dance.lean, (at - 0.8, 0), (at + 0.15, -9), (at + 1.2, 2), (at + 2, 0))
        dance.both(at - 0.5, CHEST)
        dance.hand(at + 0.2, side, (0.22, -0.20, -0.08))
        dance.hand(at + 0.2, other, (-0.02, -0.05, 0.38))
        dance.both(at + 1.2, CHEST)
        dance.both(at + 2.5, (0.12, -0.02, 0.30))
        dance.both(at + 3.0, CLAP)
        dance.both(at + 3.5, CHEST)
    dance.step(7.6, "right", swing=0.5, lift=0.025)
    dance.next()


def hops(dance: Dance) -> None:
    """Knees up, left and right, then a jump with both feet and arms in the air."""
    for at, side, sign in ((0.9, "left", 1), (2.9, "right", -1)):
        dance.step(at, side, 0.0, 0.0, swing=1.5, lift=0.36, over=(sign * 0.13, 0.26))
        other = "right" if side == "left" else "left"
        dance.hand(at - 0.9, side, (0.1, -0.34, -0.05))
        dance.hand(at - 0.9, other, (0.0, 0.06, 0.3))
        dance.key(dance.lean, (at - 0.8, -3), (at, 0))
    dance.step(3.6, "left", swing=0.5, lift=0.025)
    dance.step(5.05, "left", 0.06, 0.04, swing=0.75, lift=0.12)
    dance.step(5.06, "right", -0.06, 0.04, swing=0.75, lift=0.12)
    dance.key(dance.crouch, (3.2, 0.0), (4.0, 0.11), (4.5, -0.01), (5.0, 0.0), (5.4, 0.09), (6.3, 0.0))
    dance.key(dance.hop, (4.28, 0.0), (4.68, 0.10), (5.08, 0.0))
    dance.both(3.6, (0.1, -0.36, -0.04))
    dance.both(4.7, HIGH)
    dance.both(5.4, (0.26, -0.1, 0.2))
    dance.step(6.2, "left", swing=0.6, lift=0.03)
    dance.step(7.2, "right", swing=0.6, lift=0.03)
    dance.both(7, CHEST)
    dance.next()


def shimmies(dance: Dance) -> None:
    """Deep in the knees, shoulders shake over a wide step to either side."""
    dance.step(0, "left", 0.24, 0.05, swing=0.8)
    dance.step(3, "left", 0.0, 0.0, swing=0.7)
    dance.step(4, "right", -0.24, 0.05, swing=0.8)
    dance.step(7, "right", swing=0.7)
    dance.both(0, (0.22, -0.24, 0.16))
    dance.both(3.2, HIP)
    dance.both(4, (0.22, -0.24, 0.16))
    dance.both(7, CHEST)
    dance.key(dance.crouch, (-0.7, 0), (0.3, 0.09), (2.2, 0.09), (3.2, 0), (4.3, 0.09), (6.2, 0.09), (7.2, 0))
    dance.key(dance.shimmy, (0.0, 0), (0.5, 11), (2.4, 11), (3, 0), (4.2, 0), (4.6, 11), (6.4, 11), (7, 0))
    dance.key(dance.lean, (0, 0), (0.8, 9), (2.4, -3), (3.4, 0), (4.8, 9), (6.4, -3), (7.2, 0))
    dance.next()


def charleston(dance: Dance) -> None:
    """Back, kick in front, step, kick behind, with swinging arms."""
    dance.step(0, "left", 0.0, -0.14, swing=0.7)
    dance.step(2, "right", 0.0, 0.0, swing=1.7, lift=0.26, over=(-0.10, 0.48))
    dance.step(3.8, "left", 0.0, 0.02, swing=1.5, lift=0.20, over=(0.10, -0.40))
    dance.step(4.8, "right", 0.0, 0.12, swing=0.6)
    dance.step(6, "left", 0.0, 0.16, swing=0.8, lift=0.05, weight=False)
    dance.step(7.2, "left", swing=0.7, lift=0.04)
    dance.step(8.0, "right", swing=0.6, lift=0.03)
    for at, forward in ((0.2, "right"), (1.2, "left"), (3.0, "right"), (5.0, "left"), (6.2, "right")):
        back = "left" if forward == "right" else "right"
        dance.hand(at, forward, (-0.06, -0.12, 0.36))
        dance.hand(at, back, (0.20, -0.30, -0.16))
    dance.both(7.4, CHEST)
    dance.key(dance.lean, (0, 3), (1.1, -8), (3, 12), (5, 0))
    dance.key(dance.crouch, (0, 0.02), (2, 0.04), (3, 0.03), (5, 0.0))
    dance.next()
