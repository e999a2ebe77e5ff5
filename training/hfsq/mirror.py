"""What a mirror does to latents. Decoding, mirroring and encoding again would tell exactly, and takes the whole
autoencoder; sampling asks a network that has learnt it (`training.train_mirror`).
"""

from __future__ import annotations

from torch import Tensor, nn

from training.hfsq.convolutions import residual_blocks


class LatentMirror(nn.Module):
    """Normalised coarse latents (N, L, C) of a dance to those of the dance seen in a mirror."""

    def __init__(self, channels: int, width: int, depth: int) -> None:
        super().__init__()
        self.straight = nn.Conv1d(channels, channels, 3, padding=1)
        self.bent = nn.Sequential(
            nn.Conv1d(channels, width, 3, padding=1),
            residual_blocks(width, depth),
            nn.Conv1d(width, channels, 1),
        )

    def forward(self, coarse: Tensor) -> Tensor:
        x = coarse.transpose(1, 2)
        return (self.straight(x) + self.bent(x)).transpose(1, 2)
