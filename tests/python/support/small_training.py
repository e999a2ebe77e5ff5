"""Made duets and options that train either stage for two steps."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from tests.python.support.duets import made_duet
from training import train_denoiser, train_hfsq
from training.config import (
    ConditionConfig,
    DenoiserConfig,
    DenoiserLossConfig,
    DiffusionConfig,
    HfsqConfig,
)
from training.denoiser.clips import Augmentation

HFSQ = HfsqConfig(groups=2, widths=(16, 16, 8), depth=1, refine_width=8)
DENOISER = DenoiserConfig(width=16, depths=(1, 1), mlp=2, condition=ConditionConfig(depth=1))


def write_duets(folder: Path) -> Path:
    """An archive of made_0, made_1 and made_2, ten seconds each; the options below hold the last two out."""
    arrays: dict[str, np.ndarray] = {}
    for seed in range(3):
        duet = made_duet(300, seed)
        arrays |= {f"made_{seed}/leader": duet.leader, f"made_{seed}/follower": duet.reactor}
    np.savez(folder / "duets.npz", **arrays)  # pyright: ignore[reportArgumentType]
    return folder / "duets.npz"


def stage1(data: Path, out: Path, **changes: object) -> train_hfsq.Options:
    base = train_hfsq.Options(
        data=data, out=out, val=("made_1",), test=("made_2",), steps=2, batch=2, tempos=(1.0,), hfsq=HFSQ,
        log_every=1, evaluate_every=2, precision="32-true",
    )  # fmt: skip
    return replace(base, **changes)


def stage2(data: Path, out: Path, **changes: object) -> train_denoiser.Options:
    base = train_denoiser.Options(
        data=data, out=out, val=("made_1",), test=("made_2",), steps=2, batch=4, synths=1, denoiser=DENOISER,
        diffusion=DiffusionConfig(steps=2), loss=DenoiserLossConfig(windows=2), log_every=1, evaluate_every=2,
        augmentation=Augmentation(tempos=(1.0,), copies=1), precision="32-true",
    )  # fmt: skip
    return replace(base, **changes)
