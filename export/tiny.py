"""A tiny model with random weights: the same code path as the shipped one, small enough for every test.

python -m export.tiny --out tests/fixtures/tiny-model
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import torch

from export.golden import Scene
from export.manifest import Card
from export.write import write_model
from training.command_line import run_program
from training.config import ConditionConfig, DenoiserConfig, DiffusionConfig, FrameConfig, HfsqConfig
from training.data.made import made_dancer
from training.denoiser.denoiser import Denoiser
from training.diffusion.body import mean_bodies
from training.diffusion.model import Model
from training.hfsq.autoencoder import Autoencoder
from training.motion.rest_pose import rest_offsets

# Two full blocks and a half: 600 frames.
SCENE = Scene(frames=600, silent_from=420)
CARD = Card(
    id="tiny",
    name="Tiny random model",
    licence="MIT",
    data_licence="none: random weights",
    attribution="Made by the project for its tests.",
    notes=("Untrained. Its motion means nothing.",),
    reference_height=1.5,
    reactor_height=1.43,
    training_bodies={
        role: body.tolist()
        for role, body in mean_bodies([made_dancer(60, 1)], [made_dancer(60, 2)], 1.5).items()
    },
    unfamiliar_from=10.0,
)


@dataclass(frozen=True)
class Options:
    out: Path


def tiny_model(seed: int = 0) -> Model:
    """The architecture of the shipped model in miniature; weights that start at zero are drawn too, so that nothing
    in a graph goes untested."""
    torch.manual_seed(seed)
    hfsq = Autoencoder(HfsqConfig(groups=2, widths=(24, 24, 16), depth=2, refine_width=16))
    config = DenoiserConfig(width=32, depths=(2, 1), mlp=2, condition=ConditionConfig(depth=1))
    denoiser = Denoiser(hfsq.latent_width, hfsq.layers, config)
    for module in (hfsq, denoiser):
        for parameter in module.parameters():
            if parameter.abs().max() == 0:
                torch.nn.init.normal_(parameter, std=0.1)
            parameter.data = parameter.data.half().float()  # as a checkpoint keeps them
    hfsq.latent_mean.normal_(std=0.1)
    hfsq.latent_std.uniform_(0.3, 0.6)
    for stream, place in zip(hfsq.each, (0.2, -0.4, 0.9), strict=True):
        stream.mean.fill_(place)
        stream.std.fill_(0.2)
    denoiser.lowest, denoiser.highest = hfsq.latent_range()
    body = torch.from_numpy(rest_offsets(made_dancer(60, seed=1)))
    denoiser.bodies.copy_(torch.stack([body, 1.1 * body]))
    diffusion = DiffusionConfig(
        steps=4,
        last_time=0.25,
        music_guidance=1.0,
        foot_contact=0.5,
    )
    return Model(hfsq.eval(), FrameConfig(), denoiser.eval(), diffusion, CARD.reference_height)


def main(options: Options) -> None:
    write_model(tiny_model(), CARD, options.out, SCENE)
    print(f"wrote {options.out}")


if __name__ == "__main__":
    run_program(main, Options)
