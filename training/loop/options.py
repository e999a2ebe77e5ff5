"""Options of every training program, and the duets that they name."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from lightning_fabric import Fabric

from training.config import check_latent_frames, check_limits
from training.data.bvh.file import FRAME_RATES
from training.data.sources import read_split
from training.data.splits import Split, summary
from training.denoiser.clips import Augmentation

Precision = Literal["32-true", "bf16-mixed"]


@dataclass(frozen=True, kw_only=True)
class LoopOptions:
    """The options of both programs."""

    data: Path
    """Duets: an npz archive, a DD100 root, or a folder of paired BVH files (see training/data/sources.py)."""
    fps: float | None = None
    """Frame rate of the BVH files of --data where their headers are wrong."""
    out: Path
    """Folder of this run: checkpoints, logs, curves."""
    val: tuple[str, ...]
    """Names of duets that choose a model; never trained on."""
    test: tuple[str, ...] = ()
    """Names of duets that are never trained on, nor used to choose anything; DD100 has its own."""
    learn_all: bool = False
    """Train on the duets of --val and --test too: for weights that ship once all is chosen and measured without."""
    init: Path | None = None
    """Start from the weights of this checkpoint."""
    solo: Path | None = None
    """npz archive of solo dances that join the training."""
    solo_prefixes: tuple[str, ...] = ("",)
    """Names that those solos begin with; all of them when left out."""
    steps: int
    """Batches to train on."""
    minutes: float | None = None
    """Stop after this time even if the steps are not done; the learning rate follows whichever comes first."""
    batch: int
    """Windows to a step, on each device."""
    learning_rate: float
    """The greatest; it rises at first and falls along half a cosine to 2 % of it."""
    weight_decay: float
    """Of the optimiser; 0 leaves it out."""
    ema_decay: float = 0.998
    """Of the average of the weights that is measured and saved."""
    seed: int = 0
    """Of all random numbers."""
    devices: int = 1
    """Processes on one GPU each, or on the CPU where there is none."""
    threads: int = 0
    """CPU threads for torch, 0 leaves its default."""
    precision: Precision | None = None
    """Left out: bf16 where its products are fast, single elsewhere."""
    log_every: int = 50
    """Steps between printed lines."""
    evaluate_every: int
    """Steps between measurements on the validation duets, at which the state is saved too."""
    resume: bool = False
    """Go on with the training in --out from its saved state."""

    def __post_init__(self) -> None:
        if not self.val:
            raise ValueError("no duets to validate on: name one or more with --val")
        check_limits(
            self,
            **dict.fromkeys(("steps", "batch", "devices", "log_every", "evaluate_every"), (1, math.inf)),
            **dict.fromkeys(("learning_rate", "weight_decay", "threads"), (0, math.inf)),
            minutes=(1e-3, math.inf),
            ema_decay=(0, 1),
            fps=FRAME_RATES,
            seed=(0, 2**20),
        )
        if self.solo is None and self.solo_prefixes != ("",):
            raise ValueError("--solo-prefixes chooses among the dances of --solo, which was not given")


@dataclass(frozen=True, kw_only=True)
class WindowOptions(LoopOptions):
    """Options of the programs that train on windows of latents: the denoiser and the baselines."""

    music_cache: Path | None = None
    """Folder in which music features are kept between runs."""
    steps: int = 6000
    batch: int = 32
    stride: int = 4
    """Frames between training windows, a multiple of 4 (the paper's Table 6)."""
    learning_rate: float = 5e-4
    weight_decay: float = 0.02
    synths: int = 3
    """Synthesised pieces of music per duet and tempo."""
    evaluate_every: int = 600
    augmentation: Augmentation = field(default_factory=Augmentation)

    def __post_init__(self) -> None:
        super().__post_init__()
        check_latent_frames("stride", self.stride)
        check_limits(self, synths=(0, math.inf))


def read_duets_to_train(options: LoopOptions, fabric: Fabric, window: int) -> Split:
    """The options' duets, split by name; with `learn_all` all of them are to train on and none is left to measure.

    window: frames of a training window. Prints what was read. Raises ValueError where none is left to train on.
    """
    duets = read_split(options.data, options.val, options.test, options.fps)
    if options.learn_all:
        duets = Split(duets.train + duets.val + duets.test, (), ())
    if not duets.train:
        raise ValueError(
            f"nothing is left of {options.data} to train on: name fewer duets with --val and --test, or add --learn-all"
        )
    fabric.print(summary(duets, window))
    return duets
