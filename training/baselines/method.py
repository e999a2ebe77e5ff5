"""What every baseline is: a module with a loss and a sampler, and the terms of the loss that several have."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, NamedTuple

import torch
from torch import Tensor, nn

from training.config import STRIDE, ConditionConfig
from training.denoiser.condition import ConditionEncoder
from training.denoiser.losses import contact_loss
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.losses import kinematic

CLEAN_WINDOWS = 4  # of a batch, those with least noise: the only ones that are decoded to joints
Name = Literal["edge", "intergen", "tcdiff", "duolando", "gesturelsm"]


@dataclass(frozen=True)
class BaselineConfig:
    """Sizes of a baseline's networks."""

    method: Name
    width: int = 128
    depth: int = 4
    """Layers of all transformers of the method together."""
    heads: int = 4
    block: int = 60
    """Tokens that are seen at once; a token has four frames."""
    steps: int = 10
    """Of sampling, for diffusion."""

    def __post_init__(self) -> None:
        if self.width % self.heads:
            raise ValueError(f"a width of {self.width} cannot be shared by {self.heads} heads")
        if self.depth < 2:
            raise ValueError(f"{self.depth} layers are too few: a method may have two networks")


class Known(NamedTuple):
    """What a method is given of N windows, or of one whole dance."""

    memory: Tensor  # (N, L, 2 D) of the condition encoder: the leader's half, the music's half
    leader: Tensor  # (N, L, 4 x 68) normalised features of the leader by token
    valid: Tensor  # (N, L)


class Window(NamedTuple):
    """What is to be learnt from N windows."""

    latents: Tensor  # (N, block, R, C) normalised latents of the method's autoencoder
    motion: Callable[[Tensor, list[int]], Tensor]  # latents of those windows to world joints (n, T, 22, 3)
    leader: Tensor  # (N, T, 22, 3)
    reactor: Tensor  # (N, T, 22, 3)


class Method(nn.Module):
    """A baseline. Subclasses learn and sample normalised latents of the autoencoder that is given to them."""

    def __init__(self, config: BaselineConfig, hfsq: Autoencoder) -> None:
        super().__init__()
        self.config = config
        self.channels = hfsq.latent_width
        self.condition = ConditionEncoder(config.width, ConditionConfig())

    def loss(self, known: Known, window: Window) -> dict[str, Tensor]:
        """Terms whose sum is minimised."""
        raise NotImplementedError

    def sample(self, known: Known, noise: torch.Generator) -> Tensor:
        """Latents (L, R, C) of a whole dance."""
        raise NotImplementedError

    def leader_tokens(self, features: Tensor) -> Tensor:
        """Leader features (N, 4 L, 68) normalised, (N, L, 272)."""
        normal = (features - self.condition.leader.mean) / self.condition.leader.std
        return normal.unflatten(1, (-1, STRIDE)).flatten(2)


def clean_rows(known: Known) -> list[int]:
    """The windows with least noise, which come first, that are not cut short."""
    return [i for i in range(min(CLEAN_WINDOWS, len(known.valid))) if known.valid[i].min() > 0]


def motion_terms(known: Known, window: Window, predicted: Tensor, signal: Tensor) -> dict[str, Tensor]:
    """Errors of positions and speed, and of feet that should stand, of the windows with least noise.

    predicted: latents as in the window; signal (N,): alpha bar, by which windows count. Weights are ours.
    """
    rows = clean_rows(known)
    if not rows:
        return {}
    truth, made = window.reactor[rows], window.motion(predicted[rows], rows)
    weights = signal[rows]
    errors = torch.stack(
        [kinematic(t[None], m[None], (1.0, 5.0, 5.0)) for t, m in zip(truth, made, strict=True)]
    )
    return {
        "kinematic": 0.02 * (errors * weights).mean(),
        "contact": 0.5 * (contact_loss(truth, made) * weights).mean(),
    }
