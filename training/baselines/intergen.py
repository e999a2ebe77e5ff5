"""After InterGen (Liang et al. 2024): two networks denoise the two dancers together, each looking at the other.

Each dancer has a network of its own, since the roles differ; in every layer it attends to the hidden states of the
other's. The leader is given, so in half of the windows the leader's network gets clean tokens, as in sampling, and in
the other half noisy ones to denoise as the partner's. Losses: both dancers' tokens, the map of distances between their
joints where they are near, the angle between them. The condition encoder's tokens are added to both: leader and music
to the reactor's, music to the leader's. The published model has text and weights shared by both dancers.
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from training.baselines.method import BaselineConfig, Known, Method, Window, clean_rows, motion_terms
from training.baselines.network import Diffusion, Trunk, block_inputs, token_error
from training.denoiser.losses import orientation_loss
from training.diffusion.blocks import Block, partition
from training.diffusion.schedule import add_noise
from training.hfsq.autoencoder import Autoencoder

NEAR = 1.0  # metres, joints that are farther apart do not count in the map of distances
MAP_WEIGHT, ORIENTATION_WEIGHT, LEADER_WEIGHT = 0.5, 0.05, 0.25


class InterGen(Method):
    def __init__(self, config: BaselineConfig, hfsq: Autoencoder) -> None:
        super().__init__(config, hfsq)
        self.context = nn.Linear(2 * config.width, config.width)
        self.music = nn.Linear(config.width, config.width)
        self.diffusion = Diffusion()
        sizes = (config.width, config.depth // 2, config.heads, config.block)
        leader = 4 * len(self.condition.leader.mean)
        self.reactor_network = Trunk(self.channels, self.channels, *sizes)
        self.leader_network = Trunk(leader, leader, *sizes)

    def predict(
        self, reactor: Tensor, leader: Tensor, memory: Tensor, valid: Tensor, times: tuple[Tensor, Tensor]
    ) -> tuple[Tensor, Tensor]:
        """Clean tokens of both; times (N,) of the reactor's and of the leader's noise."""
        networks = (self.reactor_network, self.leader_network)
        a = self.reactor_network.enter(reactor) + self.context(memory)
        b = self.leader_network.enter(leader) + self.music(memory.chunk(2, dim=-1)[1])
        film_a, film_b = (F.silu(n.time(t)) for n, t in zip(networks, times, strict=True))
        masks = self.reactor_network.masks(valid)
        for mine, theirs in zip(self.reactor_network.layers, self.leader_network.layers, strict=True):
            a, b = mine(a, b, film_a, *masks), theirs(b, a, film_b, *masks)
        return self.reactor_network.leave(a), self.leader_network.leave(b)

    def loss(self, known: Known, window: Window) -> dict[str, Tensor]:
        truth, leader = window.latents[:, :, 0], known.leader
        noisy, time, signal = self.diffusion.draw(truth)
        given = (torch.rand(len(truth), device=truth.device) < 0.5).to(truth.dtype)
        hidden = add_noise(leader, torch.randn_like(leader), signal)
        seen = torch.lerp(hidden, leader, given[:, None, None])
        times = (time, time * (1 - given))
        made, partner = self.predict(noisy, seen, known.memory, known.valid, times)
        terms = {
            "simple": token_error(truth, made, known.valid),
            "leader": LEADER_WEIGHT * token_error(leader, partner, known.valid),
            **motion_terms(known, window, made[:, :, None], signal),
        }
        rows = clean_rows(known)
        if not rows:
            return terms
        couple = window.leader[rows], window.reactor[rows], window.motion(made[rows][:, :, None], rows)
        weights = signal[rows]
        terms["distances"] = MAP_WEIGHT * (distance_map_loss(*couple) * weights).mean()
        terms["orientation"] = ORIENTATION_WEIGHT * (orientation_loss(*couple) * weights).mean()
        return terms

    def sample(self, known: Known, noise: torch.Generator) -> Tensor:
        size, memory = self.config.block, known.memory[0]
        blocks = partition(len(memory), size)

        def predict(x: Tensor, time: Tensor, blocks: list[Block]) -> Tensor:
            leader, told, valid = block_inputs([known.leader[0], memory], blocks, size)
            return self.predict(x, leader, told, valid, (time, torch.zeros_like(time)))[0]

        initial = torch.randn(len(memory), self.channels, generator=noise)
        return self.diffusion.sample(predict, initial, blocks, size, self.config.steps)[:, None]


def distance_map_loss(leader: Tensor, truth: Tensor, predicted: Tensor) -> Tensor:
    """(N,) mean absolute error, metres, of the distances between each joint of one dancer and each of the other where
    they are truly nearer than `NEAR`. motions (N, T, 22, 3).
    """
    true, made = (torch.cdist(leader, motion) for motion in (truth, predicted))
    near = (true < NEAR).to(true.dtype)
    return ((true - made).abs() * near).sum((1, 2, 3)) / near.sum((1, 2, 3)).clamp_min(1)
