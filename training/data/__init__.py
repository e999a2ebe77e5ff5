"""Duets of two dancers: readers, splits, windows and augmentation."""

from training.data.duet import FPS, Duet, Solo
from training.data.npz import read_npz, read_solo
from training.data.splits import Split, split

__all__ = ["FPS", "Duet", "Solo", "Split", "read_npz", "read_solo", "split"]
