"""Checkpoints: weights as safetensors beside their JSON config; loading is strict and rebuilds the module from it."""

from __future__ import annotations

import ast
import hashlib
import json
import shutil
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from safetensors import safe_open
from safetensors.torch import load_model as load_weights
from safetensors.torch import save_file
from torch import Tensor, nn

from training.config import (
    DenoiserConfig,
    DiffusionConfig,
    FrameConfig,
    HfsqConfig,
    from_json,
    to_json,
    write_json,
)
from training.data.naming import naming
from training.denoiser.denoiser import Denoiser
from training.diffusion.model import Model
from training.hfsq.autoencoder import Autoencoder


def save_weights(folder: Path, name: str, module: nn.Module, config: dict) -> None:
    """Write NAME.safetensors and NAME.json into `folder`.

    Weights are kept in half precision, which halves the checkpoint and, since it is what gets exported, the
    graphs; everything computes in single precision on those values. Statistics in buffers stay as they are.
    """
    folder.mkdir(parents=True, exist_ok=True)
    write_json(folder / f"{name}.json", config)
    save_file(_kept_state(module), str(folder / f"{name}.safetensors"))


def _kept_state(module: nn.Module) -> dict[str, Tensor]:
    """The weights as a checkpoint keeps them."""
    trained = {key for key, _ in module.named_parameters()}
    state = {key: value.half() if key in trained else value for key, value in module.state_dict().items()}
    return {key: value.contiguous() for key, value in state.items()}


def weights_digest(module: nn.Module, leave_out: str | None = None) -> str:
    """SHA-256 of the weights as a checkpoint keeps them, without those that have `leave_out` in their names."""
    digest = hashlib.sha256()
    for key, value in sorted(_kept_state(module).items()):
        if leave_out is None or leave_out not in key:
            digest.update(key.encode() + value.cpu().numpy().tobytes())
    return digest.hexdigest()


def latents_digest(hfsq: Autoencoder) -> str:
    """SHA-256 of what makes the latents of a stage 1: all of its weights but the decoders', which may be trained
    further beside a denoiser (`--decoders`).
    """
    return weights_digest(hfsq, leave_out=".decoder.")


def save_hfsq(folder: Path, model: Autoencoder, frame: FrameConfig, provenance: dict) -> None:
    """Writes stage 1. provenance: how it was trained."""
    config = {"hfsq": to_json(model.config), "frame": to_json(frame), "provenance": provenance}
    save_weights(folder, "hfsq", model, config)


def save_denoiser(
    folder: Path, hfsq: Autoencoder, model: Denoiser, diffusion: DiffusionConfig, provenance: dict
) -> None:
    """Writes stage 2. hfsq: the stage 1 whose latents it was trained on; provenance: how it was trained."""
    config = {
        "denoiser": to_json(model.config),
        "diffusion": to_json(diffusion),
        "latents": latents_digest(hfsq),
        "provenance": provenance,
    }
    save_weights(folder, "denoiser", model, config)


def read_config(folder: Path, name: str) -> dict:
    """NAME.json of a checkpoint. Raises FileNotFoundError, and ValueError where it is no JSON object."""
    path = folder / f"{name}.json"
    if not path.exists():
        raise FileNotFoundError(f"{path} is missing: train it first, or name another folder")
    with naming(path):
        config = json.loads(path.read_text())
        if not isinstance(config, dict):
            raise ValueError("it holds no JSON object")
        return config


def earlier_training(folder: Path | None, name: str) -> dict:
    """What the provenance of a training says of the checkpoint that it begins with, of NAME.json; nothing without."""
    return {} if folder is None else {"before": read_config(folder, name)["provenance"]}


UNBOUNDED = ("lowest", "highest")
"""The denoiser's range of latents, infinite where nothing quantises them."""


def solos_seen(folder: Path) -> tuple[str, ...]:
    """How the names of the solo dances begin that any training of a checkpoint saw, the earlier ones that it went on
    from included; ("",) for all of an archive, none without solos.
    """
    found: set[str] = set()
    for options in _options_of_trainings(folder):
        if options.get("solo") not in (None, "None"):
            found.update(ast.literal_eval(options.get("solo_prefixes", "('',)")))
    return tuple(sorted(found))


def duets_seen(folder: Path, names: Collection[str]) -> tuple[str, ...]:
    """Those of the names of duets that some training of a checkpoint did not hold out, the earlier ones that it went on
    from included: with --learn-all all of them, else those that neither its --val nor its --test names.
    """
    seen: set[str] = set()
    for options in _options_of_trainings(folder):
        if options.get("learn_all") == "True":
            seen.update(names)
        else:
            held_out = (ast.literal_eval(options.get(part, "()")) for part in ("val", "test"))
            seen.update(set(names).difference(*held_out))
    return tuple(name for name in names if name in seen)


def _options_of_trainings(folder: Path) -> Iterator[dict[str, str]]:
    """The options of every training of both stages of a checkpoint, as its provenance has them."""

    def visit(value: Any) -> Iterator[dict[str, str]]:
        if isinstance(value, list):
            for item in value:
                yield from visit(item)
        elif isinstance(value, dict):
            for key, item in value.items():
                if key == "options":
                    yield item
                else:
                    yield from visit(item)

    for name in ("hfsq", "denoiser"):
        yield from visit(read_config(folder, name)["provenance"])


