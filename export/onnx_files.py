"""PyTorch modules to ONNX files, and their entries in the manifest."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import onnx
import torch
from onnx import numpy_helper
from torch import Tensor, nn
from torch.export import Dim

from export.graphs import Condition, Decode, Step
from training.config import STREAMS, STRIDE
from training.diffusion.model import Model
from training.motion.skeleton import JOINTS
from training.music.recipe import MUSIC_FEATURES

OPSET = 20


@dataclass(frozen=True)
class Graph:
    """A module with named example inputs; dimensions that are symbolic have a name instead of a number."""

    name: str
    module: nn.Module
    inputs: dict[str, tuple[int | str, ...]]
    outputs: dict[str, tuple[int | str, ...]]


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
            },
            {"x0": state},
        ),
        Graph(
            "decode",
            Decode(model),
            {
                "latents": ("latents", layers, channels),
                "leader": motion,
                "gains": (len(STREAMS), layers),
                "bones": (len(JOINTS),),
            },
            {"reactor": motion, "lengths": ("frames", len(JOINTS))},
        ),
    ]


def example(shape: tuple[int | str, ...], latents: int, blocks: int) -> Tensor:
    """Random tensor of a shape whose symbolic dimensions are given."""
    sizes = {"frames": STRIDE * latents, "latents": latents, "blocks": blocks}
    return torch.randn([sizes[s] if isinstance(s, str) else s for s in shape])


def write_onnx(graph: Graph, folder: Path) -> Path:
    """Export one graph: computed in single precision, weights inside the file."""
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
    for node in proto.graph.node:
        # Stack traces and module paths of the exporting machine do not belong into the file.
        node.ClearField("metadata_props")
        node.ClearField("doc_string")
    halve_weights(proto)
    path = folder / f"{graph.name}.onnx"
    onnx.save(proto, path)
    return path


def halve_weights(proto: onnx.ModelProto, smallest: int = 1024) -> None:
    """Store large weights in half precision where that loses nothing, each behind a cast back to single.

    Trained weights come from a half-precision checkpoint, so this is exact; runtimes fold the casts when they load.
    """
    casts: list[onnx.NodeProto] = []
    for weight in proto.graph.initializer:
        values = numpy_helper.to_array(weight)
        if values.dtype != np.float32 or values.size < smallest:
            continue
        half = values.astype(np.float16)
        if not np.array_equal(half.astype(np.float32), values):
            continue
        name = weight.name
        weight.CopyFrom(numpy_helper.from_array(half, f"{name}_half"))
        casts.append(
            onnx.helper.make_node("Cast", [f"{name}_half"], [name], f"{name}_cast", to=onnx.TensorProto.FLOAT)
        )
    for cast in reversed(casts):
        proto.graph.node.insert(0, cast)


def describe(graph: Graph, path: Path) -> dict[str, Any]:
    """The manifest's entry: shapes, and one file per backend with bytes and sha256."""
    data = path.read_bytes()
    file = {"path": path.name, "bytes": len(data), "sha256": hashlib.sha256(data).hexdigest()}
    return {
        "inputs": {name: list(shape) for name, shape in graph.inputs.items()},
        "outputs": {name: list(shape) for name, shape in graph.outputs.items()},
        "files": {"wasm": file, "webgpu": dict(file)},
    }
