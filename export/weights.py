"""Weights in fewer bits. Rounding is done in PyTorch, so that the reference has it too; storing then loses nothing."""

from __future__ import annotations

import copy
import re

import numpy as np
import onnx
import torch
from onnx import numpy_helper

from training.diffusion.model import Model

ROUNDED = re.compile(r"condition\.\w+\.blocks\..*weight|decoder\.layers\.[012]\..*weight")
"""The convolutions at the latent rate: nine tenths of both graphs' bytes, a third of what rounding all would cost."""

LARGEST_CODE = 127
SMALLEST = 1024  # values; smaller tensors are stored as they are


def to_codes(values: np.ndarray, axis: int) -> tuple[np.ndarray, np.ndarray]:
    """int8 codes of float32 values and their scale, one along `axis`, of shape (1, .., n, .., 1).

    The scale has eleven significant bits, so that the product with a code is exact in single precision, and the
    largest value has the largest code, so that codes and scale are found again from the product.
    """
    others = tuple(i for i in range(values.ndim) if i != axis)
    largest = np.abs(values).max(axis=others, keepdims=True)
    scale = np.where(largest == 0, 1, largest / LARGEST_CODE).astype(np.float32)
    scale = (scale.view(np.int32) & ~0x1FFF).view(np.float32)
    codes = np.rint(values / scale).clip(-LARGEST_CODE, LARGEST_CODE)
    return codes.astype(np.int8), scale


def rounded(values: np.ndarray) -> np.ndarray:
    """The nearest float32 values that int8 codes with one scale along some axis can give."""
    candidates = [codes * scale for codes, scale in (to_codes(values, axis) for axis in range(values.ndim))]
    return min(candidates, key=lambda candidate: float(np.square(candidate - values).sum()))


def round_convolutions(model: Model) -> Model:
    """A copy whose large convolutions are rounded to 8 bits: the model that is exported."""
    model = copy.deepcopy(model)
    for module in (model.denoiser, model.hfsq):
        for name, parameter in module.named_parameters():
            if ROUNDED.search(name):
                parameter.data = torch.from_numpy(rounded(parameter.detach().numpy()))
    return model


def store_compactly(proto: onnx.ModelProto) -> None:
    """Store each large weight in int8 or half precision where that loses nothing, behind a cast back to single.

    Trained weights come from a half-precision checkpoint, some are rounded further; runtimes fold casts as they load.
    """
    graph, nodes = proto.graph, list[onnx.NodeProto]()
    for weight in list(graph.initializer):
        values = numpy_helper.to_array(weight)
        if values.dtype != np.float32 or values.size < SMALLEST:
            continue
        name = weight.name
        packed = in_int8(values)
        if packed is not None:
            codes, scale = packed
            weight.CopyFrom(numpy_helper.from_array(codes, f"{name}_int8"))
            graph.initializer.append(numpy_helper.from_array(scale, f"{name}_scale"))
            nodes.append(cast(f"{name}_int8", f"{name}_codes"))
            nodes.append(
                onnx.helper.make_node("Mul", [f"{name}_codes", f"{name}_scale"], [name], f"{name}_scaled")
            )
        elif np.array_equal(half := values.astype(np.float16), values):
            weight.CopyFrom(numpy_helper.from_array(half, f"{name}_half"))
            nodes.append(cast(f"{name}_half", name))
    for node in reversed(nodes):
        graph.node.insert(0, node)


def cast(source: str, target: str) -> onnx.NodeProto:
    return onnx.helper.make_node("Cast", [source], [target], f"{target}_cast", to=onnx.TensorProto.FLOAT)


def in_int8(values: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Codes and scale whose product is exactly these values, None where there are none."""
    if values.ndim < 2:
        return None
    for axis in range(values.ndim):
        codes, scale = to_codes(values, axis)
        if np.array_equal(codes * scale, values):
            return codes, scale
    return None
