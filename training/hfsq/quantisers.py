"""From encoder features to hierarchical latents and back: HFSQ, the two others of the paper's Table 2, and none."""

from __future__ import annotations

from typing import cast

import torch
from torch import Tensor, nn
from vector_quantize_pytorch import ResidualVQ

from training.config import STRIDE, HfsqConfig
from training.motion.streams import STREAM_WIDTHS


def fsq(e: Tensor, levels: Tensor) -> Tensor:
    """Finite scalar quantisation (Mentzer et al. 2024) with a straight-through gradient.

    e: (..., d) unbounded; levels: (d,) bins per dimension. Returns (..., d): grid values in [-1, 1].
    """
    half = (levels - 1) * (1 + 1e-3) / 2
    offset = torch.where(levels % 2 == 0, 0.5, 0.0)
    bounded = torch.tanh(e + torch.atanh(offset / half)) * half - offset
    rounded = bounded + (bounded.round() - bounded).detach()
    return rounded / (levels / 2).floor()


def fsq_range(levels: Tensor) -> tuple[Tensor, Tensor]:
    """Least and greatest value that `fsq` can give in each of the (d,) dimensions."""
    half = (levels / 2).floor()
    return -torch.ones_like(half), torch.where(levels % 2 == 0, half - 1, half) / half


class Hfsq(nn.Module):
    """Grouped residual FSQ (Eq. 1): each of G groups is quantised over R layers.

    Every layer projects the residual to the FSQ dimensions and back with its own matrices, so later layers code the
    directions that earlier ones left out as well as their rounding.
    The residual is divided by s_r before it is quantised; without that it would mostly round to zero.
    """

    levels: Tensor

    def __init__(self, config: HfsqConfig) -> None:
        super().__init__()
        groups, layers, width, dims = config.groups, config.layers, config.group_width, len(config.levels)
        if len(config.scales) != layers:
            raise ValueError(
                f"{layers} residual layers need {layers} scales (--hfsq.scales), got {config.scales}"
            )
        self.groups, self.layers, self.width = groups, layers, groups * width
        self.latent_width = groups * dims
        self.scales = config.scales
        self.register_buffer("levels", torch.tensor(config.levels, dtype=torch.float32))
        self.down = nn.Parameter(torch.empty(layers, groups, width, dims))
        self.up = nn.Parameter(torch.empty(layers, groups, dims, width))
        for r in range(layers):
            for g in range(groups):
                # Orthogonal directions, different for each layer: the start of a hierarchy, not its rounding error.
                basis = torch.linalg.qr(torch.randn(width, width)).Q[:, :dims]
                self.down.data[r, g] = basis
                self.up.data[r, g] = basis.T

    def forward(self, v: Tensor) -> Tensor:
        """v: (N, L, G * width). Returns the dequantised codes (N, L, R, G * dims)."""
        residual = v.unflatten(-1, (self.groups, -1))
        codes: list[Tensor] = []
        for r, scale in enumerate(self.scales):
            z = fsq(torch.einsum("nlgw,gwd->nlgd", residual / scale, self.down[r]), self.levels)
            residual = residual - scale * torch.einsum("nlgd,gdw->nlgw", z, self.up[r])
            codes.append(z.flatten(-2))
        return torch.stack(codes, dim=2)

    def combine(self, codes: Tensor) -> Tensor:
        """Sum of s_r times the layers' images: (N, L, R, G * dims) to (N, L, G * width)."""
        z = codes.unflatten(-1, (self.groups, -1))
        total = self.scales[0] * torch.einsum("nlgd,gdw->nlgw", z[:, :, 0], self.up[0])
        for r in range(1, self.layers):
            total = total + self.scales[r] * torch.einsum("nlgd,gdw->nlgw", z[:, :, r], self.up[r])
        return total.flatten(-2)

    def range(self) -> tuple[Tensor, Tensor]:
        """Least and greatest code (latent_width,)."""
        low, high = fsq_range(self.levels)
        return low.repeat(self.groups), high.repeat(self.groups)

    def penalty(self) -> Tensor | float:
        return 0.0


def _unlimited(width: int) -> tuple[Tensor, Tensor]:
    return torch.full((width,), -torch.inf), torch.full((width,), torch.inf)


