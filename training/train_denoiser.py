"""Stage 2: train the denoiser on the latents of a frozen HFSQ (paper 3.3 to 3.5).

python -m training.train_denoiser --data ../shared/data/cmu_salsa/duets.npz --out runs/salsa
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

import numpy as np
import torch
import tyro
from lightning_fabric import Fabric
from torch import Tensor, nn

from training.checkpoint import load_hfsq, save_denoiser, start_from, write_first_card
from training.config import STRIDE, DenoiserConfig, DenoiserLossConfig, DiffusionConfig
from training.data.music_pairing import MusicBank, build_music_bank, variants
from training.data.npz import read_solo
from training.data.sources import read_split
from training.denoiser.condition import condition_keeps
from training.denoiser.denoiser import Denoiser
from training.denoiser.losses import motion_loss, noise_weights, simple_loss
from training.denoiser.windows import Augmentation, Batch, Windows, augmented_clips, improvised_clips
from training.diffusion.sampler import Model, react
from training.diffusion.schedule import add_noise, alphas_cumprod, training_times
from training.evaluation.metrics import mean_report, quick_report
from training.hfsq.autoencoder import Autoencoder
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
from training.motion.skeleton import as_body, body_height
from training.motion.streams import from_streams


@dataclass(frozen=True)
class Options:
    data: Path
    """Duets: an npz archive, a DD100 root, or a folder of paired BVH files (see training/data/sources.py)."""
    out: Path
    """Folder with stage 1's checkpoint; stage 2's goes beside it."""
    init: Path | None = None
    """Start from the denoiser of this checkpoint; stage 1 must have the same latents (see train_hfsq)."""
    songs: Path | None = None
    """Folder of songs to pair with duets that have none; without it the synthesiser plays alone."""
    music_cache: Path | None = None
    """Folder in which music features are kept between runs."""
    solo: Path | None = None
    """npz archive of solo dances, of which pairs are improvised (see training/data/solo_pairs.py)."""
    solo_prefixes: tuple[str, ...] = ("indian", "modern")
    """Names that these solos begin with; the others are kept for leaders from elsewhere."""
    improvised: int = 1
    """Pairs of every solo dance and of its mirror image."""
    val: tuple[str, ...] = ("salsa_03",)
    test: tuple[str, ...] = ("salsa_05", "salsa_11")
    """Names of duets that are never trained on, nor used to choose anything."""
    steps: int = 6000
    minutes: float | None = None
    """Stop after this time even if the steps are not done; the learning rate follows whichever comes first.
    """
    batch: int = 32
    stride: int = 4
    """Frames between training windows (the paper's Table 6)."""
    learning_rate: float = 5e-4
    weight_decay: float = 0.02
    average: float = 0.998
    synths: int = 3
    pieces: int = 2
    """Synthesised pieces and songs per duet and tempo."""
    seed: int = 0
    devices: int = 1
    threads: int = 0
    """CPU threads for torch, 0 leaves its default."""
    precision: Precision | None = None
    """Left out: bf16 where its products are fast, single elsewhere."""
    log_every: int = 50
    evaluate_every: int = 600
    resume: bool = False
    denoiser: DenoiserConfig = field(default_factory=DenoiserConfig)
    diffusion: DiffusionConfig = field(default_factory=DiffusionConfig)
    loss: DenoiserLossConfig = field(default_factory=DenoiserLossConfig)
    augmentation: Augmentation = field(default_factory=Augmentation)


class Stage2(nn.Module):
    """Eq. 7 as a module, so that distributed training sees one forward pass. The HFSQ inside is frozen."""

    alpha_bar: Tensor

    def __init__(
        self, denoiser: Denoiser, hfsq: Autoencoder, diffusion: DiffusionConfig, loss: DenoiserLossConfig
    ):
        super().__init__()
        self.denoiser, self.loss = denoiser, loss
        self.hfsq = hfsq.requires_grad_(False).eval()
        self.steps = diffusion.train_steps
        self.register_buffer(
            "alpha_bar", torch.from_numpy(alphas_cumprod(diffusion)).float(), persistent=False
        )

    def forward(self, batch: Batch) -> tuple[Tensor, dict[str, Tensor]]:
        truth = batch.latents
        n, block, layers, _ = truth.shape
        times = training_times(n, self.steps, truth.device)
        signal = self.alpha_bar[times]
        noisy = add_noise(truth, torch.randn_like(truth), signal)
        memory = self.denoiser.condition(
            batch.features, batch.music, batch.music_valid, batch.role, batch.inside
        )
        margin = (memory.shape[1] - block) // 2
        keep_leader, keep_music = (
            k.to(truth.device) for k in condition_keeps(n, layers, self.denoiser.config.condition)
        )
        predicted = self.denoiser(
            noisy,
            times / self.steps,
            memory[:, margin : margin + block],
            batch.valid,
            keep_leader,
            keep_music,
        ).float()
        total, by_layer = simple_loss(
            truth, predicted, batch.valid, self.loss.layers, noise_weights(signal, self.loss.snr)
        )
        parts = {f"simple/{r}": value for r, value in enumerate(by_layer)}
        # training_times is sorted: the first windows have the least noise. Short windows have no motion to
        # compare.
        clean = [i for i in range(self.loss.windows) if batch.valid[i].min() > 0]
        if clean:
            terms = motion_loss(
                batch.leader[clean],
                batch.reactor[clean],
                self.motion(predicted[clean], batch, clean),
                signal[clean],
                self.loss,
            )
            total = total + torch.stack(list(terms.values())).sum()
            parts |= {name: value.detach() for name, value in terms.items()}
        return total, parts

    def motion(self, latents: Tensor, batch: Batch, rows: list[int]) -> Tensor:
        """World joints (n, T, 22, 3) of normalised latents (n, block, R, C) for those rows of the batch."""
        decoded = self.hfsq.decode(self.hfsq.denormalise(latents))
        upper, lower, placement = (s.float().flatten(0, 1) for s in decoded)
        leader, heading = batch.leader[rows].flatten(0, 1), batch.heading[rows].flatten(0, 1)
        joints = from_streams(upper, lower, placement, leader, heading)
        # Feet may sink here: were they held up, sinking them would be the cheapest way to keep them still.
        return as_body(joints.unflatten(0, (len(rows), -1)), floor=False)


def validate(
    model: Model, options: Options, bank: MusicBank, duets: tuple, seeds: int = 2
) -> dict[str, float]:
    """Mean quick report over the validation duets and seeds, default steps and guidance."""
    rows = []
    for duet in duets:
        frames = len(duet) // STRIDE * STRIDE
        music = next(iter(bank[duet.name].values()))
        for seed in range(seeds):
            made = react(model, duet.leader[:frames], music[:frames], seed)
            rows.append(quick_report(duet.leader[:frames], duet.reactor[:frames], made))
    return {f"val/{k}": value for k, value in mean_report(rows).items()}


def set_feature_statistics(denoiser: Denoiser, clips: list) -> None:
    """Mean and standard deviation of leader and music features, from training clips."""
    for patches, values in (
        (denoiser.condition.leader, torch.cat([c.features for c in clips])),
        (denoiser.condition.music, torch.cat([m for c in clips for m in c.music])),
    ):
        patches.mean.copy_(values.mean(0))
        patches.std.copy_(values.std(0).clamp_min(1e-3))


def main(options: Options) -> None:
    options = replace(options, precision=options.precision or fast_precision())
    if options.threads:
        torch.set_num_threads(options.threads)
    fabric = Fabric(accelerator="auto", devices=options.devices, precision=options.precision)
    fabric.launch()
    fabric.seed_everything(options.seed + fabric.global_rank, verbose=False)

    hfsq, frame = load_hfsq(options.out)
    duets = read_split(options.data, options.val, options.test)
    wanted = variants(options.augmentation.tempos, options.synths, options.pieces if options.songs else 0)
    bank = build_music_bank(duets, options.songs, wanted, cache_dir=options.music_cache)
    clips = augmented_clips(
        duets.train, bank, hfsq, frame, options.augmentation, options.denoiser.condition, options.seed
    )

    torch.manual_seed(options.seed)  # the same initial weights on every rank
    denoiser = Denoiser(hfsq.latent_width, hfsq.layers, options.denoiser)
    if options.init:
        start_from(denoiser, options.init, "denoiser")
    else:
        set_feature_statistics(denoiser, clips)
    denoiser.lowest, denoiser.highest = hfsq.latent_range()
    if options.solo is not None:
        solos = [s for s in read_solo(options.solo) if s.name.startswith(options.solo_prefixes)]
        clips += improvised_clips(
            solos, options.improvised, hfsq, frame, options.denoiser.condition, options.seed
        )
    torch.manual_seed(options.seed + 1 + fabric.global_rank)
    windows = Windows(
        clips, options.denoiser.block, denoiser.condition.receptive_field, options.stride,
        options.denoiser.condition, options.seed * 1000 + fabric.global_rank,
    )  # fmt: skip
    stage = Stage2(denoiser, hfsq, options.diffusion, options.loss)
    optimizer = torch.optim.AdamW(
        denoiser.parameters(), lr=options.learning_rate, weight_decay=options.weight_decay
    )
    average = Average(denoiser, options.average)
    average.module.to(fabric.device)
    stage, optimizer = fabric.setup(stage, optimizer)
    budget = Budget(options.steps, options.minutes)
    journal = Journal(options.out / "denoiser", fabric.is_global_zero)
    state = options.out / "denoiser" / "state.ckpt"
    if options.resume:
        load_state(fabric, state, stage, optimizer, average, budget)

    provenance = {
        "program": "training.train_denoiser",
        "options": {k: str(v) for k, v in asdict(options).items() if k not in ("denoiser", "diffusion")},
    }
    reference_height = float(np.mean([body_height(d.leader) for d in duets.train]))

    def finish() -> None:
        """Measure and save the averaged model."""
        if not fabric.is_global_zero:
            return
        model = Model(hfsq.cpu(), frame, average.module.cpu(), options.diffusion)
        report = validate(model, options, bank, duets.val)
        journal.write(budget, report)
        journal.draw()
        facts = {"steps": budget.step, "minutes": round(budget.spent / 60, 1), "validation": report}
        save_denoiser(options.out, model.denoiser, options.diffusion, provenance | facts)
        write_first_card(options.out, reference_height)
        hfsq.to(fabric.device)
        average.module.to(fabric.device)

    while budget.progress < 1:
        denoiser.train()
        for group in optimizer.param_groups:
            group["lr"] = learning_rate(options.learning_rate, budget, warmup=200)
        loss, parts = stage(fabric.to_device(windows.batch(options.batch)))
        fabric.backward(loss)
        fabric.clip_gradients(stage, optimizer, max_norm=1.0)
        optimizer.step()
        optimizer.zero_grad()
        average.update(denoiser)
        budget.tick()
        budget.spent = fabric.broadcast(budget.spent)  # one clock for all ranks: it sets the learning rate
        journal.add(parts)
        if budget.step % options.log_every == 0:
            journal.write(budget)
        if budget.step % options.evaluate_every == 0:
            save_state(fabric, state, stage, optimizer, average, budget)
            finish()
    finish()
    fabric.barrier()


if __name__ == "__main__":
    main(tyro.cli(Options))
