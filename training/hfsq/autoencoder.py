"""The stage-1 autoencoder: three structurally identical streams, each with its own HFSQ."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import torch
from torch import Tensor, nn

from training.config import HfsqConfig
from training.hfsq.convolutions import Decoder, Encoder, Patch, Unpatch
from training.hfsq.quantisers import make_quantiser
from training.motion.streams import STREAM_WIDTHS


class Stream(nn.Module):
    """One stream: encoder, quantiser, decoder, with the normalisation of its input."""

    mean: Tensor  # (c,) metres
    std: Tensor  # () metres

    def __init__(self, channels: int, width: int, config: HfsqConfig) -> None:
        super().__init__()
        self.quantiser = make_quantiser(config)
        latent = self.quantiser.width
        if config.quantiser == "none":
            self.encoder, self.decoder = Patch(latent), Unpatch(channels)
        else:
            self.encoder = Encoder(channels, width, config.depth, latent)
            self.decoder = Decoder(channels, width, config.depth, latent, config.refine_width)
        self.register_buffer("mean", torch.zeros(channels))
        self.register_buffer("std", torch.ones(()))

    def features(self, motion: Tensor) -> Tensor:
        """(N, T, c) metres to the encoder's v (N, L, width)."""
        return self.encoder(((motion - self.mean) / self.std).transpose(1, 2)).transpose(1, 2)

    def decode(self, v: Tensor) -> Tensor:
        """v hat (N, L, width) to metres (N, T, c)."""
        return self.decoder(v.transpose(1, 2)).transpose(1, 2) * self.std + self.mean


class Autoencoder(nn.Module):
    """Streams (N, T, 39), (N, T, 24), (N, T, 3) to latents (N, L, R, C) and back; C = 3 G d.

    `latent_mean` and `latent_std` (R, C) are the statistics of the training latents: diffusion works on
    (latents - mean) / std, since the raw standard deviations span an order of magnitude.
    """

    latent_mean: Tensor
    latent_std: Tensor

    def __init__(self, config: HfsqConfig) -> None:
        super().__init__()
        self.config = config
        self.streams = nn.ModuleList(
            Stream(channels, width, config)
            for channels, width in zip(STREAM_WIDTHS, config.widths, strict=True)
        )
        self.layers = config.layers
        self.stream_latent = self.each[0].quantiser.latent_width
        self.latent_width = len(STREAM_WIDTHS) * self.stream_latent
        self.register_buffer("latent_mean", torch.zeros(self.layers, self.latent_width))
        self.register_buffer("latent_std", torch.ones(self.layers, self.latent_width))

    @property
    def each(self) -> list[Stream]:
        """Upper, lower, placement."""
        return cast(list[Stream], list(self.streams))

    def encode(self, motions: Sequence[Tensor]) -> Tensor:
        """Dequantised codes (N, L, R, C) of streams in metres; T must be a multiple of 4."""
        codes = [s.quantiser(s.features(m)) for s, m in zip(self.each, motions, strict=True)]
        return torch.cat(codes, dim=-1)

    def decode(self, latents: Tensor) -> tuple[Tensor, ...]:
        """Latents (N, L, R, C) to the three streams in metres."""
        parts = latents.split(self.stream_latent, dim=-1)
        return tuple(s.decode(s.quantiser.combine(p)) for s, p in zip(self.each, parts, strict=True))

    def normalise(self, latents: Tensor) -> Tensor:
        return (latents - self.latent_mean) / self.latent_std

    def denormalise(self, latents: Tensor) -> Tensor:
        return latents * self.latent_std + self.latent_mean

    def latent_range(self) -> tuple[Tensor, Tensor]:
        """Least and greatest normalised latent (R, C) that the quantiser can give."""
        ends = zip(*(s.quantiser.range() for s in self.each), strict=True)
        low, high = (self.normalise(torch.cat(end).to(self.latent_mean)) for end in ends)
        return low, high
