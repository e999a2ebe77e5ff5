"""Where hands are in the dances, seen from their own shoulder: outwards, up, ahead; metres."""

from __future__ import annotations

Hand = tuple[float, float, float]

LOW: Hand = (-0.03, -0.28, 0.20)
"""In front of the waist, as partners hold them between each other."""
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
