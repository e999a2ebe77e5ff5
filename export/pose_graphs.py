"""Convert the networks of MediaPipe Pose from TensorFlow Lite to the ONNX graphs that the page reads videos with.

The networks lie in the npm package @mediapipe/pose (Apache-2.0). Run in an environment of its own, since nothing else
needs the package tflite:

    npm pack @mediapipe/pose@0.5.1675469404 && tar xzf mediapipe-pose-*.tgz
    pip install numpy onnx onnxruntime tflite tyro
    python -m export.pose_graphs --package package --out web/public/models/pose

Graphs take images as (1, 3, size, size) in RGB; the operators are few, so each has its own small function here.
Weights stay in half precision, as the package has them.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import onnx
import tflite  # pyright: ignore[reportMissingImports]
import tyro
from onnx import TensorProto, helper, numpy_helper

ACTIVATIONS = {1: "Relu", 3: "Relu6"}
SAME_PADDING = 0
CHANNELS_FIRST = [0, 3, 1, 2]
CHANNELS_LAST = [0, 2, 3, 1]

# The graphs of the page: the file in the package, and the network's outputs by their names here.
GRAPHS = {
    "detector": ("pose_solution_packed_assets.data", {"Identity": "boxes", "Identity_1": "scores"}),
    "landmarks": (
        "pose_landmark_full.tflite",
        {"Identity": "landmarks", "Identity_1": "presence", "Identity_4": "world"},
    ),
}


@dataclass(frozen=True)
class Options:
    package: Path
    """Folder of the unpacked npm package."""
    out: Path
    """Folder of the graphs and of their list, pose.json."""


class Conversion:
    """One network on its way: nodes and initialisers so far, and the ONNX name of every tensor."""

    def __init__(self, content: bytes) -> None:
        self.model: Any = tflite.Model.GetRootAs(content, 0)
        self.graph: Any = self.model.Subgraphs(0)
        self.nodes: list[onnx.NodeProto] = []
        self.initialisers: list[onnx.TensorProto] = []
        self.constants: dict[int, np.ndarray] = {}

    def shape(self, tensor: int) -> list[int]:
        return [int(n) for n in self.graph.Tensors(tensor).ShapeAsNumpy()]

    def name(self, tensor: int) -> str:
        return f"t{tensor}"

    def constant(self, tensor: int) -> np.ndarray:
        """A constant of the network: its own values, or those that DEQUANTIZE and DENSIFY have made of one."""
        if tensor in self.constants:
            return self.constants[tensor]
        entry = self.graph.Tensors(tensor)
        dtype = {0: np.float32, 1: np.float16, 2: np.int32}[entry.Type()]
        values = np.frombuffer(self.model.Buffers(entry.Buffer()).DataAsNumpy().tobytes(), dtype)
        sparsity = entry.Sparsity()
        return (
            values.reshape(self.shape(tensor))
            if sparsity is None
            else dense(values, sparsity, self.shape(tensor))
        )

    def add(self, kind: str, inputs: list[str], output: str, **attributes: Any) -> str:
        self.nodes.append(helper.make_node(kind, inputs, [output], **attributes))
        return output

    def store(self, name: str, values: np.ndarray) -> str:
        self.initialisers.append(numpy_helper.from_array(np.ascontiguousarray(values), name))
        return name

    def weights(self, name: str, values: np.ndarray) -> str:
        """Half precision in the file; onnxruntime widens it once, when it opens the graph."""
        self.store(f"{name}_half", values.astype(np.float16))
        return self.add("Cast", [f"{name}_half"], name, to=TensorProto.FLOAT)

    def activate(self, kind: int, output: str, make: Callable[[str], str]) -> None:
        """Makes `output` with the activation that TensorFlow Lite fuses into the operator before it."""
        if kind == 0:
            make(output)
            return
        before = make(f"{output}_linear")
        if ACTIVATIONS[kind] == "Relu":
            self.add("Relu", [before], output)
        else:
            self.add("Clip", [before, "zero", "six"], output)


def dense(values: np.ndarray, sparsity: Any, shape: list[int]) -> np.ndarray:
    """A sparse tensor of TensorFlow Lite as an array: levels of dense or compressed (CSR) dimensions, then blocks."""
    order = list(sparsity.TraversalOrderAsNumpy())
    blocked = [] if sparsity.BlockMapLength() == 0 else list(sparsity.BlockMapAsNumpy())
    levels = [sparsity.DimMetadata(i) for i in range(sparsity.DimMetadataLength())]

    def vector(level: Any, which: str) -> np.ndarray:
        kind = getattr(level, f"Array{which}Type")()
        reader = {1: tflite.Int32Vector, 2: tflite.Uint16Vector, 3: tflite.Uint8Vector}[kind]()
        table = getattr(level, f"Array{which}")()
        reader.Init(table.Bytes, table.Pos)
        return reader.ValuesAsNumpy().astype(np.int64)

    block = {len(shape) + i: levels[order.index(len(shape) + i)].DenseSize() for i in range(len(blocked))}
    result = np.zeros(shape, values.dtype)
    sequence = iter(values)

    def visit(level: int, parent: int, at: dict[int, int]) -> None:
        if level == len(levels):
            index = list(at[dim] for dim in range(len(shape)))
            for i, dim in enumerate(blocked):
                index[dim] = index[dim] * block[len(shape) + i] + at[len(shape) + i]
            result[tuple(index)] = next(sequence)
            return
        meta = levels[level]
        if meta.Format() == 0:
            size = meta.DenseSize()
            for i in range(size):
                visit(level + 1, parent * size + i, {**at, order[level]: i})
        else:
            segments, indices = vector(meta, "Segments"), vector(meta, "Indices")
            for i in range(segments[parent], segments[parent + 1]):
                visit(level + 1, i, {**at, order[level]: int(indices[i])})

    visit(0, 0, {})
    return result


def same_pads(size: list[int], kernel: list[int], strides: list[int]) -> list[int]:
    """Padding as TensorFlow's SAME has it: the odd one at the end."""
    total = [max(0, (-(-n // s) - 1) * s + k - n) for n, k, s in zip(size, kernel, strides, strict=True)]
    return [n // 2 for n in total] + [n - n // 2 for n in total]


def window(c: Conversion, source: int, kernel: list[int], options: Any) -> dict[str, list[int]]:
    strides = [options.StrideH(), options.StrideW()]
    same = options.Padding() == SAME_PADDING
    pads = same_pads(c.shape(source)[1:3], kernel, strides) if same else [0, 0, 0, 0]
    return {"kernel_shape": kernel, "strides": strides, "pads": pads}


def convolution(c: Conversion, inputs: list[int], output: int, options: Any, depthwise: bool) -> None:
    source, kernel, bias = inputs
    weights = c.constant(kernel).astype(np.float32)
    # (out, height, width, in), and (1, height, width, out) of a depthwise one.
    weights = weights.transpose(3, 0, 1, 2) if depthwise else weights.transpose(0, 3, 1, 2)
    name = c.name(output)
    arguments = [c.name(source), c.weights(f"{name}_w", weights), c.weights(f"{name}_b", c.constant(bias))]
    group = weights.shape[0] if depthwise else 1
    attributes = {**window(c, source, list(weights.shape[2:]), options), "group": group}
    c.activate(options.FusedActivationFunction(), name, lambda to: c.add("Conv", arguments, to, **attributes))


def add(c: Conversion, inputs: list[int], output: int, options: Any) -> None:
    names = [c.name(tensor) for tensor in inputs]
    c.activate(options.FusedActivationFunction(), c.name(output), lambda to: c.add("Add", names, to))


def pad(c: Conversion, inputs: list[int], output: int) -> None:
    before, after = c.constant(inputs[1])[CHANNELS_FIRST].T
    pads = c.store(f"{c.name(output)}_pads", np.concatenate([before, after]).astype(np.int64))
    c.add("Pad", [c.name(inputs[0]), pads], c.name(output))


def resize(c: Conversion, inputs: list[int], output: int, options: Any) -> None:
    height, width = c.shape(output)[1:3]
    sizes = c.store(f"{c.name(output)}_sizes", np.array([1, c.shape(output)[3], height, width], np.int64))
    centred = bool(options.HalfPixelCenters())
    c.add(
        "Resize",
        [c.name(inputs[0]), "", "", sizes],
        c.name(output),
        mode="linear",
        coordinate_transformation_mode="half_pixel" if centred else "asymmetric",
    )


def reshape(c: Conversion, inputs: list[int], output: int) -> None:
    name = c.name(output)
    source = c.name(inputs[0])
    if len(c.shape(inputs[0])) == 4:
        source = c.add("Transpose", [source], f"{name}_last", perm=CHANNELS_LAST)
    sizes = c.store(f"{name}_shape", np.array(c.shape(output), np.int64))
    c.add("Reshape", [source, sizes], name)


def convert_operator(c: Conversion, index: int) -> None:
    operator = c.graph.Operators(index)
    code = c.model.OperatorCodes(operator.OpcodeIndex())
    kind = NAMES[max(code.BuiltinCode(), code.DeprecatedBuiltinCode())]
    inputs = [int(tensor) for tensor in operator.InputsAsNumpy()]
    (output,) = (int(tensor) for tensor in operator.OutputsAsNumpy())

    def options(reader: Any) -> Any:
        table = operator.BuiltinOptions()
        reader.Init(table.Bytes, table.Pos)
        return reader

    match kind:
        case "DEQUANTIZE" | "DENSIFY":
            c.constants[output] = c.constant(inputs[0])
        case "CONV_2D":
            convolution(c, inputs, output, options(tflite.Conv2DOptions()), depthwise=False)
        case "DEPTHWISE_CONV_2D":
            convolution(c, inputs, output, options(tflite.DepthwiseConv2DOptions()), depthwise=True)
        case "ADD":
            add(c, inputs, output, options(tflite.AddOptions()))
        case "PAD":
            pad(c, inputs, output)
        case "RESIZE_BILINEAR":
            resize(c, inputs, output, options(tflite.ResizeBilinearOptions()))
        case "MAX_POOL_2D":
            pool = options(tflite.Pool2DOptions())
            attributes = window(c, inputs[0], [pool.FilterHeight(), pool.FilterWidth()], pool)
            c.add("MaxPool", [c.name(inputs[0])], c.name(output), **attributes)
        case "DEPTH_TO_SPACE":
            block = options(tflite.DepthToSpaceOptions()).BlockSize()
            c.add("DepthToSpace", [c.name(inputs[0])], c.name(output), blocksize=block, mode="DCR")
        case "RESHAPE":
            reshape(c, inputs, output)
        case "CONCATENATION":
            c.add("Concat", [c.name(tensor) for tensor in inputs], c.name(output), axis=1)
        case "LOGISTIC":
            c.add("Sigmoid", [c.name(inputs[0])], c.name(output))
        case _:
            raise ValueError(f"The network has an operator that is not converted: {kind}")


NAMES = {value: name for name, value in vars(tflite.BuiltinOperator).items() if isinstance(value, int)}


def needed(nodes: list[onnx.NodeProto], outputs: set[str]) -> list[onnx.NodeProto]:
    """The nodes that the outputs depend on, in order."""
    wanted, kept = set(outputs), []
    for node in reversed(nodes):
        if wanted & set(node.output):
            wanted |= set(node.input)
            kept.append(node)
    return kept[::-1]


def convert(content: bytes, outputs: dict[str, str]) -> onnx.ModelProto:
    """The network as an ONNX graph with one input `image` and the outputs that are named, others left out."""
    c = Conversion(content)
    c.store("zero", np.array(0, np.float32))
    c.store("six", np.array(6, np.float32))
    for index in range(c.graph.OperatorsLength()):
        convert_operator(c, index)
    source = int(c.graph.InputsAsNumpy()[0])
    _, height, width, channels = c.shape(source)
    results = []
    for tensor in map(int, c.graph.OutputsAsNumpy()):
        name = outputs.get(c.graph.Tensors(tensor).Name().decode())
        if name is not None:
            c.add("Identity", [c.name(tensor)], name)
            results.append(helper.make_tensor_value_info(name, TensorProto.FLOAT, c.shape(tensor)))
    nodes = needed(c.nodes, set(outputs.values()))
    for node in nodes:
        node.input[:] = ["image" if name == c.name(source) else name for name in node.input]
    used = {name for node in nodes for name in node.input}
    graph = helper.make_graph(
        nodes,
        "pose",
        [helper.make_tensor_value_info("image", TensorProto.FLOAT, [1, channels, height, width])],
        results,
        [tensor for tensor in c.initialisers if tensor.name in used],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=8)
    onnx.checker.check_model(model, full_check=True)
    return model


def main(options: Options) -> None:
    options.out.mkdir(parents=True, exist_ok=True)
    entries = {}
    for name, (source, outputs) in GRAPHS.items():
        content = convert((options.package / source).read_bytes(), outputs).SerializeToString()
        (options.out / f"{name}.onnx").write_bytes(content)
        digest = hashlib.sha256(content).hexdigest()
        entries[name] = {"path": f"{name}.onnx", "bytes": len(content), "sha256": digest}
        print(f"{name}: {len(content) / 1e6:.2f} MB")
    (options.out / "pose.json").write_text(json.dumps(entries, indent=1) + "\n")


if __name__ == "__main__":
    main(tyro.cli(Options))
