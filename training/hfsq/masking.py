"""Progressive masking (paper 3.2, Figure 3): residual masking and code masking while stage 1 trains."""

from __future__ import annotations

import torch
from scipy.signal import butter, sosfiltfilt
from torch import Tensor

from training.config import FPS, MaskingConfig


def slow_motion(motion: Tensor, cutoff: float | None) -> Tensor:
    """Motion (T, c) low-passed at `cutoff` Hz without phase shift; unchanged where the cutoff is None."""
    if cutoff is None:
        return motion
    filtered = sosfiltfilt(butter(4, cutoff, fs=FPS, output="sos"), motion.numpy(), axis=0)
    return torch.from_numpy(filtered.copy()).to(motion)


def progressive_masking(codes: Tensor, config: MaskingConfig) -> tuple[Tensor, Tensor]:
    """Corrupt codes (N, L, R, C), each window by its own draw.

    Residual masking hides a random depth of layers above the base and adds scaled Gaussian noise to the base layer, so
    that the coarse layer alone decodes to a body. Code masking zeroes single dimensions of the codes.
    Returns the codes and (N,) whether layers of the window are hidden; a single layer has none to hide.
    """
    n, _, layers, _ = codes.shape
    draw = lambda *shape: torch.rand(*shape, device=codes.device)  # noqa: E731
    noisy = draw(n) < config.residual
    hidden = noisy & (layers > 1)
    if layers > 1:
        kept = 1 + (draw(n) * (layers - 1)).floor()  # 1 .. layers - 1 layers survive in a hidden window
        order = torch.arange(layers, device=codes.device)
        keep = (order[None] < torch.where(hidden, kept, layers)[:, None]).to(codes.dtype)
        codes = codes * keep[:, None, :, None]
    noise = torch.randn_like(codes[:, :, :1]) * config.base_noise * noisy[:, None, None, None]
    codes = torch.cat([codes[:, :, :1] + noise, codes[:, :, 1:]], dim=2)
    masked = (draw(n) < config.code)[:, None, None, None] & (draw(*codes.shape) < config.code_rate)
    return codes * (~masked).to(codes.dtype), hidden
