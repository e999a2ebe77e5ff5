"""Compare an exported model with PyTorch: every graph, every step of a full sampling, several lengths.

python -m export.verify --checkpoint training/checkpoints/salsa --model web/public/models/salsa
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
import tyro
from rich.console import Console
from rich.table import Table
from torch import Tensor

from export.golden import Scene, reference
from export.runtime import Exported, open_model
from training.checkpoint import load_model
from training.diffusion.guidance import blend, layer_gains, per_channel
from training.diffusion.model import Model
from training.diffusion.react import measure_bones
from training.diffusion.sampler import initial_noise, sample_branches, sample_mean
from training.diffusion.schedule import ddim_steps

TOLERANCE = 1e-4
BLOCKS = (1, 2, 9, 75)


@dataclass(frozen=True)
class Options:
    checkpoint: Path
    model: Path
    blocks: tuple[int, ...] = BLOCKS


def differences(model: Model, exported: Exported, scene: Scene) -> dict[str, float]:
    """Largest absolute difference of memory, unfamiliarity, the branches' latents, and of decoded joints in metres."""
    truth = reference(model, scene)
    given = {name: torch.from_numpy(value) for name, value in truth.items()}
    memory = exported.condition(*(given[name] for name in ("leader", "music", "music_valid", "role")))
    sampling = exported.sampling
    steps = ddim_steps(sampling.alpha_bar, scene.steps, sampling.last_time)
    branches = sample_branches(
        exported,
        given["memory"],
        given["silent"],
        initial_noise(sampling, scene.seed, len(memory)),
        steps,
        sample_mean(exported, given["memory"], steps),
    )
    latents = blend(
        branches,
        per_channel(given["coarse"], sampling.channels),
        float(given["music_guidance"]),
        variety=1.0,
    )
    bones = measure_bones(exported, branches.conditional, given["leader"])
    gains = layer_gains(given["fine"], sampling.layers)
    reactor, _ = exported.decode(latents, given["leader"], gains, bones)

    def worst(a: Tensor, b: np.ndarray) -> float:
        return float(np.abs(a.numpy() - b).max())

    each = torch.stack([branches.conditional, branches.silent, branches.unconditional, branches.mean])
    return {
        "memory": worst(memory, truth["memory"]),
        "unfamiliarity": worst(exported.unfamiliarity(given["leader"]), truth["unfamiliarity"]),
        "branches": worst(each, truth["branches"]),
        "reactor": worst(reactor, truth["reactor"]),
    }


def verify(model: Model, folder: Path, blocks: tuple[int, ...]) -> dict[int, dict[str, float]]:
    """Differences for clips of so many blocks, the last one not full. Raises ValueError beyond the tolerance."""
    exported = open_model(folder)
    stride, size = exported.manifest["latent"]["stride"], exported.manifest["latent"]["block"]
    results: dict[int, dict[str, float]] = {}
    for count in blocks:
        frames = stride * (count * size - size // 3)
        steps = 4 if count < 20 else 1  # the long clip only has to prove that its length works
        results[count] = differences(model, exported, Scene(frames, steps, silent_from=frames * 3 // 4))
        bad = {name: value for name, value in results[count].items() if not value <= TOLERANCE}
        if bad:
            raise ValueError(f"{folder}: {count} blocks differ from PyTorch by more than {TOLERANCE}: {bad}")
    return results


def main(options: Options) -> None:
    results = verify(load_model(options.checkpoint), options.model, options.blocks)
    table = Table(title="largest absolute difference, onnxruntime against PyTorch")
    for column in ("blocks", *next(iter(results.values()))):
        table.add_column(column, justify="right")
    for count, row in results.items():
        table.add_row(str(count), *(f"{value:.1e}" for value in row.values()))
    Console().print(table)


if __name__ == "__main__":
    main(tyro.cli(Options))
