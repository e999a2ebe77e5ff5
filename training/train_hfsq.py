"""Stage 1: train the HFSQ autoencoder (paper 3.2).

python -m training.train_hfsq --data ../shared/data/cmu_salsa/duets.npz --out runs/salsa
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import cast

import numpy as np
import torch
import tyro
from lightning_fabric import Fabric
from lion_pytorch import Lion
from torch import Tensor, nn

from training.checkpoint import save_hfsq, start_from
from training.config import STRIDE, FrameConfig, HfsqConfig
from training.data.augment import mirror, swap_roles, tempo_warp
from training.data.duet import Duet
from training.data.npz import read_solo
from training.data.sources import read_split
from training.data.splits import Split
from training.frame import smoothed_heading
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.losses import stage1_loss
from training.hfsq.masking import slow_motion
from training.loop import (
    Average,
    Budget,
    Journal,
    Precision,
    fast_precision,
    learning_rate,
    load_state,
    save_state,
)
from training.metrics import mean_report, quick_report
from training.streams import reactor_motion, to_streams

Streams = tuple[Tensor, Tensor, Tensor]


@dataclass(frozen=True)
class Clip:
    streams: Streams  # (T, c) each
    slow: Streams  # the same below the masking's cutoff

    def __len__(self) -> int:
        return len(self.streams[0])


@dataclass(frozen=True)
class Options:
    data: Path
    """Duets: an npz archive, a DD100 root, or a folder of paired BVH files (see training/data/sources.py)."""
    out: Path
    """Folder of this run: checkpoint, journal, curves."""
    init: Path | None = None
    """Start from the autoencoder of this checkpoint."""
    keep_latents: bool = False
    """Train the decoders alone, so that a denoiser of the `init` checkpoint goes on fitting."""
    solo: Path | None = None
    """npz archive of solo dances whose bodies join the training of the upper and lower streams."""
    solo_prefixes: tuple[str, ...] = ("indian", "modern")
    val: tuple[str, ...] = ("salsa_03",)
    test: tuple[str, ...] = ("salsa_05", "salsa_11")
    steps: int = 4000
    minutes: float | None = None
    """Stop after this time even if the steps are not done; the learning rate follows whichever comes first.
    """
    batch: int = 48
    window: int = 240
    learning_rate: float = 3e-4
    weight_decay: float = 1e-3
    average: float = 0.998
    tempos: tuple[float, ...] = (0.9, 1.0, 1.1)
    seed: int = 0
    devices: int = 1
    threads: int = 0
    """CPU threads for torch, 0 leaves its default."""
    precision: Precision | None = None
    """Left out: bf16 where its products are fast, single elsewhere."""
    log_every: int = 50
    evaluate_every: int = 500
    resume: bool = False
    hfsq: HfsqConfig = field(default_factory=HfsqConfig)
    frame: FrameConfig = field(default_factory=FrameConfig)


def streams_of(duet: Duet, frame: FrameConfig) -> Streams:
    leader, reactor = torch.from_numpy(duet.leader), torch.from_numpy(duet.reactor)
    return to_streams(leader, reactor, smoothed_heading(leader, frame))


def training_clips(options: Options, duets: Split) -> list[Clip]:
    """Every training duet and solo, also mirrored, role-swapped and at other tempos."""
    clips: list[Streams] = []
    for duet in duets.train:
        for tempo in options.tempos:
            warped = tempo_warp(duet, tempo)
            for variant in (warped, mirror(warped)):
                clips += [streams_of(variant, options.frame), streams_of(swap_roles(variant), options.frame)]
    if options.solo is not None:
        for solo in read_solo(options.solo):
            if solo.name.startswith(options.solo_prefixes):
                # A soloist dances with themselves: bodies are real, the placement stream sees its own
                # height only.
                alone = Duet(solo.name, solo.motion, solo.motion)
                clips += [streams_of(variant, options.frame) for variant in (alone, mirror(alone))]
    cutoff = options.hfsq.masking.cutoff if options.hfsq.masking else None
    return [
        Clip(streams, cast(Streams, tuple(slow_motion(stream, cutoff) for stream in streams)))
        for streams in clips
        if len(streams[0]) >= options.window
    ]


class Windows:
    """Random windows of the clips, turned by a random angle about the vertical in half of the cases."""

    def __init__(self, clips: list[Clip], size: int, seed: int) -> None:
        self.clips, self.size = clips, size
        starts = np.array([len(c) - size + 1 for c in clips], dtype=np.float64)
        self.shares = starts / starts.sum()
        self.random = np.random.default_rng(seed)

    def batch(self, n: int) -> tuple[Streams, Streams]:
        """Three tensors (n, size, c), and the same three of the slow motion."""
        chosen = [self.clips[i] for i in self.random.choice(len(self.clips), n, p=self.shares)]
        starts = [int(self.random.integers(0, len(clip) - self.size + 1)) for clip in chosen]
        angle = self.random.uniform(-np.pi, np.pi, n) * (self.random.random(n) < 0.5)
        angles = torch.from_numpy(angle).float()

        def cut(streams: list[Streams]) -> Streams:
            upper, lower, placement = (
                torch.stack([each[i][at : at + self.size] for each, at in zip(streams, starts, strict=True)])
                for i in range(3)
            )
            return turn(upper, angles), turn(lower, angles), placement

        return cut([clip.streams for clip in chosen]), cut([clip.slow for clip in chosen])


def turn(stream: Tensor, angle: Tensor) -> Tensor:
    """Turn joint positions (N, T, 3 k) about the vertical by (N,) radians."""
    joints = stream.unflatten(-1, (-1, 3))
    c, s = angle.cos()[:, None, None], angle.sin()[:, None, None]
    x, y, z = joints.unbind(-1)
    return torch.stack([c * x + s * z, y, c * z - s * x], dim=-1).flatten(-2)


def set_input_statistics(model: Autoencoder, clips: list[Clip]) -> None:
    """Mean per dimension and one standard deviation per stream, from training clips."""
    for i, stream in enumerate(model.each):
        values = torch.cat([clip.streams[i] for clip in clips])
        stream.mean.copy_(values.mean(0))
        stream.std.copy_(values.std(0).mean())


@torch.no_grad()
def set_latent_statistics(model: Autoencoder, clips: list[Clip]) -> None:
    latents = torch.cat([encode_clip(model, clip)[0] for clip in clips])
    model.latent_mean.copy_(latents.mean(0))
    model.latent_std.copy_(latents.std(0).clamp_min(1e-3))


def encode_clip(model: Autoencoder, clip: Clip) -> Tensor:
    """Latents (1, L, R, C) of a whole clip; up to 3 frames at its end are left out."""
    frames = len(clip) // STRIDE * STRIDE
    return model.encode([s[None, :frames] for s in clip.streams])


@torch.no_grad()
def reconstruct(model: Autoencoder, duet: Duet, frame: FrameConfig, layers: int | None = None) -> np.ndarray:
    """The reactor (T, 22, 3) after encoding and decoding, from the first `layers` layers if given."""
    frames = len(duet) // STRIDE * STRIDE
    leader = torch.from_numpy(duet.leader[:frames])
    heading = smoothed_heading(leader, frame)
    streams = to_streams(leader, torch.from_numpy(duet.reactor[:frames]), heading)
    latents = model.encode([s[None] for s in streams])
    if layers is not None:
        latents[:, :, layers:] = 0
    return reactor_motion([s[0] for s in model.decode(latents)], leader, heading).numpy()


def evaluate(model: Autoencoder, duets: tuple[Duet, ...], options: Options) -> dict[str, float]:
    """Mean reconstruction errors over duets, of all layers and of the coarse layer alone."""
    rows: list[dict[str, float]] = []
    for duet in duets:
        frames = len(duet) // STRIDE * STRIDE
        row: dict[str, float] = {}
        for name, layers in (("all", None), ("coarse", 1)):
            motion = reconstruct(model, duet, options.frame, layers)
            report = quick_report(duet.leader[:frames], duet.reactor[:frames], motion)
            row |= {f"val/{name}/{k}": report[k] for k in ("mpjpe_mm", "root_error_mm", "speed_ratio")}
        rows.append(row)
    return mean_report(rows)


@torch.no_grad()
def bins_used(model: Autoencoder, clips: list[Clip]) -> list[float]:
    """Share of FSQ bins that training data uses, per residual layer (fault: an undivided residual rounds to
    zero).
    """
    latents = torch.cat([encode_clip(model, clip)[0] for clip in clips[: len(clips) // 4 + 1]])
    levels = torch.tensor(model.config.levels * (model.latent_width // len(model.config.levels)))
    shares = []
    for layer in range(model.layers):
        used = [len(latents[:, layer, c].mul(1000).round().unique()) for c in range(model.latent_width)]
        shares.append(float((torch.tensor(used) / levels).mean()))
    return shares


class Stage1(nn.Module):
    """The loss as a module, so that distributed training sees one forward pass."""

    def __init__(self, model: Autoencoder, config: HfsqConfig) -> None:
        super().__init__()
        self.model, self.config = model, config

    def forward(self, motions: Streams, slow: Streams) -> tuple[Tensor, dict[str, Tensor]]:
        return stage1_loss(self.model, motions, slow, self.config)


def main(options: Options) -> None:
    options = replace(options, precision=options.precision or fast_precision())
    if options.threads:
        torch.set_num_threads(options.threads)
    fabric = Fabric(accelerator="auto", devices=options.devices, precision=options.precision)
    fabric.launch()
    fabric.seed_everything(options.seed, verbose=False)

    duets = read_split(options.data, options.val, options.test)
    clips = training_clips(options, duets)
    windows = Windows(clips, options.window, options.seed * 1000 + fabric.global_rank)
    autoencoder = Autoencoder(options.hfsq)
    if options.init:
        start_from(autoencoder, options.init, "hfsq")
    else:
        set_input_statistics(autoencoder, clips)
    if options.keep_latents:
        for stream in autoencoder.each:
            stream.encoder.requires_grad_(False)
            stream.quantiser.requires_grad_(False)

    stage = Stage1(autoencoder, options.hfsq)
    trained = [p for p in stage.parameters() if p.requires_grad]
    optimizer = Lion(trained, lr=options.learning_rate, weight_decay=options.weight_decay)
    average = Average(autoencoder, options.average)
    average.module.to(fabric.device)
    stage, optimizer = fabric.setup(stage, optimizer)
    budget = Budget(options.steps, options.minutes)
    journal = Journal(options.out / "hfsq", fabric.is_global_zero)
    state = options.out / "hfsq" / "state.ckpt"
    if options.resume:
        load_state(fabric, state, stage, optimizer, average, budget)

    while budget.progress < 1:
        stage.train()
        for group in optimizer.param_groups:
            group["lr"] = learning_rate(options.learning_rate, budget, warmup=100)
        loss, parts = stage(*fabric.to_device(windows.batch(options.batch)))
        fabric.backward(loss)
        fabric.clip_gradients(stage, optimizer, max_norm=1.0)
        optimizer.step()
        optimizer.zero_grad()
        average.update(autoencoder)
        budget.tick()
        budget.spent = fabric.broadcast(budget.spent)  # one clock for all ranks: it sets the learning rate
        journal.add(parts)
        if budget.step % options.log_every == 0:
            journal.write(budget)
        if budget.step % options.evaluate_every == 0:
            save_state(fabric, state, stage, optimizer, average, budget)
            if fabric.is_global_zero:
                journal.write(budget, evaluate(average.module.cpu(), duets.val, options))
                journal.draw()
                average.module.to(fabric.device)

    if fabric.is_global_zero:
        final = average.module.cpu()
        if not options.keep_latents:
            set_latent_statistics(final, clips)
        report = evaluate(final, duets.val, options)
        if options.hfsq.quantiser == "hfsq":
            report |= {f"bins/{i}": share for i, share in enumerate(bins_used(final, clips))}
        journal.write(budget, report)
        journal.draw()
        provenance = {
            "program": "training.train_hfsq",
            "steps": budget.step,
            "minutes": round(budget.spent / 60, 1),
            "options": {k: str(v) for k, v in asdict(options).items() if k not in ("hfsq", "frame")},
            "validation": report,
        }
        save_hfsq(options.out, final, options.frame, provenance)
    fabric.barrier()


if __name__ == "__main__":
    main(tyro.cli(Options))
