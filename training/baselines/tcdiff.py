"""After TCDiff (Dai et al. 2025): first the reactor's trajectory, then the body that dances along it.

A navigator predicts where the reactor's root is beside the leader's from leader and music, without noise. A diffusion
model on joint positions then denoises upper and lower body beside that trajectory, the true one while training. The
published model plans for groups and adapts steps to the trajectory's speed; here the trajectory joins every token.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn

from training.baselines.method import BaselineConfig, Known, Method, Window, motion_terms
from training.baselines.network import Diffusion, Trunk, block_inputs, token_error
from training.diffusion.blocks import Block, gather, overlapping, scatter
from training.hfsq.autoencoder import Autoencoder

NAVIGATOR_LAYERS = 1  # of the method's depth
TRAJECTORY_NOISE = 0.1  # standard deviations, while training: the navigator's are not exact either


class TcDiff(Method):
    def __init__(self, config: BaselineConfig, hfsq: Autoencoder) -> None:
        super().__init__(config, hfsq)
        self.place = hfsq.stream_latent  # channels of the last stream, the placement
        body, sizes = self.channels - self.place, (config.heads, config.block)
        self.context = nn.Linear(2 * config.width, config.width)
        self.navigator = Trunk(config.width, self.place, config.width, NAVIGATOR_LAYERS, *sizes)
        self.diffusion = Diffusion()
        self.network = Trunk(self.channels, body, config.width, config.depth - NAVIGATOR_LAYERS, *sizes)

    def navigate(self, memory: Tensor, valid: Tensor) -> Tensor:
        """The trajectory (N, L, placement channels)."""
        context = self.context(memory)
        return self.navigator(context, context, valid, valid.new_zeros(len(valid)))

    def predict(self, body: Tensor, place: Tensor, memory: Tensor, valid: Tensor, time: Tensor) -> Tensor:
        return self.network(torch.cat([body, place], dim=-1), self.context(memory), valid, time)

    def loss(self, known: Known, window: Window) -> dict[str, Tensor]:
        truth = window.latents[:, :, 0]
        body, place = truth[..., : -self.place], truth[..., -self.place :]
        path = token_error(place, self.navigate(known.memory, known.valid), known.valid)
        noisy, time, signal = self.diffusion.draw(body)
        near = place + TRAJECTORY_NOISE * torch.randn_like(place)
        predicted = self.predict(noisy, near, known.memory, known.valid, time)
        simple = token_error(body, predicted, known.valid)
        whole = torch.cat([predicted, place], dim=-1)[:, :, None]
        return {"trajectory": path, "simple": simple, **motion_terms(known, window, whole, signal)}

    def sample(self, known: Known, noise: torch.Generator) -> Tensor:
        memory, size = known.memory[0], self.config.block
        blocks = overlapping(len(memory), size)
        with torch.no_grad():
            path = scatter(self.navigate(*block_inputs([memory], blocks, size)), blocks, len(memory))

        def predict(x: Tensor, time: Tensor, blocks: list[Block]) -> Tensor:
            told, valid = block_inputs([memory], blocks, size)
            return self.predict(x, gather(path, blocks, size), told, valid, time)

        initial = torch.randn(len(memory), self.channels - self.place, generator=noise)
        body = self.diffusion.sample(predict, initial, blocks, size, self.config.steps)
        return torch.cat([body, path], dim=-1)[:, None]
