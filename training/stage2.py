"""What the programs of stage 2 share: the dances and songs that they learn from, and how they validate."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from training.config import STRIDE, ConditionConfig, FrameConfig, check_limits
from training.data.duet import Duet
from training.data.music_pairing import MusicBank, build_music_bank, variants
from training.data.npz import read_solo
from training.data.splits import Split
from training.denoiser.clips import Clip, augmented_clips, solo_pair_clips
from training.diffusion.model import Model
from training.diffusion.react import Request, react
from training.evaluation.metrics import mean_report, quick_report
from training.hfsq.autoencoder import Autoencoder
from training.loop.options import WindowOptions

PREPARING = "making the music of all dances and encoding them (--music-cache keeps the music)"
"""Printed before the first step, until which nothing else is."""


@dataclass(frozen=True, kw_only=True)
class ClipOptions(WindowOptions):
    """What dances and songs stage 2 learns from. solo: dances of which pairs are made (see
    training/data/solo_pairs.py).
    """

    songs: Path | None = None
    """Folder of songs to pair with duets that have none; without it the synthesiser plays alone."""
    solo_copies: int = 1
    """Pairs of every solo dance and of its mirror image."""
    pieces: int = 2
    """Songs per duet and tempo."""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_limits(self, solo_copies=(1, math.inf), pieces=(0, math.inf))
        if self.solo is None and self.solo_copies != 1:
            raise ValueError("--solo-copies is of the dances of --solo, which was not given")
        if self.songs is None and self.pieces != ClipOptions.pieces:
            raise ValueError("--pieces is the number of songs from --songs, which was not given")


def music_of(options: ClipOptions, duets: Split) -> MusicBank:
    """Music features for every duet at every tempo of training and at its own: its song, songs that fit, synthesised
    pieces.
    """
    tempos = sorted({*options.augmentation.tempos, 1.0})
    wanted = variants(tempos, options.synths, options.pieces if options.songs else 0)
    return build_music_bank(duets, options.songs, wanted, cache_dir=options.music_cache)


def duet_clips(
    options: ClipOptions,
    condition: ConditionConfig,
    duets: Split,
    bank: MusicBank,
    hfsq: Autoencoder,
    frame: FrameConfig,
) -> list[Clip]:
    """The training duets, augmented and encoded."""
    return augmented_clips(duets.train, bank, hfsq, frame, options.augmentation, condition, options.seed)


def solo_clips(
    options: ClipOptions, condition: ConditionConfig, hfsq: Autoencoder, frame: FrameConfig
) -> list[Clip]:
    """Pairs made from solo dances, encoded; none without an archive of solos."""
    if options.solo is None:
        return []
    solos = read_solo(options.solo, options.solo_prefixes)
    return solo_pair_clips(solos, options.solo_copies, hfsq, frame, condition, options.seed)


def validate(model: Model, bank: MusicBank, duets: Sequence[Duet], seeds: int = 2) -> dict[str, float]:
    """Mean quick report over the validation duets and seeds, default steps and guidance."""
    rows = []
    for duet in duets:
        frames = len(duet) // STRIDE * STRIDE
        music = next(iter(bank[duet.name].values()), None)
        for seed in range(seeds):
            made = react(model, Request(duet.leader[:frames], music, seed))
            rows.append(quick_report(duet.leader[:frames], duet.reactor[:frames], made))
    return {f"val/{k}": value for k, value in mean_report(rows).items()}