def load_hfsq(folder: Path) -> tuple[Autoencoder, FrameConfig]:
    """The stage-1 model, frozen and in evaluation mode."""
    config = read_config(folder, "hfsq")
    with naming(folder / "hfsq.json"):
        model = Autoencoder(from_json(HfsqConfig, config["hfsq"]))
        frame = from_json(FrameConfig, config["frame"])
    start_from(model, folder, "hfsq")
    return model.eval().requires_grad_(False), frame


def start_from(module: nn.Module, folder: Path, name: str) -> None:
    """Loads NAME.safetensors of `folder` into a module.

    Raises FileNotFoundError, and ValueError where names or sizes differ or a weight is not finite.
    """
    path = folder / f"{name}.safetensors"
    if not path.exists():
        raise FileNotFoundError(f"{path} is missing: train it first, or name another folder")
    with naming(path):
        with safe_open(str(path), "pt") as file:
            there = {key: tuple(file.get_slice(key).get_shape()) for key in file.keys()}  # noqa: SIM118
        here = {key: tuple(value.shape) for key, value in module.state_dict().items()}
        if differ := sorted(key for key in there | here if there.get(key) != here.get(key)):
            key = differ[0]
            raise ValueError(
                f"its weights are of another network than was asked for: {len(differ)} tensors differ, of which "
                f"{key} is {there.get(key, 'missing')} there and {here.get(key, 'missing')} here; "
                f"{path.with_suffix('.json')} says how its network was made"
            )
        load_weights(module, str(path), strict=True)
        for key, value in module.state_dict().items():
            bad = value.isnan() if key in UNBOUNDED else ~value.isfinite()
            if bad.any():
                raise ValueError(f"the weights {key} are not finite")


def load_denoiser(folder: Path, hfsq: Autoencoder) -> tuple[Denoiser, DiffusionConfig]:
    """The stage-2 model in evaluation mode, not frozen. hfsq: stage 1 of the same checkpoint.

    Raises ValueError where the denoiser was trained on latents of another stage 1.
    """
    config = read_config(folder, "denoiser")
    with naming(folder / "denoiser.json"):
        latents = config["latents"]
        model = Denoiser(hfsq.latent_width, hfsq.layers, from_json(DenoiserConfig, config["denoiser"]))
        diffusion = from_json(DiffusionConfig, config["diffusion"])
    if latents != latents_digest(hfsq):
        raise ValueError(
            f"{folder / 'denoiser.safetensors'} was trained on another stage 1 than {folder / 'hfsq.safetensors'}, "
            "which was trained again since: train the denoiser again too, or put the earlier stage 1 back"
        )
    start_from(model, folder, "denoiser")
    return model.eval(), diffusion


def load_model(folder: Path) -> Model:
    """Both stages of a checkpoint, ready to sample."""
    hfsq, frame = load_hfsq(folder)
    denoiser, diffusion = load_denoiser(folder, hfsq)
    with naming(folder / "card.json"):
        height = float(read_card(folder)["reference_height"])
    return Model(hfsq, frame, denoiser.requires_grad_(False), diffusion, height)


def read_card(folder: Path) -> dict:
    """card.json: name, licence, attribution and notes of the model, which the manifest begins with."""
    return read_config(folder, "card")


def copy_stage1(source: Path, out: Path) -> None:
    """Copies stage 1 of a checkpoint into another folder, or leaves it where it is in the same."""
    if source.resolve() != out.resolve():
        out.mkdir(parents=True, exist_ok=True)
        for name in ("hfsq.json", "hfsq.safetensors"):
            shutil.copy(source / name, out / name)


MEASURED = ("reference_height", "reactor_height", "training_bodies", "unfamiliar_from")
"""Numbers of a card that come from the training; a person fills in the others."""


def copy_card(source: Path, out: Path) -> None:
    """Copies the card.json of a checkpoint, if any; of one that exists it replaces the measured numbers alone."""
    if (source / "card.json").exists():
        card = read_card(source)
        _update_card(out, card, {name: card[name] for name in MEASURED if name in card})


def write_card(
    folder: Path,
    reference_height: float,
    reactor_height: float,
    training_bodies: Mapping[str, np.ndarray],
    unfamiliar_from: float,
) -> None:
    """Writes a card.json to be filled in by hand; of one that exists it replaces the measured numbers alone.

    reference_height and reactor_height: metres, the mean `body_height` of the leaders it was trained on and of the
    reactors beside them. training_bodies: see `mean_bodies`. unfamiliar_from: mean `ConditionEncoder.unfamiliarity` of
    a leader from which the page says that the model does not know such a dance.
    """
    blank = {
        "id": folder.resolve().name,
        "name": folder.resolve().name,
        "licence": "not stated",
        "data_licence": "not stated",
        "attribution": "not stated",
        "notes": [],
    }
    measured = {
        "reference_height": round(reference_height, 4),
        "reactor_height": round(reactor_height, 4),
        "training_bodies": {role: np.round(body, 4).tolist() for role, body in training_bodies.items()},
        "unfamiliar_from": round(unfamiliar_from, 2),
    }
    _update_card(folder, blank, measured)


def _update_card(folder: Path, first: dict, measured: dict) -> None:
    """Writes the measured numbers into the card of a folder, or into the first one where there is none yet."""
    card = read_card(folder) if (folder / "card.json").exists() else first
    kept = {name: value for name, value in card.items() if name not in MEASURED}
    write_json(folder / "card.json", kept | measured)
