"""Export a checkpoint to the folder that the page loads.

python -m export.write --checkpoint training/checkpoints/salsa --out web/public/models/salsa
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import tyro

from export.golden import Scene, reference
from export.golden import write as write_golden
from export.manifest import Card, manifest
from export.onnx_files import describe, graphs, write_onnx
from export.verify import BLOCKS, verify
from training.checkpoint import load_model, read_card
from training.diffusion.model import Model

GOLDEN = "golden.npz"


@dataclass(frozen=True)
class Options:
    checkpoint: Path
    """Folder with hfsq, denoiser and card.json."""
    out: Path
    """Folder of the exported model; files of an earlier export are replaced."""


def write_model(model: Model, card: Card, folder: Path, scene: Scene) -> None:
    """Graphs, golden tensors and manifest into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    entries = {graph.name: describe(graph, write_onnx(graph, folder)) for graph in graphs(model)}
    write_golden(folder / GOLDEN, reference(model, scene))
    text = json.dumps(manifest(model, card, entries, GOLDEN), indent=1)
    (folder / "manifest.json").write_text(text + "\n")


def main(options: Options) -> None:
    model = load_model(options.checkpoint)
    card = Card(**read_card(options.checkpoint))
    write_model(model, card, options.out, Scene(frames=480, steps=4, silent_from=400))
    worst = max(value for row in verify(model, options.out, BLOCKS).values() for value in row.values())
    size = sum(path.stat().st_size for path in options.out.glob("*.onnx")) / 1e6
    print(f"{options.out}: {size:.1f} MB of graphs, at most {worst:.1e} from PyTorch")


if __name__ == "__main__":
    main(tyro.cli(Options))
