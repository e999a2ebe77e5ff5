"""The temporal encoder and decoder: convolutions alone, so any length goes through them."""

from __future__ import annotations

import torch.nn.functional as F
from torch import Tensor, nn

from training.config import STRIDE

DILATIONS = (1, 3)


class ResidualBlock(nn.Module):
    def __init__(self, width: int, dilation: int) -> None:
        super().__init__()
        self.wide = nn.Conv1d(width, width, 3, padding=dilation, dilation=dilation)
        self.out = nn.Conv1d(width, width, 3, padding=1)
        for parameter in self.out.parameters():
            nn.init.zeros_(parameter)

    def forward(self, x: Tensor) -> Tensor:
        return x + self.out(F.silu(self.wide(F.silu(x))))


def residual_blocks(width: int, depth: int) -> nn.Sequential:
    return nn.Sequential(*(ResidualBlock(width, DILATIONS[i % len(DILATIONS)]) for i in range(depth)))


class Encoder(nn.Module):
    """(N, c, T) to (N, latent, T / 4). One convolution takes the stride, the rest runs at the latent rate."""

    def __init__(self, channels: int, width: int, depth: int, latent: int) -> None:
        super().__init__()
        self.layers = nn.Sequential(
            nn.Conv1d(channels, width, 3 * STRIDE, stride=STRIDE, padding=STRIDE),
            residual_blocks(width, depth),
            nn.Conv1d(width, latent, 1),
        )

    def forward(self, x: Tensor) -> Tensor:
        return self.layers(x)


class Patch(nn.Module):
    """(N, c, T) to (N, latent, T / 4): four frames side by side, the rest of the channels zero. Nothing is learned."""

    def __init__(self, latent: int) -> None:
        super().__init__()
        self.latent = latent

    def forward(self, x: Tensor) -> Tensor:
        patches = x.unflatten(2, (-1, STRIDE)).transpose(2, 3).flatten(1, 2)
        return F.pad(patches, (0, 0, 0, self.latent - patches.shape[1]))


class Unpatch(nn.Module):
    """Inverse of `Patch`."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.channels = channels

    def forward(self, x: Tensor) -> Tensor:
        return x[:, : STRIDE * self.channels].unflatten(1, (self.channels, STRIDE)).transpose(2, 3).flatten(2)


class Decoder(nn.Module):
    """(N, latent, L) to (N, c, 4 L). Works at the latent rate, then refines at the frame rate in a narrow width."""

    def __init__(self, channels: int, width: int, depth: int, latent: int, refine: int) -> None:
        super().__init__()
        self.layers = nn.Sequential(
            nn.Conv1d(latent, width, 3, padding=1),
            residual_blocks(width, depth),
            nn.ConvTranspose1d(width, refine, 3 * STRIDE, stride=STRIDE, padding=STRIDE),
            ResidualBlock(refine, 1),
            ResidualBlock(refine, 3),
            nn.Conv1d(refine, channels, 5, padding=2),
        )

    def forward(self, x: Tensor) -> Tensor:
        return self.layers(x)
