"""Distils stage 2 into a student that samples in one pass: it learns what the teacher's whole sampling gives, from the
same noise (Luhman and Luhman 2021, Knowledge distillation in iterative generative models).

python -m training.distill --teacher runs/mine --data my-duets --val duo_3 --test duo_5 --out runs/student

The student is the teacher's network and begins with its weights; the condition encoder stays as it is. Every batch is
sampled by the teacher anew, so that none is learnt by heart.
"""

from __future__ import annotations

import copy
import json
from dataclasses import dataclass, replace
from pathlib import Path

import torch
from torch import Tensor, nn

from training.checkpoint import (
    copy_card,
    copy_stage1,
    earlier_training,
    load_model,
    save_denoiser,
    weights_digest,
)
from training.command_line import run_program
from training.config import STRIDE, DiffusionConfig, to_json
from training.denoiser.denoiser import Denoiser
from training.denoiser.windows import Batch, Windows
from training.diffusion.guidance import clamp_to_range
from training.diffusion.model import Model
from training.diffusion.sampler import extrapolated_ddim
from training.diffusion.schedule import Step, alphas_cumprod, ddim_steps
from training.loop.options import read_duets_to_train
from training.loop.run import Run, launch
from training.stage2 import PREPARING, ClipOptions, duet_clips, music_of, solo_clips, validate

LAYER_WEIGHTS = (1.0, 0.5)
"""Of the squared errors of the coarse layer, and of every finer one."""
MUSIC_WEIGHT = 12.0
"""Of the error in what the song changes, which the weight of the music multiplies (see `blend`)."""


@dataclass(frozen=True, kw_only=True)
class Options(ClipOptions):
    """out: the student's checkpoint, with the teacher's stage 1 and card."""

    teacher: Path
    """Checkpoint of the denoiser whose sampling is learnt, with its stage 1."""
    music_guidance: float | None = None
    """Default weight of the music for the student, which learns what the song changes a little too weak; the teacher's
    when left out."""
    learning_rate: float = 3e-4
    weight_decay: float = 0.0
    batch: int = 8

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.init is not None:
            raise ValueError("a student begins with the weights of --teacher, leave --init out")
        if self.out.resolve() == self.teacher.resolve():
            raise ValueError("--out is the folder of --teacher, whose denoiser would be overwritten")


def main(options: Options) -> None:
    fabric = launch(options)
    fabric.seed_everything(options.seed + fabric.global_rank, verbose=False)
    teacher = load_model(options.teacher)
    diffusion = student_diffusion(teacher.diffusion, options.music_guidance)
    network = teacher.denoiser
    duets = read_duets_to_train(options, fabric, STRIDE * network.config.block)
    fabric.print(PREPARING, flush=True)
    bank = music_of(options, duets)
    condition = network.config.condition
    clips = duet_clips(options, condition, duets, bank, teacher.hfsq, teacher.frame)
    clips += solo_clips(options, condition, teacher.hfsq, teacher.frame)
    windows = Windows(
        clips, network.config.block, network.condition.receptive_field, options.stride, condition
    )
    student = copy.deepcopy(network).requires_grad_(True)
    student.condition.requires_grad_(False)
    optimizer = torch.optim.AdamW(
        [parameter for parameter in student.parameters() if parameter.requires_grad],
        lr=options.learning_rate,
        weight_decay=options.weight_decay,
    )
    stage = Distillation(student, network, teacher.diffusion)
    before = earlier_training(options.teacher, "denoiser")
    begins_with = {
        "teacher": weights_digest(network),
        "sampling of the teacher": json.dumps(to_json(teacher.diffusion)),
    }
    run = Run(fabric, stage, student, optimizer, options, options.out / "distill", 50, begins_with)

    def finish() -> None:
        """Measure and save the averaged student."""
        with run.averaged() as averaged:
            model = Model(teacher.hfsq, teacher.frame, averaged, diffusion, teacher.reference_height)
            report = validate(model, bank, duets.val)
            run.logger.write(run.schedule, report)
            run.logger.draw()
            provenance = run.provenance("training.distill", leave_out=())
            provenance |= {"validation": report} | before
            save_denoiser(options.out, teacher.hfsq, averaged, diffusion, provenance)
            copy_stage1(options.teacher, options.out)
            copy_card(options.teacher, options.out)

    run.train(lambda random: windows.batch(options.batch, random), finish, finish)


