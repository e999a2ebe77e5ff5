"""Stage 1: what its training refuses, and how it measures."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import torch

from tests.python.support.duets import made_duet
from tests.python.support.small_training import HFSQ
from training.config import FrameConfig, HfsqConfig, MaskingConfig
from training.evaluation.metrics import quick_report
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.reconstruct import reconstruct
from training.hfsq.windows import training_clips
from training.train_hfsq import Options, evaluate


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"decoders": ("upper",)}, "--decoders goes on with those of a checkpoint"),
        ({"window": 90}, "a window of 90 frames is not a multiple of 4"),
        ({"hfsq": HfsqConfig(quantiser="none")}, "training.evaluation.no_latent_baseline writes it"),
    ],
)
def test_options_that_are_wrong_or_would_be_ignored_are_refused(changes: dict, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        Options(data=Path("duets.npz"), out=Path("out"), val=("one",), **changes)


@pytest.mark.parametrize(
    ("config", "changes", "sentence"),
    [
        (HfsqConfig, {"levels": (8, 1)}, "--levels 1 is not at least 2"),
        (HfsqConfig, {"scales": (1.0, 0.0)}, "--scales 0 is not at least"),
        (MaskingConfig, {"residual": 1.5}, "--residual 1.5 is not between 0 and 1"),
        (MaskingConfig, {"cutoff": 20.0}, "--cutoff 20 Hz is not between 0 and 15"),
    ],
)
def test_values_outside_their_limits_are_refused(config: type, changes: dict, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        config(**changes)


def test_dances_that_are_all_shorter_than_a_window_are_refused() -> None:
    with pytest.raises(ValueError, match="no dance to train on has 240 frames"):
        training_clips([made_duet(120, 1)], [], (1.0,), FrameConfig(), None, 240)


def test_reconstructions_are_measured_of_all_layers_and_of_the_coarse_one_over_all_duets() -> None:
    torch.manual_seed(0)
    model, frame = Autoencoder(HFSQ).eval(), FrameConfig()
    duets = (made_duet(62, 1), made_duet(80, 2))  # the first ends in the middle of a latent frame
    report = evaluate(model, duets, frame)
    for name, layers in (("all", 2), ("coarse", 1)):
        for measure in ("mpjpe_mm", "root_error_mm", "speed_ratio"):
            each = [
                quick_report(duet.leader[:end], duet.reactor[:end], reconstruct(model, duet, frame, layers))
                for duet, end in zip(duets, (60, 80), strict=True)
            ]
            assert report[f"val/{name}/{measure}"] == pytest.approx(np.mean([row[measure] for row in each]))
    assert report["val/all/mpjpe_mm"] != report["val/coarse/mpjpe_mm"]
