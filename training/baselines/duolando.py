"""After Duolando (Siyao et al. 2024), without its reinforcement learning: a VQ-VAE and an autoregressive transformer.

Upper body, lower body and placement each are one code of a learned codebook per token. A causal transformer reads the
codes so far and looks ahead at leader and music, and predicts the next three codes; they are drawn from its
probabilities one token after the other. The published model interleaves the codes in one sequence and tunes the
transformer by rewards afterwards.
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from training.baselines.method import BaselineConfig, Known, Method, Window
from training.baselines.network import Trunk
from training.config import STREAMS
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.quantisers import ResidualVectorQuantiser


class Duolando(Method):
    """codebooks: (S, K, C / S) normalised latents, one book for each stream."""

    codebooks: Tensor

    def __init__(self, config: BaselineConfig, hfsq: Autoencoder) -> None:
        super().__init__(config, hfsq)
        self.register_buffer("codebooks", normalised_codebooks(hfsq))
        self.codes = self.codebooks.shape[1]
        self.context = nn.Linear(2 * config.width, config.width)
        # One code more than there are: what comes before the first.
        self.embedding = nn.ModuleList(nn.Embedding(self.codes + 1, config.width) for _ in STREAMS)
        sizes = (config.width, config.depth, config.heads, config.block)
        self.network = Trunk(config.width, len(STREAMS) * self.codes, *sizes, causal=True)

    def indices(self, latents: Tensor) -> Tensor:
        """Codes (N, L, S) of latents (N, L, 1, C)."""
        parts = latents[:, :, 0].unflatten(-1, (len(STREAMS), -1))
        distances = [torch.cdist(parts[:, :, s], book[None]) for s, book in enumerate(self.codebooks)]
        return torch.stack([d.argmin(-1) for d in distances], dim=-1)

    def logits(self, before: Tensor, memory: Tensor, valid: Tensor) -> Tensor:
        """(N, L, S, K) of each token's codes, from the codes (N, L, S) of the token before each."""
        x = sum(embed(before[..., s]) for s, embed in enumerate(self.embedding))
        made = self.network(x, self.context(memory), valid, valid.new_zeros(len(valid)))
        return made.unflatten(-1, (len(STREAMS), self.codes))

    def loss(self, known: Known, window: Window) -> dict[str, Tensor]:
        codes = self.indices(window.latents)
        first = torch.full_like(codes[:, :1], self.codes)
        logits = self.logits(torch.cat([first, codes[:, :-1]], dim=1), known.memory, known.valid)
        errors = F.cross_entropy(logits.flatten(0, 2), codes.flatten(), reduction="none").view(codes.shape)
        weighted = errors.mean(-1) * known.valid
        return {"cross_entropy": weighted.sum() / known.valid.sum()}

    @torch.no_grad()
    def sample(self, known: Known, noise: torch.Generator) -> Tensor:
        """Token by token; the window has half a block of what is past and half of what is ahead."""
        length, size = known.memory.shape[1], self.config.block
        codes = torch.full((1, length + 1, len(STREAMS)), self.codes)
        for at in range(length):
            start = max(0, min(at - size // 2, length - size))
            rows = slice(start, min(start + size, length))
            before = codes[:, rows].clone()
            if start:  # a window begins as in training, without a past
                before[:, 0] = self.codes
            logits = self.logits(before, known.memory[:, rows], known.valid[:, rows])[0, at - start]
            codes[0, at + 1] = torch.multinomial(logits.softmax(-1), 1, generator=noise)[:, 0]
        chosen = [book[codes[0, 1:, s]] for s, book in enumerate(self.codebooks)]
        return torch.cat(chosen, dim=-1)[:, None]


def normalised_codebooks(hfsq: Autoencoder) -> Tensor:
    """(S, K, C / S): the codes of each stream's book as normalised latents.

    Raises ValueError for an autoencoder with another quantiser than one codebook a stream.
    """
    books = []
    parts = zip(*(v[0].split(hfsq.stream_latent) for v in (hfsq.latent_mean, hfsq.latent_std)), strict=True)
    for stream, (mean, std) in zip(hfsq.each, parts, strict=True):
        quantiser = stream.quantiser
        if not isinstance(quantiser, ResidualVectorQuantiser) or quantiser.groups * quantiser.layers != 1:
            raise ValueError(
                "this baseline needs a stage 1 with --hfsq.quantiser rvq, one layer and one group"
            )
        books.append((quantiser.codebooks[0][0] - mean) / std)
    return torch.stack(books).detach()
