"""Configurations of the method beside the shipped one: each trains, samples, and is exported as PyTorch computes it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import onnxruntime
import pytest
import torch

from export import tiny
from export.onnx_files import Graph, example, graphs, to_proto
from export.write import write_model
from tests.python.support.small_training import DENOISER, HFSQ, stage1, stage2, write_duets
from training import train_denoiser, train_hfsq
from training.checkpoint import load_model
from training.config import (
    ConditionConfig,
    DenoiserConfig,
    DenoiserLossConfig,
    DiffusionConfig,
    HfsqConfig,
)
from training.data.made import made_dancer
from training.diffusion.model import Model
from training.diffusion.react import Request, react

SCALES, WEIGHTS = (1.0, 0.25, 0.0625, 0.015625), (1.0, 0.5, 0.25, 0.125)


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_duets(tmp_path_factory.mktemp("data"))


def layers(count: int, **changes: object) -> HfsqConfig:
    """Stage 1 with so many residual layers."""
    return replace(HFSQ, **{"layers": count, "scales": SCALES[:count], **changes})


def without(condition: str) -> DenoiserConfig:
    return replace(DENOISER, condition=replace(ConditionConfig(depth=1), **{condition: False}))


# The last column: the graphs that this configuration changes and no one before it had.
@pytest.mark.parametrize(
    ("hfsq", "denoiser", "stride", "exported"),
    [
        pytest.param(
            layers(1, quantiser="kl", masking=None), without("music"), 4,
            ("step", "decode"), id="1-layer-kl-no-music",
        ),
        pytest.param(
            replace(HFSQ, quantiser="rvq", codebook=16),
            replace(DENOISER, mask="bidirectional", positions="sinusoidal"), 8,
            ("step", "decode"), id="2-layers-rvq-bidirectional-sinusoidal-stride-8",
        ),
        pytest.param(
            layers(3, masking=None), without("leader"), 4, ("condition",), id="3-layers-no-masking-no-leader"
        ),
        pytest.param(layers(4), DENOISER, 64, ("step", "decode"), id="4-layers-stride-64"),
    ],
)  # fmt: skip
def test_a_configuration_trains_samples_and_is_exported(
    hfsq: HfsqConfig,
    denoiser: DenoiserConfig,
    stride: int,
    exported: tuple[str, ...],
    data: Path,
    tmp_path: Path,
) -> None:
    denoiser = replace(denoiser, depths=(1,) * hfsq.layers)
    train_hfsq.main(stage1(data, tmp_path, hfsq=hfsq))
    loss = DenoiserLossConfig(layers=WEIGHTS[: hfsq.layers], windows=2)
    train_denoiser.main(stage2(data, tmp_path, denoiser=denoiser, loss=loss, stride=stride))
    model = load_model(tmp_path)
    assert (model.hfsq.config, model.denoiser.config) == (hfsq, denoiser)
    for parameter in model.denoiser.parameters():
        torch.nn.init.normal_(parameter, std=0.1)  # two steps leave the network's output at almost nothing
    assert_dances(model)
    for graph in graphs(model):
        if graph.name in exported:
            assert_exported(graph)
    if hfsq.layers != 2:
        with pytest.raises(ValueError, match=r"layers \d cannot be exported: the page steers two layers"):
            write_model(model, tiny.CARD, tmp_path / "model", tiny.SCENE)


def assert_exported(graph: Graph) -> None:
    """onnxruntime computes what PyTorch does."""
    given = {name: example(shape, latents=90, blocks=2) for name, shape in graph.inputs.items()}
    if "leader" in given:
        given["leader"] = torch.from_numpy(made_dancer(360, 5))
    if "role" in given:
        given["role"] = torch.ones(1)
    if "valid" in given:
        given["valid"] = torch.ones(2, 60)
        given["valid"][1, 40:] = 0
    session = onnxruntime.InferenceSession(to_proto(graph).SerializeToString())
    made = session.run(None, {name: value.numpy() for name, value in given.items()})
    with torch.no_grad():
        expected = graph.module(**given)
    for a, b in zip(made, expected if isinstance(expected, tuple) else (expected,), strict=True):
        assert np.allclose(np.asarray(a), b.numpy(), atol=1e-4), graph.name


def assert_dances(model: Model) -> None:
    leader = made_dancer(700, 4)
    made, other = (react(model, Request(leader, np.ones((500, 54)), seed)) for seed in (0, 1))
    assert made.shape == leader.shape
    assert np.isfinite(made).all()
    assert not np.allclose(made, other)


def test_a_model_with_stitching_trains_and_samples_and_export_says_why_it_is_refused(
    data: Path, tmp_path: Path
) -> None:
    train_hfsq.main(stage1(data, tmp_path))
    train_denoiser.main(stage2(data, tmp_path, diffusion=DiffusionConfig(steps=2, stitching=True)))
    model = load_model(tmp_path)
    assert model.sampling.stitching
    assert_dances(model)
    with pytest.raises(ValueError, match=r"stitching cannot be exported: the page samples blocks side by"):
        write_model(model, tiny.CARD, tmp_path / "model", tiny.SCENE)
    assert not (tmp_path / "model").exists()


def test_a_model_whose_predictions_are_extrapolated_dances_and_export_says_why_it_is_refused(
    tmp_path: Path,
) -> None:
    plain = tiny.tiny_model()
    model = replace(plain, diffusion=replace(plain.diffusion, extrapolation=(0.5, 0.0, 0.0)))
    assert_dances(model)
    with pytest.raises(ValueError, match=r"extrapolation cannot be exported: .*export its student"):
        write_model(model, tiny.CARD, tmp_path / "model", tiny.SCENE)
    assert not (tmp_path / "model").exists()
