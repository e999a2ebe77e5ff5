"""Splits by whole sequences, so that no window of a held-out dance is ever trained on."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from training.data.duet import FPS, Duet


@dataclass(frozen=True, eq=False)
class Split:
    """Duets to learn from, to choose by, and to report on."""

    train: tuple[Duet, ...]
    val: tuple[Duet, ...]
    test: tuple[Duet, ...]


def summary(duets: Split, window: int) -> str:
    """What was read, in a line. window: frames of a training window; of what is shorter little or nothing is learnt."""
    read = (*duets.train, *duets.val, *duets.test)
    songs = sum(duet.song is not None for duet in duets.train)
    short = sum(len(duet) < window for duet in duets.train)
    minutes = sum(len(duet) for duet in read) / FPS / 60
    return (
        f"{len(read)} duets of {minutes:.1f} minutes: {len(duets.train)} to train on, "
        f"{songs} of them with a song of their own, {short} shorter than a window of {window / FPS:.3g} s; "
        f"{len(duets.val)} for validation, {len(duets.test)} for test"
    )


def split(duets: Iterable[Duet], val: Collection[str], test: Collection[str]) -> Split:
    """Duets by name: those in `val`, those in `test`, and all others to train on; order kept.

    Raises ValueError for a name that is in no duet, in both sets, or twice among the duets: a misspelt name
    would silently train on a test sequence.
    """
    duets = tuple(duets)
    names = [duet.name for duet in duets]
    if len(set(names)) < len(names):
        raise ValueError(f"names occur twice: {sorted({n for n in names if names.count(n) > 1})}")
    if both := set(val) & set(test):
        raise ValueError(f"both validation and test: {sorted(both)}")
    if unknown := (set(val) | set(test)) - set(names):
        raise ValueError(f"not among the duets: {sorted(unknown)}; there are {', '.join(names)}")
    return Split(
        train=tuple(d for d in duets if d.name not in val and d.name not in test),
        val=tuple(d for d in duets if d.name in val),
        test=tuple(d for d in duets if d.name in test),
    )
