"""Export a checkpoint to the folder that the page loads.

python -m export.write --checkpoint training/checkpoints/salsa --out web/public/models/salsa
"""

from __future__ import annotations

import json
import logging
import warnings
from dataclasses import dataclass
from pathlib import Path

from export.golden import Scene, reference
from export.golden import write as write_golden
from export.manifest import LAYERS, Card, make_card, manifest
from export.onnx_files import describe, describe_file, graphs, write_onnx
from export.verify import BLOCKS, print_now, verify
from export.weights import round_convolutions
from training.checkpoint import load_model, read_card
from training.command_line import run_program
from training.data.naming import naming
from training.diffusion.model import Model

GOLDEN = "golden.npz"


@dataclass(frozen=True)
class Options:
    checkpoint: Path
    """Folder with hfsq, denoiser and card.json."""
    out: Path
    """Folder of the exported model; files of an earlier export are replaced."""


def write_model(model: Model, card: Card, folder: Path, scene: Scene) -> None:
    """Graphs, golden tensors and manifest of the model with rounded convolutions into `folder`.

    Raises ValueError for a model of other layers than the page steers, or that is sampled with stitching or
    extrapolation, which the page does not have.
    """
    if model.denoiser.layers != len(LAYERS):
        raise ValueError(
            f"a model with hfsq.layers {model.denoiser.layers} cannot be exported: the page steers two layers, "
            f"{' and '.join(LAYERS)}; train one with hfsq.layers {len(LAYERS)}"
        )
    if model.diffusion.stitching:
        raise ValueError(
            "a model with diffusion.stitching cannot be exported: the page samples blocks side by side, without "
            "overlap (docs/paper.md says why)"
        )
    if any(model.diffusion.extrapolation):
        raise ValueError(
            "a model with diffusion.extrapolation cannot be exported: the page does not extrapolate predictions; "
            "export its student (training.distill)"
        )
    folder.mkdir(parents=True, exist_ok=True)
    model = round_convolutions(model)
    entries = {graph.name: describe(graph, write_onnx(graph, folder)) for graph in graphs(model)}
    write_golden(folder / GOLDEN, reference(model, scene))
    text = json.dumps(manifest(model, card, entries, describe_file(folder / GOLDEN)), indent=1)
    (folder / "manifest.json").write_text(text + "\n")


def silence_libraries() -> None:
    """Hides what torch and onnxruntime warn of while they write graphs: operators of torchvision, which is not
    installed, names of axes that are not used, and a step before quantisation that is not taken.
    """
    logging.getLogger("torch.onnx").setLevel(logging.ERROR)
    logging.getLogger().setLevel(logging.ERROR)
    warnings.filterwarnings("ignore", message="# The axis name")


def main(options: Options) -> None:
    silence_libraries()
    model = load_model(options.checkpoint)
    with naming(options.checkpoint / "card.json"):
        card = make_card(read_card(options.checkpoint))
    write_model(model, card, options.out, Scene(frames=480, silent_from=400))
    results = verify(model, options.out, BLOCKS, print_now).values()
    worst = {name: max(row[name] for row in results) for name in ("reactor", "int8", "rounding")}
    size = sum(path.stat().st_size for path in options.out.glob("*.onnx")) / 1e6
    print(
        f"{options.out}: {size:.1f} MB of graphs; joints at most {worst['reactor']:.1e} m from PyTorch, on average "
        f"{worst['int8']:.1e} m with 8-bit products and {worst['rounding']:.1e} m for rounded convolutions"
    )


if __name__ == "__main__":
    run_program(main, Options)
