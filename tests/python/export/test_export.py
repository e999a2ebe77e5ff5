"""Export: the committed tiny model is fresh, and onnxruntime agrees with PyTorch."""

from __future__ import annotations

import hashlib
import json
import shutil
from dataclasses import fields, replace
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import onnx
import pytest

from export import tiny
from export.golden import reference
from export.manifest import make_card, manifest
from export.runtime import Exported, open_model
from export.verify import tolerance, verify
from training.data.made import made_dancer
from training.denoiser.denoiser import Denoiser
from training.diffusion.model import Model
from training.diffusion.react import Request, react

FIXTURE = Path(__file__).parents[2] / "fixtures" / "tiny-model"
SHIPPED = Path(__file__).parents[3] / "web" / "public" / "models"


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("tiny")
    tiny.main(tiny.Options(out=out))
    return out


def of_file(path: Path) -> dict[str, Any]:
    """What the manifest says of a file."""
    data = path.read_bytes()
    return {"path": path.name, "bytes": len(data), "sha256": hashlib.sha256(data).hexdigest()}


def contents(path: Path) -> tuple[list[tuple[str, ...]], dict[str, np.ndarray]]:
    """The nodes of a graph in order, and its weights by name."""
    graph = onnx.load(path).graph
    nodes = [(node.op_type, *node.input, "->", *node.output) for node in graph.node]
    return nodes, {weight.name: onnx.numpy_helper.to_array(weight) for weight in graph.initializer}


def test_the_committed_tiny_model_is_what_the_exporter_writes_today(exported: Path) -> None:
    """Equal but for the last bits of random weights, which another processor may round another way."""
    hint = "export has changed: run python -m export.tiny --out tests/fixtures/tiny-model"
    fresh, committed = (json.loads((folder / "manifest.json").read_text()) for folder in (exported, FIXTURE))
    for folder, written in ((exported, fresh), (FIXTURE, committed)):
        written.pop("created")
        assert written.pop("golden") == of_file(folder / "golden.npz"), hint
        for graph in written["graphs"].values():
            for backend, file in graph["files"].items():
                assert file == of_file(folder / file["path"]), hint
                graph["files"][backend] = file["path"]
    assert fresh == committed, hint
    assert {path.name for path in exported.glob("*.onnx")} == {path.name for path in FIXTURE.glob("*.onnx")}
    for name in (path.name for path in exported.glob("*.onnx")):
        nodes, weights = contents(exported / name)
        committed_nodes, committed_weights = contents(FIXTURE / name)
        assert nodes == committed_nodes, hint
        assert weights.keys() == committed_weights.keys(), hint
        assert not any(
            node.metadata_props or node.doc_string for node in onnx.load(exported / name).graph.node
        ), "stack traces and paths of this machine are in the file"
        for key, values in weights.items():
            nearby = 1 if values.dtype.itemsize == 1 else 2e-3  # a code of 8 bits may be the next one
            assert np.allclose(values.astype(float), committed_weights[key], atol=nearby), f"{key}: {hint}"
    with np.load(exported / "golden.npz") as new, np.load(FIXTURE / "golden.npz") as old:
        assert new.files == old.files
        for name in new.files:
            assert np.allclose(new[name], old[name], atol=1e-2), f"{name}: {hint}"


def test_onnxruntime_agrees_with_pytorch() -> None:
    said: list[str] = []
    results = verify(tiny.tiny_model(), FIXTURE, (1, 2, 9, 75), said.append)
    assert list(results) == [1, 2, 9, 75]
    assert len(said) == 4, "each length is told, since the last one takes minutes"
    assert all(value <= tolerance(name) for row in results.values() for name, value in row.items())
    for row in results.values():
        assert min(row["int8"], row["rounding"]) > 1e-4 > row["distance"], "what 8 bits change is measured"


def test_verification_notices_other_weights() -> None:
    with pytest.raises(ValueError, match="differ from PyTorch"):
        verify(tiny.tiny_model(seed=1), FIXTURE, (1,))


def test_a_model_of_other_sizes_than_the_checkpoint_is_named() -> None:
    model = tiny.tiny_model()
    config = replace(model.denoiser.config, block=30)
    other = replace(model, denoiser=Denoiser(model.hfsq.latent_width, model.hfsq.layers, config))
    with pytest.raises(ValueError, match="another checkpoint: its manifest has block 60, the checkpoint 30"):
        verify(other, FIXTURE, (1,))


@pytest.mark.parametrize(
    ("file", "bias", "value"), [("step-int8.onnx", "0.output.bias", 3.0), ("decode.onnx", "bias", np.nan)]
)
def test_verification_notices_one_damaged_graph(tmp_path: Path, file: str, bias: str, value: float) -> None:
    """The products in 8 bits alone; and numbers that are none."""
    shutil.copytree(FIXTURE, tmp_path, dirs_exist_ok=True)
    proto = onnx.load(tmp_path / file)
    weight = next(each for each in proto.graph.initializer if each.name.endswith(bias))
    damaged = np.full_like(onnx.numpy_helper.to_array(weight), value)
    weight.CopyFrom(onnx.numpy_helper.from_array(damaged, weight.name))
    onnx.save(proto, tmp_path / file)
    with pytest.raises(ValueError, match="differ from PyTorch"):
        verify(tiny.tiny_model(), tmp_path, (1,))