class ResidualVectorQuantiser(nn.Module):
    """Residual vector quantisation with learned codebooks, one residual stack per group."""

    def __init__(self, config: HfsqConfig) -> None:
        super().__init__()
        self.groups, self.layers = config.groups, config.layers
        self.width = self.latent_width = config.groups * config.group_width
        self.stacks = nn.ModuleList(
            ResidualVQ(dim=config.group_width, num_quantizers=config.layers, codebook_size=config.codebook)
            for _ in range(config.groups)
        )
        self._commitment: Tensor | float = 0.0

    @property
    def codebooks(self) -> list[Tensor]:
        """Of every group (layers, codes, group width)."""
        return [cast(Tensor, cast(ResidualVQ, stack).codebooks) for stack in self.stacks]

    def forward(self, v: Tensor) -> Tensor:
        codes, commitment = [], v.new_zeros(())
        for group, stack in zip(v.unflatten(-1, (self.groups, -1)).unbind(2), self.stacks, strict=True):
            quantised, _, loss, layers = stack(group, return_all_codes=True)
            # The library's sum is straight-through; its parts are not, so the gradient enters by the base layer.
            parts = layers.permute(1, 2, 0, 3)
            base = parts[:, :, :1] + (quantised - parts.sum(2).detach())[:, :, None]
            codes.append(torch.cat([base, parts[:, :, 1:]], dim=2))
            commitment = commitment + loss.sum()
        self._commitment = commitment / self.groups
        return torch.cat(codes, dim=-1)

    def combine(self, codes: Tensor) -> Tensor:
        return codes.sum(2)

    def range(self) -> tuple[Tensor, Tensor]:
        return _unlimited(self.latent_width)

    def penalty(self) -> Tensor | float:
        return self._commitment


class Unquantised(nn.Module):
    """Features as they are, in one layer: for the no-latent baseline."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.layers = 1
        self.width = self.latent_width = width

    def forward(self, v: Tensor) -> Tensor:
        return v[:, :, None]

    def combine(self, codes: Tensor) -> Tensor:
        return codes[:, :, 0]

    def range(self) -> tuple[Tensor, Tensor]:
        return _unlimited(self.latent_width)

    def penalty(self) -> Tensor | float:
        return 0.0


class KlBottleneck(Unquantised):
    """One Gaussian layer with a KL term (the paper's VAE row)."""

    def __init__(self, config: HfsqConfig) -> None:
        if config.layers != 1:
            raise ValueError(f"the KL bottleneck has a single layer, config asks for {config.layers}")
        super().__init__(config.groups * config.group_width)
        self.to_moments = nn.Linear(self.width, 2 * self.width)
        self.weight = config.weight_kl
        self._kl: Tensor | float = 0.0

    def forward(self, v: Tensor) -> Tensor:
        mean, log_variance = self.to_moments(v).chunk(2, dim=-1)
        log_variance = log_variance.clamp(-12, 6)
        self._kl = 0.5 * (mean.square() + log_variance.exp() - 1 - log_variance).mean()
        sample = mean + torch.randn_like(mean) * (0.5 * log_variance).exp() if self.training else mean
        return sample[:, :, None]

    def penalty(self) -> Tensor | float:
        return self.weight * self._kl


Quantiser = Hfsq | ResidualVectorQuantiser | KlBottleneck | Unquantised


_ONLY_OF = {"levels": "hfsq", "scales": "hfsq", "codebook": "rvq", "weight_kl": "kl"}
"""Options that other quantisers would not read."""


def make_quantiser(config: HfsqConfig) -> Quantiser:
    """The quantiser that the config asks for. Raises ValueError for an option that it would not read."""
    usual = HfsqConfig()
    for name, kind in _ONLY_OF.items():
        value = getattr(config, name)
        single = name == "scales" and value == (1.0,)  # what a single layer has anyway
        if config.quantiser != kind and value != getattr(usual, name) and not single:
            raise ValueError(
                f"{name} is an option of the quantiser {kind}; {config.quantiser} does not read it"
            )
    if config.quantiser == "none":
        if config.layers != 1:
            raise ValueError(f"without a quantiser there is a single layer, config asks for {config.layers}")
        return Unquantised(STRIDE * max(STREAM_WIDTHS))
    kinds = {"hfsq": Hfsq, "rvq": ResidualVectorQuantiser, "kl": KlBottleneck}
    return kinds[config.quantiser](config)
