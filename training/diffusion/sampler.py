"""Blockwise local context (paper 3.4) and layer-decoupled guidance (3.5): latents of any length from a
denoiser.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from training.config import STREAMS, STRIDE, DiffusionConfig, FrameConfig
from training.denoiser.denoiser import Denoiser
from training.diffusion.noise import noise
from training.diffusion.schedule import Step, alphas_cumprod, ddim_steps
from training.hfsq.autoencoder import Autoencoder
from training.motion.foot_contact_correction import grip
from training.motion.leader_frame import smoothed_heading
from training.motion.sharpen import sharpen
from training.motion.streams import leader_features, reactor_motion


@dataclass(frozen=True)
class Model:
    """A trained pair of stages, ready to dance."""

    hfsq: Autoencoder
    frame: FrameConfig
    denoiser: Denoiser
    diffusion: DiffusionConfig


@dataclass(frozen=True)
class Block:
    """Latent frames [start, start + length) at positions 0 .. length - 1 of a block, the rest is padding."""

    start: int
    length: int


def partition(frames: int, block: int, shifted: bool = False) -> list[Block]:
    """Blocks that tile `frames` latent frames; a shifted partition begins with half a block."""
    first = block // 2 if shifted else block
    blocks = [Block(0, min(first, frames))]
    while (start := blocks[-1].start + blocks[-1].length) < frames:
        blocks.append(Block(start, min(block, frames - start)))
    return blocks


def overlapping(frames: int, block: int) -> list[Block]:
    """Windows half a block apart, for latent stitching (the paper's Table 3, after EDGE)."""
    starts = range(0, max(frames - block // 2, 1), block // 2)
    return [Block(start, min(block, frames - start)) for start in starts]


def gather(values: Tensor, blocks: list[Block], block: int) -> Tensor:
    """(L, ...) to (B, block, ...), padded with zeros."""
    out = values.new_zeros(len(blocks), block, *values.shape[1:])
    for i, b in enumerate(blocks):
        out[i, : b.length] = values[b.start : b.start + b.length]
    return out


def scatter(values: Tensor, blocks: list[Block], frames: int) -> Tensor:
    """Inverse of `gather`; where blocks overlap, a cross-fade."""
    out = values.new_zeros(frames, *values.shape[2:])
    total = values.new_zeros(frames)
    extra = (1,) * (values.dim() - 2)
    for i, b in enumerate(blocks):
        ramp = torch.minimum(torch.arange(1, b.length + 1), torch.arange(b.length, 0, -1)).to(values.dtype)
        out[b.start : b.start + b.length] += values[i, : b.length] * ramp.view(-1, *extra)
        total[b.start : b.start + b.length] += ramp
    return out / total.view(-1, *extra)


def clamp_to_range(denoiser: Denoiser, x0: Tensor) -> Tensor:
    """x0 (..., R, C) clamped to the range of the quantiser: the decoder has never seen a latent beyond it.

    Static thresholding, Saharia et al. 2022 (Imagen), section 2.3.
    """
    return torch.minimum(torch.maximum(x0, denoiser.lowest), denoiser.highest)


def classifier_free_guidance(
    denoiser: Denoiser,
    x: Tensor,
    time: Tensor,
    memory: Tensor,
    valid: Tensor,
    guidance: Tensor,
    music_guidance: Tensor,
) -> Tensor:
    """Classifier-free guidance (Ho and Salimans 2022) per stream and layer, the paper's Eq. 9, with a term for music:

        x0 = (1 + s) cond - s uncond + m (cond - no_music)

    cond is the prediction for leader and music, uncond for neither, no_music for the leader alone. The last term is
    guidance by a single condition (Liu et al. 2022) and not in the paper; m = 0 leaves Eq. 9.

    x (B, block, R, C), time (1,), memory (B, block, 3 D) of `condition`, valid (B, block), guidance s (S, R),
    music_guidance m (1,). Returns x0 (B, block, R, C), clamped to the quantiser's range. The coarse layer is combined
    from coarse predictions alone, so no fine weight reaches it.
    """
    leader, music, silence = memory.chunk(3, dim=-1)
    with_music, without_music = torch.cat([leader, music], dim=-1), torch.cat([leader, silence], dim=-1)
    ones = valid[:, :1].expand(-1, denoiser.layers) * 0 + 1
    keep = torch.cat([ones, ones * 0, ones])
    predictions = denoiser(
        torch.cat([x, x, x]),
        time,
        torch.cat([with_music, with_music, without_music]),
        torch.cat([valid, valid, valid]),
        keep,
        keep,
    )
    # Written so that the exported graph needs no shape arithmetic.
    cond, uncond, no_music = predictions.reshape(3, -1, *predictions.shape[1:]).unbind(0)
    s = guidance.T.repeat_interleave(denoiser.latent_width // len(STREAMS), dim=1)  # (R, C)
    return clamp_to_range(denoiser, cond + s * (cond - uncond) + music_guidance * (cond - no_music))


Progress = Callable[[int, Tensor, Tensor], None]


@torch.no_grad()
def sample(
    model: Model,
    memory: Tensor,
    initial: Tensor,
    steps: list[Step],
    guidance: Tensor,
    music_guidance: float,
    on_step: Progress | None = None,
) -> Tensor:
    """Clean normalised latents (L, R, C) for memory (L, M) from standard normal noise (L, R, C); guidance and
    music_guidance as in `classifier_free_guidance`.

    All blocks are computed in parallel. `on_step(k, x, x0)` sees the state after each step.
    """
    denoiser, config = model.denoiser, model.diffusion
    frames, size = len(memory), denoiser.config.block
    x = initial
    for k, step in enumerate(steps):
        if config.stitching:
            blocks = overlapping(frames, size)
        else:
            blocks = partition(frames, size, shifted=config.alternating_phase and k % 2 == 1)
        valid = gather(torch.ones(frames), blocks, size)
        x0 = classifier_free_guidance(
            denoiser, gather(x, blocks, size), torch.tensor([step.time], dtype=torch.float32),
            gather(memory, blocks, size), valid, guidance, torch.tensor([music_guidance]),
        )  # fmt: skip
        x0 = scatter(x0, blocks, frames)
        x = step.a * x + step.b * x0
        if on_step is not None:
            on_step(k, x, x0)
    return x


@torch.no_grad()
def condition(model: Model, leader: Tensor, music: Tensor, music_valid: Tensor, role: float = 0.0) -> Tensor:
    """Memory (L, 3 D) of a whole clip: leader, music, and what stands for the music where there is none.

    leader (T, 22, 3) metres, music (T, 54), music_valid (T); T a multiple of 4.
    """
    features = leader_features(leader, smoothed_heading(leader, model.frame))
    encoder = model.denoiser.condition
    return encoder.of_clip(features[None], music[None], music_valid[None], torch.tensor([role]))[0]


def danced(model: Model, latents: Tensor, leader: Tensor, layers: Tensor) -> Tensor:
    """Sampled normalised latents (L, R, C) to the reactor's joints (T, 22, 3) in metres; `layers` (R,) multiplies each
    residual layer.
    """
    raw = model.hfsq.denormalise(latents) * layers[:, None]
    streams = [sharpen(stream[0], model.diffusion.sharpen) for stream in model.hfsq.decode(raw[None])]
    motion = reactor_motion(streams, leader, smoothed_heading(leader, model.frame))
    return grip(motion, model.diffusion.foot_contact)


@torch.no_grad()
def decode(model: Model, latents: Tensor, leader: Tensor, layers: Tensor | None = None) -> Tensor:
    """Normalised latents (L, R, C) to reactor joints (T, 22, 3); `layers` (R,) multiplies each residual
    layer.
    """
    return danced(model, latents, leader, torch.ones(model.denoiser.layers) if layers is None else layers)


def pad_to_stride(motion: np.ndarray) -> np.ndarray:
    """Repeat the last frame until the length is a multiple of 4."""
    missing = -len(motion) % STRIDE
    return np.concatenate([motion, np.repeat(motion[-1:], missing, axis=0)]) if missing else motion


@torch.no_grad()
def react(
    model: Model,
    leader: np.ndarray,
    music: np.ndarray | None,
    seed: int,
    steps: int | None = None,
    guidance: np.ndarray | None = None,
    role: float = 0.0,
    music_guidance: float | None = None,
) -> np.ndarray:
    """The reactor (T, 22, 3) for a leader (T, 22, 3) at the model's reference height and music (T', 54) or
    None.

    guidance: (S, R), Eq. 9's s, and music_guidance, see `classifier_free_guidance`; None takes the model's default.
    Where the music is shorter than the dance there is silence.
    """
    frames = len(leader)
    padded = torch.from_numpy(pad_to_stride(leader)).float()
    heard, valid = torch.zeros(len(padded), 54), torch.zeros(len(padded))
    if music is not None:
        n = min(len(music), len(padded))
        heard[:n], valid[:n] = torch.from_numpy(music[:n]).float(), 1.0
    memory = condition(model, padded, heard, valid, role)
    layers, width = model.denoiser.layers, model.denoiser.latent_width
    initial = torch.from_numpy(noise(seed, len(memory), layers * width)).float().unflatten(1, (layers, width))
    if guidance is None:
        guidance = np.tile(np.array(model.diffusion.guidance, dtype=np.float32), (len(STREAMS), 1))
    plan = ddim_steps(alphas_cumprod(model.diffusion), steps or model.diffusion.steps)
    if music_guidance is None:
        music_guidance = model.diffusion.music
    latents = sample(model, memory, initial, plan, torch.from_numpy(guidance).float(), music_guidance)
    return decode(model, latents, padded)[:frames].numpy()