def with_defaults(**changes: Any) -> Model:
    model = tiny.tiny_model()
    return replace(model, diffusion=replace(model.diffusion, **changes))


def test_an_exported_model_is_sampled_by_default_as_the_checkpoint_is() -> None:
    model = with_defaults(
        steps=3,
        last_time=0.5,
        guidance=(0.25, -0.5),
        music_guidance=2.0,
        variety=1.5,
        mean_seeds=3,
    )
    exported = Exported(manifest(model, tiny.CARD, {}, {}), {}).sampling
    for field in fields(exported):
        ours, theirs = getattr(exported, field.name), getattr(model.sampling, field.name)
        assert np.allclose(ours, theirs, rtol=1e-9), field.name


def test_a_default_that_its_control_does_not_reach_is_refused() -> None:
    with pytest.raises(ValueError, match="default 12 of the control music is not between 0 and 10"):
        manifest(with_defaults(music_guidance=12.0), tiny.CARD, {}, {})


def test_a_card_that_a_person_filled_in_wrongly_is_refused() -> None:
    good = {field.name: getattr(tiny.CARD, field.name) for field in fields(tiny.CARD)} | {"notes": ["one"]}
    assert make_card(good).notes == ("one",)
    for changes, sentence in (
        ({"notes": "one note"}, "a list of sentences"),
        ({"license": "MIT"}, r"unknown keys \['license'\]"),
    ):
        with pytest.raises(ValueError, match=sentence):
            make_card(good | changes)
    del good["licence"]
    with pytest.raises(ValueError, match=r"missing keys \['licence'\]"):
        make_card(good)


def test_the_height_of_the_reactors_is_in_the_manifest() -> None:
    known = manifest(tiny.tiny_model(), replace(tiny.CARD, reactor_height=1.26274), {}, {})["skeleton"]
    assert known["reactor_height"] == 1.2627


@pytest.mark.parametrize("file", ["step.onnx", "step-int8.onnx"])
def test_the_step_graph_has_no_shape_arithmetic(file: str) -> None:
    nodes = onnx.load(FIXTURE / file).graph.node
    kinds = {node.op_type for node in nodes}
    assert not kinds & {"Shape", "Where", "NonZero", "GatherND", "Loop", "If"}


def test_only_wasm_computes_in_8_bits_and_only_the_layers_products() -> None:
    files = json.loads((FIXTURE / "manifest.json").read_text())["graphs"]["step"]["files"]
    kinds = {
        backend: [node.op_type for node in onnx.load(FIXTURE / file["path"]).graph.node]
        for backend, file in files.items()
    }
    assert "MatMulInteger" not in kinds["webgpu"]
    layers = 3  # of both transformers, each with three products of self-attention, three of cross-attention, FiLM, MLP
    assert kinds["wasm"].count("MatMulInteger") == layers * (3 + 3 + 1 + 2)
    # What is left: logits and values of either attention; and conditions, latents in and out, and time.
    assert kinds["wasm"].count("MatMul") == layers * 4 + 2 * (2 + 2 + 2)


def test_every_golden_tensor_varies() -> None:
    """Every tensor varies, no branch is another, and a dance without the fine layer differs from the whole."""
    golden = reference(tiny.tiny_model(), tiny.SCENE)
    for name in ("memory", "silent", "initial", "branches", "latents", "reactor", "coarse_alone"):
        assert golden[name].std() > 1e-3, name
    for first, second in combinations([*golden["branches"], golden["latents"]], 2):
        assert np.abs(first - second).max() > 1e-2
    assert np.abs(golden["memory"] - golden["silent"]).max() > 1e-2
    assert np.abs(golden["reactor"] - golden["coarse_alone"]).max() > 1e-3


def test_react_takes_a_leader_of_any_length_and_no_music() -> None:
    model = open_model(FIXTURE, threads=1)
    leader = made_dancer(333, 4)
    made = react(model, Request(leader, None, 1))
    assert made.shape == leader.shape
    assert np.isfinite(made).all()
    louder = react(model, Request(leader, np.ones((100, 54)), 1))
    assert not np.allclose(made, louder)


@pytest.mark.parametrize(
    "folder", sorted(p.parent for p in SHIPPED.glob("*/manifest.json")), ids=lambda p: p.name
)
def test_shipped_graphs_are_those_of_the_committed_checkpoint(folder: Path) -> None:
    from training.checkpoint import load_model

    checkpoint = Path(__file__).parents[3] / "training" / "checkpoints" / folder.name
    results = verify(load_model(checkpoint), folder, (1, 2))
    assert all(value <= tolerance(name) for row in results.values() for name, value in row.items())
