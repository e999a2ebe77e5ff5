"""PyTorch modules to ONNX files, and their entries in the manifest."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import onnx
import torch
from torch import Tensor, nn
from torch.export import Dim

from export.graphs import Condition, Decode, Step
from export.int8 import layer_products, quantise
from export.weights import store_compactly
from training.config import STREAMS, STRIDE
from training.diffusion.model import Model
from training.motion.skeleton import JOINTS
from training.music.recipe import MUSIC_FEATURES

OPSET = 20

Backend = Literal["wasm", "webgpu"]
Files = dict[Backend, Path]
"""The file of a graph that each backend of the page loads."""


@dataclass(frozen=True)
class Graph:
    """A module with named example inputs; dimensions that are symbolic have a name instead of a number."""

    name: str
    module: nn.Module
    inputs: dict[str, tuple[int | str, ...]]
    outputs: dict[str, tuple[int | str, ...]]
    int8: bool = False
    """Whether wasm computes it in 8 bits."""


def graphs(model: Model) -> list[Graph]:
    """Shapes: `frames` is a multiple of 4 and four times `latents`; `blocks` is any number from 1."""
    layers, channels = model.denoiser.layers, model.denoiser.latent_width
    block, memory = model.denoiser.config.block, model.denoiser.condition.memory_width
    motion = ("frames", len(JOINTS), 3)
    state = ("blocks", block, layers, channels)
    return [
        Graph(
            "condition",
            Condition(model),
            {"leader": motion, "music": ("frames", MUSIC_FEATURES), "music_valid": ("frames",), "role": (1,)},
            {"memory": ("latents", memory), "unfamiliarity": ("latents",)},
        ),
        Graph(
            "step",
            Step(model),
            {
                "x": state,
                "memory": ("blocks", block, memory),
                "valid": ("blocks", block),
                "keep": (1,),
                "time": (1,),
                "a": (1,),
                "b": (1,),
            },
            {"next": state},
            int8=True,
        ),
        Graph(
            "decode",
            Decode(model),
            {
                "latents": ("latents", layers, channels),
                "leader": motion,
                "gains": (len(STREAMS), layers),
                "role": (1,),
            },
            {"reactor": motion},
        ),
    ]


def example(shape: tuple[int | str, ...], latents: int, blocks: int) -> Tensor:
    """Random tensor of a shape whose symbolic dimensions are given."""
    sizes = {"frames": STRIDE * latents, "latents": latents, "blocks": blocks}
    return torch.randn([sizes[s] if isinstance(s, str) else s for s in shape])


def write_onnx(graph: Graph, folder: Path) -> Files:
    """Export one graph, weights inside the file: in single precision, and where that pays in 8 bits for wasm.

    8 bits are for wasm alone: there they pay, and several projects report wrong results of them on WebGPU.
    """
    proto = to_proto(graph)
    products = layer_products(proto) if graph.int8 else []
    for node in proto.graph.node:
        # Stack traces and module paths of the exporting machine do not belong into the file.
        node.ClearField("metadata_props")
        node.ClearField("doc_string")
    path = folder / f"{graph.name}.onnx"
    if not products:
        return {"wasm": save(proto, path), "webgpu": path}
    int8 = save(quantise(proto, products), folder / f"{graph.name}-int8.onnx")
    return {"wasm": int8, "webgpu": save(proto, path)}


def save(proto: onnx.ModelProto, path: Path) -> Path:
    store_compactly(proto)
    onnx.save(proto, path)
    return path


def to_proto(graph: Graph) -> onnx.ModelProto:
    """The graph in single precision, its nodes still with the exporter's metadata."""
    latents = Dim("latents", min=2, max=1 << 20)
    symbols: dict[str, Any] = {
        "latents": latents,
        "frames": STRIDE * latents,
        "blocks": Dim("blocks", min=1, max=4096),
    }
    dynamic = {
        name: {i: symbols[s] for i, s in enumerate(shape) if isinstance(s, str)}
        for name, shape in graph.inputs.items()
    }
    arguments = {name: example(shape, latents=64, blocks=3) for name, shape in graph.inputs.items()}
    program = torch.onnx.export(
        graph.module.eval(),
        kwargs=arguments,
        input_names=list(graph.inputs),
        output_names=list(graph.outputs),
        dynamic_shapes=dynamic,
        opset_version=OPSET,
        dynamo=True,
        verbose=False,
    )
    assert program is not None
    program.optimize()
    proto = program.model_proto
    del proto.graph.value_info[:]
    proto.metadata_props.clear()
    return proto


def describe(graph: Graph, files: Files) -> dict[str, Any]:
    """The manifest's entry: shapes, and one file per backend with bytes and sha256."""
    return {
        "inputs": {name: list(shape) for name, shape in graph.inputs.items()},
        "outputs": {name: list(shape) for name, shape in graph.outputs.items()},
        "files": {backend: describe_file(path) for backend, path in files.items()},
    }


def describe_file(path: Path) -> dict[str, Any]:
    """The manifest's entry of a file beside it, by which the page verifies and caches it."""
    data = path.read_bytes()
    return {"path": path.name, "bytes": len(data), "sha256": hashlib.sha256(data).hexdigest()}
