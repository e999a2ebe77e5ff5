"""Stage 1: train the HFSQ autoencoder (paper 3.2).

python -m training.train_hfsq --data ../shared/data/cmu_salsa/duets.npz --out runs/salsa
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

import torch
import tyro
from lightning_fabric import Fabric
from lion_pytorch import Lion
from torch import Tensor, nn

from training.checkpoint import save_hfsq, start_from
from training.config import STRIDE, FrameConfig, HfsqConfig
from training.data.duet import Duet
from training.data.npz import read_solo
from training.data.sources import read_split
from training.evaluation.metrics import mean_report, quick_report
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.losses import stage1_loss
from training.hfsq.reconstruct import reconstruct
from training.hfsq.statistics import bins_used, set_input_statistics, set_latent_statistics
from training.hfsq.windows import Streams, Windows, training_clips
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
    solos = (
        [s for s in read_solo(options.solo) if s.name.startswith(options.solo_prefixes)]
        if options.solo
        else []
    )
    cutoff = options.hfsq.masking.cutoff if options.hfsq.masking else None
    clips = training_clips(duets.train, solos, options.tempos, options.frame, cutoff, options.window)
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
