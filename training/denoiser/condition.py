"""Leader and music to one memory vector per latent frame; computed once per input, shared by all steps and layers."""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from training.config import STRIDE, ConditionConfig
from training.motion.streams import LEADER_FEATURES
from training.music.recipe import MUSIC_FEATURES


class MaskedBlock(nn.Module):
    """Residual convolution over time that sees zeros outside the clip.

    A window cut from a clip with enough margin gives the same result as the whole clip: `inside` zeroes at every
    layer what the zero padding of the whole clip would.
    """

    def __init__(self, width: int) -> None:
        super().__init__()
        self.first = nn.Conv1d(width, width, 3, padding=1)
        self.second = nn.Conv1d(width, width, 3, padding=1)
        for parameter in self.second.parameters():
            nn.init.zeros_(parameter)

    def forward(self, x: Tensor, inside: Tensor | None) -> Tensor:
        h = F.silu(x)
        h = F.silu(self.first(h if inside is None else h * inside))
        return x + self.second(h if inside is None else h * inside)


class Patches(nn.Module):
    """Four motion frames to one token, then short context: (N, T, c) to (N, width, L)."""

    mean: Tensor
    std: Tensor

    def __init__(self, channels: int, width: int, depth: int) -> None:
        super().__init__()
        self.register_buffer("mean", torch.zeros(channels))
        self.register_buffer("std", torch.ones(channels))
        self.patch = nn.Conv1d(channels, width, STRIDE, stride=STRIDE)
        self.blocks = nn.ModuleList(MaskedBlock(width) for _ in range(depth))

    def embed(self, x: Tensor) -> Tensor:
        # The convolution as a product, which it is, since patches do not overlap: the WebGPU convolution of
        # onnxruntime-web 1.30 is wrong when four does not divide its channels, as with the 54 of music.
        patches = ((x - self.mean) / self.std).reshape(len(x), -1, STRIDE * x.shape[-1])
        weight = self.patch.weight.transpose(1, 2).flatten(1)
        return F.linear(patches, weight, self.patch.bias).transpose(1, 2)

    def context(self, tokens: Tensor, inside: Tensor | None) -> Tensor:
        for block in self.blocks:
            tokens = block(tokens, inside)
        return tokens


class ConditionEncoder(nn.Module):
    """Leader features (N, T, 68), music (N, T, 54), its validity (N, T) and role (N,) to memory (N, L, 2 D).

    The first half of the memory is the leader's, the second the music's. Where the music is not valid (no song, or
    after its end) a learned vector stands for silence. role 0 asks for a reactor, 1 for a leader as the partner.
    No attention over time: only convolutions of `receptive_field` latent frames.
    """

    def __init__(self, width: int, config: ConditionConfig) -> None:
        super().__init__()
        self.config = config
        self.leader = Patches(LEADER_FEATURES, width, config.depth)
        self.music = Patches(MUSIC_FEATURES, width, config.depth)
        self.role = nn.Parameter(torch.zeros(width))
        self.silence = nn.Parameter(torch.zeros(width))

    @property
    def receptive_field(self) -> int:
        return 2 * self.config.depth

    @property
    def memory_width(self) -> int:
        """Channels of the memory: 2 D."""
        return 2 * len(self.silence)

    def set_statistics(self, features: Tensor, music: Tensor) -> None:
        """Takes mean and standard deviation of leader features (n, 68) and music (m, 54), those of training."""
        for patches, values in ((self.leader, features), (self.music, music)):
            patches.mean.copy_(values.mean(0))
            patches.std.copy_(values.std(0).clamp_min(1e-3))

    def unfamiliarity(self, leader: Tensor) -> Tensor:
        """How far leader features (N, T, 68) are from those of training: (N, L), the root mean square of the normalised
        features, about 1 for a leader of training.
        """
        features = (leader - self.leader.mean) / self.leader.std
        return features.square().mean(-1).reshape(len(features), -1, STRIDE).mean(-1).sqrt()

    def forward(
        self, leader: Tensor, music: Tensor, music_valid: Tensor, role: Tensor, inside: Tensor | None = None
    ) -> Tensor:
        """inside: (N, L) 1 where the latent frame belongs to the clip; None when the input is the whole clip."""
        mask = None if inside is None else inside[:, None]
        leader_tokens = self.leader.embed(leader) + (2 * role - 1)[:, None, None] * self.role[None, :, None]
        leader_tokens = self.leader.context(leader_tokens, mask)
        if not self.config.leader:
            leader_tokens = torch.zeros_like(leader_tokens)
        valid = F.avg_pool1d(music_valid[:, None], STRIDE)
        # The mask goes onto the input too: where there is no song its features may be anything.
        music_tokens = self.music.embed(torch.where(music_valid[..., None] > 0.5, music, self.music.mean))
        music_tokens = music_tokens * valid + self.silence[None, :, None] * (1 - valid)
        music_tokens = self.music.context(music_tokens, mask)
        if not self.config.music:
            music_tokens = torch.zeros_like(music_tokens)
        return torch.cat([leader_tokens, music_tokens], dim=1).transpose(1, 2)


def condition_dropout(n: int, layers: int, rates: ConditionConfig) -> tuple[Tensor, Tensor]:
    """keep_leader, keep_music (N, R): which residual layer keeps which condition (paper 3.5).

    Each layer is dropped by itself; now and then all layers together (the unconditional branch of Eq. 9),
    or the leader alone. Music alone is dropped where it enters, as silence.
    """
    keep = torch.rand(n, layers) >= rates.drop_layer
    keep &= torch.rand(n, 1) >= rates.drop_all
    keep_leader = keep & (torch.rand(n, 1) >= rates.drop_leader)
    return keep_leader.float(), keep.float()
