"""Weights in 8 bits: what rounding keeps, and that storing loses nothing more."""

from __future__ import annotations

import numpy as np
import onnx
import onnxruntime as ort
import torch
from onnx import TensorProto, helper, numpy_helper

from export.tiny import tiny_model
from export.weights import round_convolutions, rounded, store_compactly, to_codes


def weights(*shape: int) -> np.ndarray:
    """Normal values whose size differs by slice of the first axis, one of them zero."""
    random = np.random.default_rng(0)
    sizes = np.exp(random.normal(size=(shape[0], *[1] * (len(shape) - 1))))
    sizes[1] = 0
    return (random.normal(size=shape) * sizes).astype(np.float32)


def run(proto: onnx.ModelProto, x: np.ndarray) -> list[np.ndarray]:
    return [np.asarray(y) for y in ort.InferenceSession(proto.SerializeToString()).run(None, {"x": x})]


def test_rounding_moves_no_weight_by_more_than_half_a_code() -> None:
    values = weights(24, 16, 3)
    error = np.abs(rounded(values) - values).max(axis=(1, 2))
    # Eleven bits of scale leave the largest weight up to 127 / 2048 of a code further off.
    assert (error <= 0.57 * np.abs(values).max(axis=(1, 2)) / 127).all()
    assert np.array_equal(rounded(rounded(values)), rounded(values))


def test_only_convolutions_at_the_latent_rate_are_rounded() -> None:
    model = tiny_model()
    changed = {
        name
        for module, after in ((model.denoiser, round_convolutions(model).denoiser),
                              (model.hfsq, round_convolutions(model).hfsq))
        for (name, old), (_, new) in zip(module.named_parameters(), after.named_parameters(), strict=True)
        if not torch.equal(old, new)
    }  # fmt: skip
    assert "condition.leader.blocks.0.first.weight" in changed
    assert "streams.0.decoder.layers.2.weight" in changed
    assert all(("condition" in name and "blocks" in name) or "decoder.layers." in name for name in changed)
    assert not any("patch" in name or "layers.5" in name or name.endswith("bias") for name in changed)


def test_stored_weights_are_the_same_numbers_in_fewer_bytes() -> None:
    """A product with three weights: rounded to 8 bits, of half precision, and of neither."""
    random = np.random.default_rng(1)
    given = {
        "int8": rounded(weights(64, 32)),
        "half": random.normal(size=(64, 32)).astype(np.float16).astype(np.float32),
        "single": random.normal(size=(64, 32)).astype(np.float32),
    }
    graph = helper.make_graph(
        [helper.make_node("MatMul", ["x", name], [f"y_{name}"]) for name in given],
        "products",
        [helper.make_tensor_value_info("x", TensorProto.FLOAT, [5, 64])],
        [helper.make_tensor_value_info(f"y_{name}", TensorProto.FLOAT, [5, 32]) for name in given],
        [numpy_helper.from_array(values, name) for name, values in given.items()],
    )
    proto = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 20)], ir_version=10)
    x = random.normal(size=(5, 64)).astype(np.float32)
    before = run(proto, x)
    store_compactly(proto)
    onnx.checker.check_model(proto)
    stored = {tensor.name: numpy_helper.to_array(tensor) for tensor in proto.graph.initializer}
    assert stored["int8_int8"].dtype == np.int8
    assert stored["half_half"].dtype == np.float16
    assert stored["single"].dtype == np.float32
    after = run(proto, x)
    for old, new in zip(before, after, strict=True):
        assert np.array_equal(old, new)


def test_every_product_of_code_and_scale_is_exact_in_single_precision() -> None:
    """Runtimes multiply in single precision or fuse the product: with a rounded one they would differ."""
    values = weights(24, 16, 3)
    codes, scale = to_codes(values, 0)
    exact = codes.astype(np.float64) * scale.astype(np.float64)
    assert np.array_equal((codes * scale).astype(np.float64), exact)
    assert np.abs(codes).max() == 127
