"""Damaged checkpoints are refused in a sentence that names the file."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import torch
from safetensors.torch import load_file, save_file
from torch import nn

from tests.python.support.bodies import TRAINING_BODIES
from tests.python.support.mutations import damaged_bytes, damaged_text, fuzz
from training.checkpoint import (
    copy_card,
    duets_seen,
    load_denoiser,
    read_card,
    read_config,
    save_denoiser,
    save_weights,
    solos_seen,
    start_from,
    write_card,
)
from training.config import DenoiserConfig, DiffusionConfig, HfsqConfig
from training.denoiser.denoiser import Denoiser
from training.hfsq.autoencoder import Autoencoder


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


def test_solos_of_every_training_that_a_checkpoint_comes_from_are_seen(tmp_path: Path) -> None:
    def write(hfsq: dict, denoiser: dict) -> None:
        for name, provenance in (("hfsq", hfsq), ("denoiser", denoiser)):
            (tmp_path / f"{name}.json").write_text(json.dumps({"provenance": provenance}))

    alone = {"options": {"solo": "None", "solo_prefixes": "('modern',)"}}
    write(alone, alone)
    assert solos_seen(tmp_path) == ()
    earlier = {"options": {"solo": "solo.npz", "solo_prefixes": "('modern', 'indian')"}}
    write({"options": alone, "before": earlier}, {"checkpoints": [alone, earlier]})
    assert solos_seen(tmp_path) == ("indian", "modern")
    write({"options": {"solo": "solo.npz"}}, alone)
    assert solos_seen(tmp_path) == ("",), "all of the archive"


def test_duets_that_a_training_did_not_hold_out_are_seen(tmp_path: Path) -> None:
    names = ("val", "test", "other")

    def seen(hfsq: dict, denoiser: dict) -> tuple[str, ...]:
        for name, provenance in (("hfsq", hfsq), ("denoiser", denoiser)):
            (tmp_path / f"{name}.json").write_text(json.dumps({"provenance": provenance}))
        return duets_seen(tmp_path, names)

    held_out = {"options": {"val": "('val',)", "test": "('test', 'other')", "learn_all": "False"}}
    assert seen(held_out, held_out) == ()
    assert seen(held_out, {"options": {"val": "('val',)", "test": "('test',)"}}) == ("other",)
    assert seen({"options": {"val": "('val',)", "test": "()"}}, held_out) == ("test", "other")
    everything = {"options": {"val": "('val',)", "test": "('test',)", "learn_all": "True"}}
    assert seen(held_out, held_out | {"before": {"checkpoints": [held_out, everything]}}) == names


def test_weights_of_a_denoiser_are_loaded_whole_or_not_at_all(tmp_path: Path) -> None:
    hfsq = Autoencoder(HfsqConfig(groups=2, widths=(8, 8, 8), depth=1, refine_width=8))
    config = DenoiserConfig(width=8, depths=(1, 1), mlp=1)
    save_denoiser(tmp_path, hfsq, Denoiser(hfsq.latent_width, 2, config), DiffusionConfig(), {})
    assert load_denoiser(tmp_path, hfsq)[0].config == config
    weights = load_file(tmp_path / "denoiser.safetensors")
    for changed in ({**weights, "stranger": torch.zeros(1)}, dict(list(weights.items())[1:])):
        save_file(changed, tmp_path / "denoiser.safetensors")
        with pytest.raises(ValueError, match=r"denoiser\.safetensors"):
            load_denoiser(tmp_path, hfsq)


def test_weights_of_a_wider_network_are_named_in_one_sentence(tmp_path: Path) -> None:
    save_weights(tmp_path, "small", nn.Linear(4, 4), {})
    with pytest.raises(
        ValueError, match=r"2 tensors differ, of which bias is \(4,\) there and \(8,\) here; .*small\.json"
    ):
        start_from(nn.Linear(4, 8), tmp_path, "small")


def test_a_card_keeps_what_a_person_wrote_and_takes_the_numbers_of_the_newest_training(
    tmp_path: Path,
) -> None:
    write_card(tmp_path / "a", 1.4, 1.3, TRAINING_BODIES, 1.1)
    path = tmp_path / "a" / "card.json"
    path.write_text(json.dumps(read_card(tmp_path / "a") | {"name": "Tango", "notes": ["one couple"]}))
    write_card(tmp_path / "a", 1.5, 1.25, {"leader": np.ones((22, 3))}, 1.2)
    numbers = {
        "reference_height": 1.5,
        "unfamiliar_from": 1.2,
        "reactor_height": 1.25,
        "training_bodies": {"leader": [[1.0] * 3] * 22},
    }
    card = read_card(tmp_path / "a")
    assert card["name"] == "Tango"
    assert card.items() >= numbers.items()
    write_card(tmp_path / "b", 1.0, 1.0, TRAINING_BODIES, 1.0)
    copy_card(tmp_path / "a", tmp_path / "b")
    assert read_card(tmp_path / "b").items() >= ({"name": "b"} | numbers).items()
    copy_card(tmp_path / "a", tmp_path / "c")
    assert read_card(tmp_path / "c") == card


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
