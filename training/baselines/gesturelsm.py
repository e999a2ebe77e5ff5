"""After GestureLSM (Liu et al. 2025): flow matching in a few steps on latents of a residual VQ-VAE.

A network predicts the velocity from noise to the sum of the residual codes, given the size of the step that is to be
taken (a shortcut model, Frans et al. 2024): a quarter of the windows learns that a large step equals two half ones. Its
layers attend over time within a body part and then over the body parts of a moment. A long dance is made window after
window, each begun with the last tokens of the one before. The published model makes gestures from speech.
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from training.baselines.method import BaselineConfig, Known, Method, Window
from training.baselines.network import Trunk, block_inputs
from training.config import STREAMS
from training.denoiser.transformer import Attention
from training.diffusion.blocks import Block
from training.hfsq.autoencoder import Autoencoder

STEPS = 4  # of sampling
SEED = 4  # tokens that a window takes over from the one before
CONSISTENT = 4  # one window in so many learns that a step equals two half ones


class GestureLsm(Method):
    """latent_std: (R, C) of the layers' latents."""

    latent_std: Tensor

    def __init__(self, config: BaselineConfig, hfsq: Autoencoder) -> None:
        super().__init__(config, hfsq)
        self.layers = hfsq.layers
        self.register_buffer("latent_std", hfsq.latent_std.clone())
        width, parts = config.width, len(STREAMS)
        self.part = self.channels // parts
        self.context = nn.Linear(2 * width, width)
        self.step = nn.Linear(1, width)
        depth = config.depth // 2
        self.network = Trunk(self.part + 1, self.part, width, depth, config.heads, config.block)
        self.name = nn.Parameter(torch.randn(parts, 1, width) * 0.02)
        self.norms = nn.ModuleList(nn.LayerNorm(width) for _ in range(depth))
        self.across = nn.ModuleList(Attention(width, config.heads) for _ in range(depth))

    def combined(self, latents: Tensor) -> Tensor:
        """Sum of the layers (N, L, C) of normalised latents (N, L, R, C), in standard deviations."""
        return (latents * self.latent_std).sum(2) / self._scale()

    def separate(self, combined: Tensor) -> Tensor:
        """Normalised latents (L, R, C) whose layers sum up to a combined latent (L, C): all of it in the base layer."""
        base = combined * self._scale() / self.latent_std[0]
        return torch.stack([base, *(torch.zeros_like(base) for _ in range(self.layers - 1))], dim=1)

    def _scale(self) -> Tensor:
        return self.latent_std.square().sum(0).sqrt()

    def velocity(self, x: Tensor, seeded: Tensor, known: Known, time: Tensor, step: Tensor) -> Tensor:
        """x (N, L, C); seeded (N, L) 1 where it is clean; time and step (N,) to (N, L, C)."""
        n, length, parts = len(x), x.shape[1], len(STREAMS)
        tokens = x.unflatten(-1, (parts, self.part)).transpose(1, 2)  # (N, S, L, part)
        marked = torch.cat([tokens, seeded[:, None, :, None].expand(-1, parts, -1, 1)], dim=-1)
        network, context = self.network, self.context(known.memory)[:, None]
        hidden = network.enter(marked.flatten(0, 1)).unflatten(0, (n, parts)) + context + self.name
        film = F.silu(network.time(time) + self.step(step[:, None])[:, None])
        film, context = (v.expand(n, parts, -1, -1).flatten(0, 1) for v in (film[:, None], context))
        masks = network.masks(known.valid.repeat_interleave(parts, dim=0))
        hidden = hidden.flatten(0, 1)
        for layer, norm, across in zip(network.layers, self.norms, self.across, strict=True):
            hidden = layer(hidden, context, film, *masks)
            moment = norm(hidden).unflatten(0, (n, parts)).transpose(1, 2).flatten(0, 1)  # (N L, S, D)
            mixed = across(moment, moment, moment.new_zeros(1)).unflatten(0, (n, length)).transpose(1, 2)
            hidden = hidden + mixed.flatten(0, 1)
        return network.leave(hidden).unflatten(0, (n, parts)).transpose(1, 2).flatten(2)

    def loss(self, known: Known, window: Window) -> dict[str, Tensor]:
        clean = self.combined(window.latents)
        n, device = len(clean), clean.device
        begun = (torch.rand(n, 1, device=device) < 0.5) & (torch.arange(clean.shape[1], device=device) < SEED)
        seeded = begun.to(clean.dtype)
        noise = torch.randn_like(clean)
        time = torch.rand(n, device=device)
        step = torch.zeros(n, device=device)
        count = n // CONSISTENT
        # Steps of 1/4, 1/2 and 1 begin where they end within [0, 1].
        size = 0.5 ** torch.randint(0, 3, (count,), device=device).float()
        step[:count] = size
        time[:count] = (torch.rand(count, device=device) * (1 / size)).floor() * size
        at = time[:, None, None]
        x = torch.lerp((1 - at) * noise + at * clean, clean, seeded[..., None])
        target = clean - noise
        if count:
            target = torch.cat([self._two_steps(x, seeded, known, time, size / 2), target[count:]])
        made = self.velocity(x, seeded, known, time, step)
        counted = known.valid * (1 - seeded)
        error = ((made - target).square().mean(-1) * counted).sum() / counted.sum()
        return {"velocity": error}

    @torch.no_grad()
    def _two_steps(self, x: Tensor, seeded: Tensor, known: Known, time: Tensor, half: Tensor) -> Tensor:
        """The mean velocity of two half steps of the first windows."""
        count = len(half)
        some = Known(*(v[:count] for v in known))
        told = torch.where(half <= 1 / 8, 0.0, half)  # the smallest step is the flow itself
        first = self.velocity(x[:count], seeded[:count], some, time[:count], told)
        moved = x[:count] + half[:, None, None] * first * (1 - seeded[:count])[..., None]
        second = self.velocity(moved, seeded[:count], some, time[:count] + half, told)
        return (first + second) / 2

    @torch.no_grad()
    def sample(self, known: Known, noise: torch.Generator) -> Tensor:
        length, size = known.memory.shape[1], self.config.block
        made = torch.zeros(length, self.channels)
        start = 0
        while start == 0 or start + SEED < length:
            block = Block(start, min(size, length - start))
            rows = slice(start, start + block.length)
            memory, leader, before, valid = block_inputs(
                [known.memory[0], known.leader[0], made], [block], size
            )
            seeded = torch.zeros(1, size)
            seeded[:, : SEED if start else 0] = 1
            x = torch.lerp(torch.randn(1, size, self.channels, generator=noise), before, seeded[..., None])
            for k in range(STEPS):
                time, step = torch.full((1,), k / STEPS), torch.full((1,), 1 / STEPS)
                flow = self.velocity(x, seeded, Known(memory, leader, valid), time, step)
                x = x + flow / STEPS * (1 - seeded)[..., None]
            made[rows] = x[0, : block.length]
            start += size - SEED
        return self.separate(made)
