"""Trains stage 2, the denoiser, on the latents of a frozen HFSQ (paper 3.3 to 3.5).

python -m training.train_denoiser --data my-duets --val duo_3 --test duo_5 --out runs/mine
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import torch
from torch import Tensor, nn

from training.checkpoint import (
    earlier_training,
    latents_digest,
    load_hfsq,
    save_denoiser,
    start_from,
    weights_digest,
    write_card,
)
from training.command_line import run_program
from training.config import STRIDE, DenoiserConfig, DenoiserLossConfig, DiffusionConfig
from training.denoiser.clips import Clip, feature_values
from training.denoiser.condition import condition_dropout
from training.denoiser.denoiser import Denoiser
from training.denoiser.losses import decoded_windows, motion_loss, noise_weights, simple_loss
from training.denoiser.windows import Batch, Windows
from training.diffusion.body import mean_bodies, set_bodies
from training.diffusion.model import Model
from training.diffusion.react import at_height
from training.diffusion.schedule import add_noise, alphas_cumprod, ddim_steps, stratified_timesteps
from training.hfsq.autoencoder import Autoencoder
from training.loop.options import read_duets_to_train
from training.loop.run import Run, launch
from training.motion.skeleton import body_height
from training.stage2 import PREPARING, ClipOptions, duet_clips, music_of, solo_clips, validate

UNFAMILIAR_RATIO = 1.15
"""How much farther from the mean of training than any leader of training an unfamiliar leader is."""


@dataclass(frozen=True, kw_only=True)
class Options(ClipOptions):
    """out: with stage 1's checkpoint in it; init: of a denoiser for the same latents (see train_hfsq)."""

    denoiser: DenoiserConfig = field(default_factory=DenoiserConfig)
    diffusion: DiffusionConfig = field(default_factory=DiffusionConfig)
    loss: DenoiserLossConfig = field(default_factory=DenoiserLossConfig)

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.loss.layers) != len(self.denoiser.depths):
            raise ValueError(
                f"{len(self.denoiser.depths)} residual layers (--denoiser.depths) need as many --loss.layers, "
                f"got {self.loss.layers}"
            )
        if self.loss.windows > self.batch:
            raise ValueError(
                f"a batch of {self.batch} windows has no {self.loss.windows} to decode (--loss.windows)"
            )
        # Sampling would refuse these only after the training.
        ddim_steps(alphas_cumprod(self.diffusion), self.diffusion.steps, self.diffusion.last_time)


def main(options: Options) -> None:
    fabric = launch(options)
    fabric.seed_everything(options.seed + fabric.global_rank, verbose=False)
    hfsq, frame = load_hfsq(options.out)
    begins_with = {"stage 1": latents_digest(hfsq)}
    torch.manual_seed(options.seed)  # the same initial weights on every rank
    # Before data and music are read, which takes minutes: both refuse another number of layers than stage 1 has.
    denoiser = Denoiser(hfsq.latent_width, hfsq.layers, options.denoiser)
    stage = Stage2(denoiser, hfsq, options.diffusion, options.loss)
    duets = read_duets_to_train(options, fabric, STRIDE * options.denoiser.block)
    fabric.print(PREPARING, flush=True)
    bank = music_of(options, duets)
    condition = options.denoiser.condition
    clips = duet_clips(options, condition, duets, bank, hfsq, frame)
    begin_with(denoiser, options, hfsq, clips)
    if options.init:
        begins_with["--init"] = weights_digest(denoiser)
    before = earlier_training(options.init, "denoiser")
    clips += solo_clips(options, condition, hfsq, frame)
    windows = Windows(
        clips, options.denoiser.block, denoiser.condition.receptive_field, options.stride, condition
    )
    optimizer = torch.optim.AdamW(
        denoiser.parameters(), lr=options.learning_rate, weight_decay=options.weight_decay
    )
    run = Run(fabric, stage, denoiser, optimizer, options, options.out / "denoiser", 200, begins_with)
    height, reactor_height = (
        float(np.mean([body_height(getattr(d, role)) for d in duets.train])) for role in ("leader", "reactor")
    )
    leaders, reactors = [d.leader for d in duets.train], [d.reactor for d in duets.train]
    training_bodies = mean_bodies(leaders, reactors, height)

    def finish() -> None:
        """Measure and save the averaged denoiser."""
        with run.averaged() as averaged:
            model = Model(hfsq.cpu(), frame, averaged, options.diffusion, height)
            set_bodies(model, leaders, reactors)
            report = validate(model, bank, duets.val)
            run.logger.write(run.schedule, report)
            run.logger.draw()
            provenance = run.provenance("training.train_denoiser", leave_out=("denoiser", "diffusion"))
            provenance |= {"validation": report} | before
            save_denoiser(options.out, hfsq, averaged, options.diffusion, provenance)
            known = max(float(model.unfamiliarity(at_height(leader, height)).mean()) for leader in leaders)
            write_card(options.out, height, reactor_height, training_bodies, UNFAMILIAR_RATIO * known)
        hfsq.to(fabric.device)

    run.train(lambda random: windows.batch(options.batch, random), finish, finish)


