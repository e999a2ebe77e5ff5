"""Options and dances that the training of stage 1 refuses."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.support.duets import made_duet
from training.config import FrameConfig, HfsqConfig, MaskingConfig
from training.hfsq.windows import training_clips
from training.train_hfsq import Options


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"keep_latents": True}, "--keep-latents keeps those of a checkpoint"),
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
