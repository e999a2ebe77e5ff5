"""Average the weights of denoisers that were tuned from one checkpoint (model soups, Wortsman et al. 2022).

    python -m training.checkpoints.average --checkpoints runs/a runs/b --out runs/average

Stage 1 and the card are those of the first checkpoint; of a card that --out has already only the measured numbers are
replaced. All must have been trained with the same stage 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import torch
from safetensors.torch import load_file

from training.checkpoint import (
    copy_card,
    copy_stage1,
    load_denoiser,
    load_hfsq,
    read_config,
    save_denoiser,
)
from training.command_line import run_program


@dataclass(frozen=True)
class Options:
    checkpoints: tuple[Path, ...]
    """Folders of checkpoints, two or more."""
    out: Path
    """Folder for the average."""


def main(options: Options) -> None:
    """Raises ValueError for fewer than two checkpoints, and for those of different models or stages 1."""
    first, *others = options.checkpoints
    if not others:
        raise ValueError("an average needs two checkpoints or more")
    configs = [read_config(folder, "denoiser") for folder in options.checkpoints]
    stage1 = (first / "hfsq.safetensors").read_bytes()
    for folder, config in zip(others, configs[1:], strict=True):
        is_same_network = _network(config) == _network(configs[0])
        if not is_same_network or (folder / "hfsq.safetensors").read_bytes() != stage1:
            raise ValueError(f"{folder} is of another model or another stage 1 than {first}")
    hfsq, _ = load_hfsq(first)
    denoiser, diffusion = load_denoiser(first, hfsq)
    weights = [load_file(str(folder / "denoiser.safetensors")) for folder in options.checkpoints]
    mean = {key: torch.stack([w[key].float() for w in weights]).mean(0) for key in weights[0]}
    denoiser.load_state_dict({key: value.to(denoiser.state_dict()[key].dtype) for key, value in mean.items()})
    provenance = {
        "program": "training.checkpoints.average",
        "checkpoints": [config["provenance"] for config in configs],
    }
    copy_stage1(first, options.out)
    copy_card(first, options.out)
    save_denoiser(options.out, hfsq, denoiser, diffusion, provenance)


def _network(config: dict[str, Any]) -> dict[str, Any]:
    """What a denoiser.json says of the network, without the shares that are dropped in training, in which tunings may
    differ.
    """
    denoiser = config["denoiser"]
    condition = {name: denoiser["condition"][name] for name in ("leader", "music", "depth")}
    return {name: value for name, value in denoiser.items() if name != "dropout"} | {"condition": condition}


if __name__ == "__main__":
    run_program(main, Options)
