"""Duets of two dancers: readers, splits, augmentation, and the music they are danced to."""
