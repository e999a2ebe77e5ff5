"""After EDGE (Tseng et al. 2023): diffusion on joint positions; long dances are stitched of windows that overlap.

A transformer with attention in both directions denoises a window of joint positions, told leader and music by
cross-attention and the noise level by FiLM. Losses: positions, speeds and standing feet. A long dance is sampled as
windows half a window apart, whose predictions are cross-faded at every step, as EDGE holds overlapping halves equal.
The published model has rotations, its own features of music and guidance; here inputs are those of our denoiser.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn

from training.baselines.method import BaselineConfig, Known, Method, Window, motion_terms
from training.baselines.network import Diffusion, Trunk, block_inputs, token_error
from training.diffusion.blocks import Block, overlapping
from training.hfsq.autoencoder import Autoencoder


class Edge(Method):
    def __init__(self, config: BaselineConfig, hfsq: Autoencoder) -> None:
        super().__init__(config, hfsq)
        self.context = nn.Linear(2 * config.width, config.width)
        self.diffusion = Diffusion()
        self.network = Trunk(
            self.channels, self.channels, config.width, config.depth, config.heads, config.block
        )

    def predict(self, noisy: Tensor, memory: Tensor, valid: Tensor, time: Tensor) -> Tensor:
        return self.network(noisy, self.context(memory), valid, time)

    def loss(self, known: Known, window: Window) -> dict[str, Tensor]:
        truth = window.latents[:, :, 0]
        noisy, time, signal = self.diffusion.draw(truth)
        predicted = self.predict(noisy, known.memory, known.valid, time)
        simple = token_error(truth, predicted, known.valid)
        return {"simple": simple, **motion_terms(known, window, predicted[:, :, None], signal)}

    def sample(self, known: Known, noise: torch.Generator) -> Tensor:
        memory, size = known.memory[0], self.config.block

        def predict(x: Tensor, time: Tensor, blocks: list[Block]) -> Tensor:
            told, valid = block_inputs([memory], blocks, size)
            return self.predict(x, told, valid, time)

        initial = torch.randn(len(memory), self.channels, generator=noise)
        blocks = overlapping(len(memory), size)
        return self.diffusion.sample(predict, initial, blocks, size, self.config.steps)[:, None]
