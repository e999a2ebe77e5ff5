"""Figures with kicks, jumps and shaking shoulders, of eight counts each, counted from 0."""

from __future__ import annotations

from export.leaders.hands import CHEST, CLAP, HIGH, HIP
from export.leaders.steps import Dance, sides


def kicks(dance: Dance) -> None:
    """Kick, step, and a clap, to either side."""
    for at, sign in ((0, 1), (4, -1)):
        side, other = sides(sign)
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
    for at, sign in ((0.9, 1), (2.9, -1)):
        side, other = sides(sign)
        dance.step(at, side, 0.0, 0.0, swing=1.5, lift=0.36, over=(sign * 0.13, 0.26))
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
    for at, sign in ((0.2, -1), (1.2, 1), (3.0, -1), (5.0, 1), (6.2, -1)):
        forward, back = sides(sign)
        dance.hand(at, forward, (-0.06, -0.12, 0.36))
        dance.hand(at, back, (0.20, -0.30, -0.16))
    dance.both(7.4, CHEST)
    dance.key(dance.lean, (0, 3), (1.1, -8), (3, 12), (5, 0))
    dance.key(dance.crouch, (0, 0.02), (2, 0.04), (3, 0.03), (5, 0.0))
    dance.next()
