"""What sharpening leaves alone and what it makes louder, on motions whose spectrum is known."""

import numpy as np
import pytest
import torch

from training.config import FPS
from training.motion.sharpen import RADIUS_FRAMES, sharpen

FRAMES = 120
INNER = slice(RADIUS_FRAMES, FRAMES - RADIUS_FRAMES)
SECONDS = torch.arange(FRAMES, dtype=torch.float64) / FPS


def gain_at(hertz: float, gain: float) -> float:
    """How much louder a swing of `hertz` is afterwards, away from the ends."""
    swing = torch.stack(
        [torch.sin(2 * np.pi * hertz * SECONDS), torch.cos(2 * np.pi * hertz * SECONDS)], dim=1
    )
    out = sharpen(swing, gain)[INNER]
    # The phase stays: what comes out is a multiple of what went in.
    ratio = (out * swing[INNER]).sum() / swing[INNER].square().sum()
    assert torch.allclose(out, ratio * swing[INNER], atol=2e-3)
    return float(ratio)


@pytest.mark.parametrize(
    ("hertz", "expected"), [(0.5, 1.0), (2.0, 1.0), (3.0, 1.02), (6.0, 1.2), (10.0, 1.4), (14.0, 1.4)]
)
def test_only_frequencies_above_6_hz_are_amplified(hertz: float, expected: float) -> None:
    assert gain_at(hertz, 0.4) == pytest.approx(expected, abs=0.02)


def test_constant_velocity_stays_to_the_ends() -> None:
    straight = torch.stack([SECONDS * 2.0 + 1.0, -SECONDS, torch.ones(FRAMES, dtype=torch.float64)], dim=1)
    assert torch.allclose(sharpen(straight, 0.7), straight, atol=1e-6)


def test_short_clips_keep_their_length() -> None:
    assert sharpen(torch.randn(4, 3), 0.5).shape == (4, 3)


def test_no_gain_changes_nothing() -> None:
    values = torch.randn(50, 3)
    assert torch.equal(sharpen(values, 0.0), values)
