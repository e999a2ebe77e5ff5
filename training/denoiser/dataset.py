"""The clips of a training: duets with music paired with them, and pairs made from solos."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from training.config import ConditionConfig, FrameConfig
from training.data.music_pairing import MusicBank, build_music_bank, variants
from training.data.npz import read_solo
from training.data.splits import Split
from training.denoiser.clips import Augmentation, Clip, augmented_clips, solo_pair_clips
from training.hfsq.autoencoder import Autoencoder
from training.loop import LoopOptions


@dataclass(frozen=True, kw_only=True)
class DatasetOptions(LoopOptions):
    """What a denoiser learns from. solo: dances of which pairs are made (see training/data/solo_pairs.py)."""

    songs: Path | None = None
    """Folder of songs to pair with duets that have none; without it the synthesiser plays alone."""
    music_cache: Path | None = None
    """Folder in which music features are kept between runs."""
    synths: int = 3
    pieces: int = 2
    """Synthesised pieces and songs per duet and tempo."""
    solo_copies: int = 1
    """Pairs of every solo dance and of its mirror image."""
    augmentation: Augmentation = field(default_factory=Augmentation)


def music_of(options: DatasetOptions, duets: Split) -> MusicBank:
    """Music features for every duet at every tempo: its own song, songs that fit, synthesised pieces."""
    wanted = variants(options.augmentation.tempos, options.synths, options.pieces if options.songs else 0)
    return build_music_bank(duets, options.songs, wanted, cache_dir=options.music_cache)


def duet_clips(
    options: DatasetOptions,
    duets: Split,
    bank: MusicBank,
    hfsq: Autoencoder,
    frame: FrameConfig,
    condition: ConditionConfig,
) -> list[Clip]:
    """The training duets, augmented and encoded."""
    return augmented_clips(duets.train, bank, hfsq, frame, options.augmentation, condition, options.seed)


def solo_clips(
    options: DatasetOptions, hfsq: Autoencoder, frame: FrameConfig, condition: ConditionConfig
) -> list[Clip]:
    """Pairs made from solo dances, encoded; none without an archive of solos."""
    if options.solo is None:
        return []
    solos = read_solo(options.solo, options.solo_prefixes)
    return solo_pair_clips(solos, options.solo_copies, hfsq, frame, condition, options.seed)
