"""Compare an exported model with PyTorch: the graphs of both backends, a full sampling, several lengths.

python -m export.verify --checkpoint training/checkpoints/salsa --model web/public/models/salsa
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from rich.console import Console
from rich.table import Table
from torch import Tensor

from export.golden import Scene, reference, sample
from export.runtime import Exported, open_model
from export.weights import round_convolutions
from training.checkpoint import load_model
from training.command_line import run_program
from training.config import FPS
from training.diffusion.guidance import layer_gains
from training.diffusion.model import Model

TOLERANCE = 1e-4
"""Of single precision: the largest difference of memory and latents, and metres of joints."""

INT8_TOLERANCE = 0.015
"""Metres, mean over joints and frames, by which products in 8 bits may move a dance: an eighth of what another seed
does to the shipped model's. Processors with AVX2 alone are the worst: their sums of two products end at 16 bits, those
of WebAssembly and of newer processors do not."""

ROUNDING_TOLERANCE = 0.005
"""Metres, likewise, for the rounded convolutions of the condition and the decode graph."""

BLOCKS = (1, 2, 9)

CAPTION = (
    "The largest difference of numbers, of the reactor's joints in metres. distance, int8, rounding: the mean distance "
    "of joints, metres; int8 is of the graphs with products in 8 bits, rounding of weights stored in fewer bits."
)


@dataclass(frozen=True)
class Options:
    checkpoint: Path
    """Folder with hfsq and denoiser weights, which the model was exported from."""
    model: Path
    """Folder of the exported model."""
    blocks: tuple[int, ...] = BLOCKS
    """Lengths of the dances that are compared, in blocks of eight seconds: 75 is a dance of ten minutes."""


def differences(truth: dict[str, np.ndarray], exported: Exported) -> dict[str, float]:
    """Largest absolute difference of memory, unfamiliarity, the branches' latents, and of the decoded joints in metres
    from those of PyTorch; and the mean distance of the joints, metres.
    """
    given = {name: torch.from_numpy(value) for name, value in truth.items()}
    memory = exported.condition(*(given[name] for name in ("leader", "music", "music_valid", "role")))
    branches, latents = sample(exported, given)
    gains = layer_gains(given["fine"], exported.sampling.layers)
    reactor = exported.decode(latents, given["leader"], gains, given["role"])

    def worst(a: Tensor, b: np.ndarray) -> float:
        return float(np.abs(a.numpy() - b).max())

    return {
        "memory": worst(memory, truth["memory"]),
        "unfamiliarity": worst(exported.unfamiliarity(given["leader"]), truth["unfamiliarity"]),
        "branches": worst(branches, truth["branches"]),
        "reactor": worst(reactor, truth["reactor"]),
        "distance": distance(reactor.numpy(), truth["reactor"]),
    }


def distance(a: np.ndarray, b: np.ndarray) -> float:
    """Metres between the joints of two motions (T, 22, 3), the mean over joints and frames."""
    return float(np.linalg.norm(a - b, axis=-1).mean())


def verify(
    model: Model, folder: Path, blocks: tuple[int, ...], log: Callable[[str], None] = lambda _: None
) -> dict[int, dict[str, float]]:
    """Differences for clips of so many blocks, the last one not full: of the graphs in single precision from the
    rounded model, of those with 8-bit products from it (int8), and of the rounded model from the one given (rounding).
    log: told of each length before it is verified, which takes a while. Raises ValueError beyond the
    tolerances, and for a folder that was exported from a network of other sizes.
    """
    single, int8 = open_model(folder, backend="webgpu"), open_model(folder, backend="wasm")
    for name in ("block", "layers", "channels"):
        there, here = getattr(single.sampling, name), getattr(model.sampling, name)
        if there != here:
            raise ValueError(
                f"{folder} was exported from another checkpoint: its manifest has {name} {there}, the checkpoint {here}"
            )
    rounded = round_convolutions(model)
    latent = single.manifest["latent"]
    results: dict[int, dict[str, float]] = {}
    for count in blocks:
        frames = latent["stride"] * (count * latent["block"] - latent["block"] // 3)
        log(f"verifying a dance of {frames / FPS:.0f} s against PyTorch")
        scene = Scene(frames, silent_from=frames * 3 // 4)
        truth = reference(rounded, scene)
        results[count] = {
            **differences(truth, single),
            "int8": differences(truth, int8)["distance"],
            "rounding": distance(truth["reactor"], reference(model, scene)["reactor"]),
        }
        bad = {name: value for name, value in results[count].items() if not value <= tolerance(name)}
        if bad:
            raise ValueError(f"{folder}: {count} blocks differ from PyTorch by more than is allowed: {bad}")
    return results


def tolerance(name: str) -> float:
    """The most that a difference may be."""
    return {"int8": INT8_TOLERANCE, "rounding": ROUNDING_TOLERANCE}.get(name, TOLERANCE)


def print_now(line: str) -> None:
    """Prints a line at once, also where the output is no terminal."""
    print(line, flush=True)


def main(options: Options) -> None:
    results = verify(load_model(options.checkpoint), options.model, options.blocks, print_now)
    table = Table(title="onnxruntime against PyTorch", caption=CAPTION, caption_justify="left")
    for column in ("blocks", *next(iter(results.values()))):
        table.add_column(column, justify="right")
    for count, row in results.items():
        table.add_row(str(count), *(f"{value:.1e}" for value in row.values()))
    Console(width=100).print(table)


if __name__ == "__main__":
    run_program(main, Options)