def begin_with(denoiser: Denoiser, options: Options, hfsq: Autoencoder, clips: list[Clip]) -> None:
    """Gives a denoiser the statistics of clips, or the weights of another checkpoint, and its range of latents."""
    if options.init:
        start_from(denoiser, options.init, "denoiser")
    else:
        denoiser.condition.set_statistics(*feature_values(clips))
    denoiser.lowest, denoiser.highest = hfsq.latent_range()


class Stage2(nn.Module):
    """Eq. 7 as a module, so that distributed training sees one forward pass. The HFSQ inside is frozen."""

    alpha_bar: Tensor

    def __init__(
        self, denoiser: Denoiser, hfsq: Autoencoder, diffusion: DiffusionConfig, loss: DenoiserLossConfig
    ):
        """Raises ValueError where the loss has another number of weights than there are residual layers."""
        super().__init__()
        if len(loss.layers) != hfsq.layers:
            raise ValueError(
                f"stage 1 has {hfsq.layers} residual layers, so --loss.layers needs as many weights, got {loss.layers}"
            )
        self.denoiser, self.loss = denoiser, loss
        self.hfsq = hfsq.requires_grad_(False).eval()
        self.steps = diffusion.train_steps
        self.register_buffer(
            "alpha_bar", torch.from_numpy(alphas_cumprod(diffusion)).float(), persistent=False
        )

    def forward(self, batch: Batch) -> tuple[Tensor, dict[str, Tensor]]:
        truth = batch.latents
        n, block, layers, _ = truth.shape
        times = stratified_timesteps(n, self.steps, truth.device)
        signal = self.alpha_bar[times]
        noisy = add_noise(truth, torch.randn_like(truth), signal)
        memory = self.denoiser.condition(
            batch.features, batch.music, batch.music_valid, batch.role, batch.inside
        )
        margin = (memory.shape[1] - block) // 2
        keep_leader, keep_music = (
            k.to(truth.device) for k in condition_dropout(n, layers, self.denoiser.config.condition)
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
        # stratified_timesteps is sorted: the first windows have the least noise. Short windows have no motion to
        # compare.
        clean = [i for i in range(self.loss.windows) if batch.valid[i].min() > 0]
        if clean:
            terms = motion_loss(
                batch.leader[clean],
                batch.reactor[clean],
                decoded_windows(self.hfsq, predicted[clean], batch, clean),
                signal[clean],
                self.loss,
            )
            total = total + torch.stack(list(terms.values())).sum()
            parts |= {name: value.detach() for name, value in terms.items()}
        return total, parts


if __name__ == "__main__":
    run_program(main, Options)
