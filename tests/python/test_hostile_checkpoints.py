"""Damaged checkpoints are refused in a sentence that names the file."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import torch
from torch import nn

from tests.python.support.mutations import damaged_bytes, damaged_text, fuzz
from training.checkpoint import read_config, save_weights, start_from


def test_damaged_weights(tmp_path: Path) -> None:
    module = nn.Linear(4, 4)
    save_weights(tmp_path, "small", module, {})
    path = tmp_path / "small.safetensors"
    whole = path.read_bytes()
    refused = fuzz(
        lambda random: path.write_bytes(damaged_bytes(whole, random)),
        lambda: start_from(module, tmp_path, "small"),
        path,
        lambda _: all(bool(value.isfinite().all()) for value in module.parameters()),
    )
    assert refused > 0


def test_weights_that_are_not_finite(tmp_path: Path) -> None:
    module = nn.Linear(4, 4)
    with torch.no_grad():
        module.weight[1, 2] = torch.nan
    save_weights(tmp_path, "small", module, {})
    with pytest.raises(ValueError, match=r"small\.safetensors: the weights weight are not finite"):
        start_from(module, tmp_path, "small")


def test_damaged_config(tmp_path: Path) -> None:
    path = tmp_path / "card.json"
    text = json.dumps({"name": "small", "notes": ["a", "b"], "reference_height": 1.4}, indent=1)
    refused = fuzz(
        lambda random: path.write_text(damaged_text(text, random)),
        lambda: read_config(tmp_path, "card"),
        path,
        lambda config: isinstance(config, dict),
    )
    assert refused > 0