def student_diffusion(teacher: DiffusionConfig, music_guidance: float | None) -> DiffusionConfig:
    """How a student of a teacher's sampling is sampled: in one step, and nothing is extrapolated, since what that gave
    has been learnt.
    """
    weight = teacher.music_guidance if music_guidance is None else music_guidance
    none = tuple(0.0 for _ in teacher.extrapolation)
    return replace(teacher, steps=1, extrapolation=none, music_guidance=weight)


class Distillation(nn.Module):
    """The student's errors against what the teacher samples, for the three branches that guidance blends."""

    extrapolation: Tensor

    def __init__(self, student: Denoiser, teacher: Denoiser, diffusion: DiffusionConfig) -> None:
        """teacher: frozen; diffusion: how it is sampled."""
        super().__init__()
        self.student = student
        self.teacher = teacher
        self.steps = ddim_steps(alphas_cumprod(diffusion), diffusion.steps, diffusion.last_time)
        self.register_buffer("extrapolation", torch.tensor(diffusion.extrapolation), persistent=False)

    def forward(self, batch: Batch) -> tuple[Tensor, dict[str, Tensor]]:
        # Dropout would be another network than the one that is sampled.
        self.student.eval()
        self.teacher.eval()
        n = len(batch.latents)
        memory, keep = self._branches(batch)
        valid = batch.valid.repeat(3, 1)
        noise = torch.randn_like(batch.latents).repeat(3, 1, 1, 1)
        with torch.no_grad():
            wanted = self._sample_teacher(noise, memory, valid, keep)
        # The student's one step begins where the teacher's first one does.
        error = predict(self.student, noise, memory, valid, keep, self.steps[0]) - wanted
        with_song, silent, unconditional = error.split(n)
        mean = WeightedSquares(valid, error.shape[2])
        parts = {
            "latents": mean(error),
            "speed": mean(error.diff(dim=1)),
            "music": MUSIC_WEIGHT * mean(with_song - silent),
            "conditions": mean(silent - unconditional),
        }
        return torch.stack(list(parts.values())).sum(), {k: v.detach() for k, v in parts.items()}

    @torch.no_grad()
    def _branches(self, batch: Batch) -> tuple[Tensor, Tensor]:
        """Memory (3 N, block, 2 D) and keep (3 N,) with leader and song, with the leader alone, and with neither."""
        block = batch.valid.shape[1]

        def memory(music: Tensor, music_valid: Tensor) -> Tensor:
            whole = self.teacher.condition(batch.features, music, music_valid, batch.role, batch.inside)
            margin = (whole.shape[1] - block) // 2
            return whole[:, margin : margin + block]

        with_song = memory(batch.music, batch.music_valid)
        silent = memory(torch.zeros_like(batch.music), torch.zeros_like(batch.music_valid))
        ones = torch.ones(len(batch.role), device=batch.role.device)
        return torch.cat([with_song, silent, silent]), torch.cat([ones, ones, ones * 0])

    def _sample_teacher(self, noise: Tensor, memory: Tensor, valid: Tensor, keep: Tensor) -> Tensor:
        """Latents (N, block, R, C) as `sample` gives them for single blocks, clamped as they are decoded."""
        return clamp_to_range(
            self.teacher,
            extrapolated_ddim(
                lambda x, step: predict(self.teacher, x, memory, valid, keep, step),
                noise,
                self.steps,
                self.extrapolation,
            ),
        )


def predict(network: Denoiser, x: Tensor, memory: Tensor, valid: Tensor, keep: Tensor, step: Step) -> Tensor:
    """x0 (N, block, R, C), clamped, of x with leader and song kept (N,) or not."""
    every = keep[:, None].expand(-1, network.layers)
    time = torch.full((len(x),), step.time, device=x.device)
    return clamp_to_range(network, network(x, time, memory, valid, every, every).float())


class WeightedSquares:
    """Mean squares of (N, L, R, C) over valid latent frames, the finer layers weighted less."""

    def __init__(self, valid: Tensor, layers: int) -> None:
        """valid: (M, block), the first N rows of which count for N latents."""
        coarse, fine = LAYER_WEIGHTS
        by_layer = torch.tensor([coarse, *[fine] * (layers - 1)], device=valid.device)
        self.weights = valid[:, :, None, None] * by_layer[:, None]

    def __call__(self, error: Tensor) -> Tensor:
        # A difference over time counts where both frames are valid: the later one, since padding comes last.
        weights = self.weights[: len(error), -error.shape[1] :]
        return (error.square() * weights).sum() / (weights.sum().clamp(min=1) * error.shape[-1])


if __name__ == "__main__":
    run_program(main, Options)
