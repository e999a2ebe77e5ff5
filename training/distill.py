"""Distil the denoiser of stage 2 into a student that needs one pass a step and two steps.

python -m training.distill --data my-duets --val duo_3 --test duo_5 --out runs/mine

The student has the denoiser's inputs and starts from its weights. It learns the latents that the denoiser reaches
from a noise in many steps, by regression (Luhman and Luhman 2021, Knowledge Distillation in Iterative Generative
Models), for the three branches that guidance after sampling blends.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
import torch
import tyro
from torch import Tensor, nn

from training.checkpoint import load_model, save_student, start_from
from training.config import STRIDE, DenoiserLossConfig, DiffusionConfig
from training.data.duet import Duet
from training.data.music_pairing import MusicBank
from training.data.sources import read_split
from training.denoiser.dataset import DatasetOptions, duet_clips, music_of, solo_clips
from training.denoiser.denoiser import Denoiser
from training.denoiser.losses import motion_loss
from training.denoiser.windows import Windows
from training.diffusion.blocks import gather, partition, scatter
from training.diffusion.guidance import Branches, blend, clamp_to_range
from training.diffusion.model import Model
from training.diffusion.react import Request, react
from training.diffusion.schedule import Step, alphas_cumprod, ddim_steps
from training.evaluation.metrics import mean_report, quick_report
from training.evaluation.metrics.speed import joint_acceleration
from training.hfsq.autoencoder import Autoencoder
from training.loop import Run, launch
from training.motion.rigid_body import rigid_body
from training.motion.streams import from_streams


@dataclass(frozen=True)
class DistillLossConfig:
    layers: tuple[float, float] = (1.0, 0.5)  # coarse, fine
    change: float = 0.5  # weight of the latents' difference over time
    blend: float = 0.5  # weight of the error of randomly blended branches
    coarse: tuple[float, float] = (-1.0, 1.0)  # ranges of the weights that they are blended with
    music: tuple[float, float] = (0.0, 6.0)
    windows: int = 2  # of a batch that are decoded for the losses on motion
    motion: DenoiserLossConfig = field(default_factory=DenoiserLossConfig)


@dataclass(frozen=True, kw_only=True)
class Options(DatasetOptions):
    """out: with the checkpoint of both stages in it; init: of a student."""

    steps: int = 2000
    batch: int = 6
    blocks: int = 3
    """Blocks of a window: neighbours whose boundaries the second step sees."""
    stride: int = 4
    """Frames between training windows."""
    pool: int = 256
    """Windows sampled by the denoiser that are kept at a time."""
    fresh: int = 2
    """New windows a batch; each takes the place of the oldest, so none is learnt by heart."""
    learning_rate: float = 3e-4
    weight_decay: float = 0.0
    evaluate_every: int = 200
    teacher_steps: int = 5
    student: DiffusionConfig | None = None
    """How the student is sampled; by default as the denoiser, in two steps with alternating partitions."""
    loss: DistillLossConfig = field(default_factory=DistillLossConfig)


class Sampled(NamedTuple):
    """N windows with what the denoiser makes of them; L latent frames of whole blocks."""

    memory: Tensor  # (N, L, 2 D) of leader and song
    silent: Tensor  # (N, L, 2 D) of the leader alone
    valid: Tensor  # (N, L)
    noise: Tensor  # (N, L, R, C)
    targets: Tensor  # (3, N, L, R, C): conditional, silent, unconditional
    leader: Tensor  # (N, 4 L, 22, 3)
    heading: Tensor  # (N, 4 L, 2)


KEEP = (1.0, 1.0, 0.0)  # of the three branches: whether the conditions are kept


def run_step(
    denoiser: Denoiser, step: Step, sampled: Sampled, states: Tensor, shifted: bool
) -> tuple[Tensor, Tensor]:
    """One step of all three branches (3, N, L, R, C): the next states and the predictions x0, not clamped."""
    frames, size = states.shape[2], denoiser.config.block
    blocks = partition(frames, size, shifted)

    def cut(values: Tensor) -> Tensor:
        """(N, L, ...) to (B N, block, ...)."""
        return gather(values.transpose(0, 1), blocks, size).transpose(1, 2).flatten(0, 1)

    def join(values: Tensor) -> Tensor:
        """(B N, block, ...) back to (N, L, ...)."""
        return scatter(values.unflatten(0, (len(blocks), -1)).transpose(1, 2), blocks, frames).transpose(0, 1)

    x = torch.cat([cut(state) for state in states])
    leader_and_song, leader_alone = cut(sampled.memory), cut(sampled.silent)
    memory = torch.cat([leader_and_song, leader_alone, leader_alone])
    valid = cut(sampled.valid).repeat(3, 1)
    keep = torch.tensor(KEEP).repeat_interleave(len(leader_alone))[:, None].expand(-1, denoiser.layers)
    keep = keep.to(x.device)
    time = torch.tensor([step.time], dtype=torch.float32, device=x.device)
    x0 = denoiser(x, time, memory, valid, keep, keep)
    following = step.a * x + step.b * clamp_to_range(denoiser, x0)
    return tuple(torch.stack([join(part) for part in values.chunk(3)]) for values in (following, x0))  # type: ignore


class Teacher:
    """Windows of training clips, each sampled by the denoiser in all three branches."""

    def __init__(self, model: Model, windows: Windows, steps: int) -> None:
        self.denoiser, self.windows = model.denoiser, windows
        self.schedule = ddim_steps(alphas_cumprod(model.diffusion), steps)

    @torch.no_grad()
    def sample(self, n: int) -> Sampled:
        batch = self.windows.batch(n)
        margin = self.windows.margin
        encode = self.denoiser.condition
        memory, silent = (
            encode(batch.features, batch.music, heard, batch.role, batch.inside)[:, margin:-margin]
            for heard in (batch.music_valid, torch.zeros_like(batch.music_valid))
        )
        noise = torch.randn_like(batch.latents)
        states = noise.expand(3, *noise.shape)
        sampled = Sampled(memory, silent, batch.valid, noise, states, batch.leader, batch.heading)
        for step in self.schedule:
            states, _ = run_step(self.denoiser, step, sampled, states, shifted=False)
        return sampled._replace(targets=states)


class Pool:
    """The last so many windows of a teacher; a batch is drawn from them, and a few are renewed each time."""

    def __init__(self, teacher: Teacher, size: int, fresh: int, batch: int, seed: int) -> None:
        self.teacher, self.size, self.fresh, self.batch = teacher, size, fresh, batch
        self.windows: list[Sampled] = []
        self.random = np.random.default_rng(seed)

    def next(self) -> Sampled:
        missing = self.batch - len(self.windows)
        made = self.teacher.sample(max(self.fresh, missing))
        count = len(made.valid)
        self.windows += [
            Sampled(*(v[:, i] if name == "targets" else v[i] for name, v in made._asdict().items()))
            for i in range(count)
        ]
        self.windows = self.windows[-self.size :]
        chosen = [self.windows[i] for i in self.random.choice(len(self.windows), self.batch, replace=False)]
        return Sampled(
            *(
                torch.stack(values, dim=1 if name == "targets" else 0)
                for name, values in zip(Sampled._fields, zip(*chosen, strict=True), strict=True)
            )
        )


class Distillation(nn.Module):
    """The student's loss on windows of the pool."""

    def __init__(
        self, student: Denoiser, hfsq: Autoencoder, diffusion: DiffusionConfig, loss: DistillLossConfig
    ) -> None:
        super().__init__()
        self.student, self.loss = student, loss
        self.hfsq = hfsq.requires_grad_(False).eval()
        self.alternating = diffusion.alternating_phase
        self.schedules = [ddim_steps(alphas_cumprod(diffusion), n) for n in (2, 4)]

    def forward(self, sampled: Sampled) -> tuple[Tensor, dict[str, Tensor]]:
        """Every step learns the teacher's last latents from where the student's own steps before have led."""
        # Two steps are what ships; a fifth of the batches keeps four steps possible.
        schedule = self.schedules[int(torch.rand(()) < 0.2)]
        states = sampled.noise.expand(3, *sampled.noise.shape)
        total = states.new_zeros(())
        parts: dict[str, Tensor] = {}
        coarse, music = self.random_weights(sampled)
        target = blend(Branches(*sampled.targets), coarse, music)
        for k, step in enumerate(schedule):
            states, x0 = run_step(
                self.student, step, sampled, states.detach(), self.alternating and k % 2 == 1
            )
            error = self.error(x0, sampled.targets, sampled.valid)
            mixed = blend(Branches(*x0), coarse, music)
            blended = self.error(mixed, target, sampled.valid)
            total = total + (error.sum() + self.loss.blend * blended.sum()) / len(schedule)
            name = f"{len(schedule)}/{k}"
            parts |= {f"{name}/coarse": error[0], f"{name}/fine": error[1], f"{name}/blend": blended.sum()}
        whole = [i for i in range(len(sampled.valid)) if sampled.valid[i].min() > 0][: self.loss.windows]
        if whole:
            with torch.no_grad():
                truth = self.motion(target[whole], sampled, whole)
            terms = motion_loss(
                sampled.leader[whole],
                truth,
                self.motion(mixed[whole], sampled, whole),
                truth.new_ones(len(whole)),
                self.loss.motion,
            )
            total = total + torch.stack(list(terms.values())).sum()
            parts |= terms
        return total, {name: value.detach() for name, value in parts.items()}

    def error(self, x0: Tensor, target: Tensor, valid: Tensor) -> Tensor:
        """(R,) weighted squared errors of latents (..., N, L, R, C) and of their difference over time."""
        difference = x0 - target
        still = masked_mean(difference, valid)
        moving = masked_mean(difference.diff(dim=-3), valid[:, 1:] * valid[:, :-1])
        return (still + self.loss.change * moving) * still.new_tensor(self.loss.layers)

    def random_weights(self, sampled: Sampled) -> tuple[Tensor, Tensor]:
        """Weights of coarse (N, 1, 1) and of the song (N, 1, 1, 1)."""
        n = len(sampled.valid)
        (c0, c1), (m0, m1) = self.loss.coarse, self.loss.music
        coarse = c0 + (c1 - c0) * torch.rand(n, 1, 1)
        music = m0 + (m1 - m0) * torch.rand(n, 1, 1, 1)
        return coarse.to(sampled.noise), music.to(sampled.noise)

    def motion(self, latents: Tensor, sampled: Sampled, rows: list[int]) -> Tensor:
        """World joints (n, T, 22, 3) of normalised latents (n, L, R, C) of those windows."""
        latents = clamp_to_range(self.student, latents)
        upper, lower, placement = (s.flatten(0, 1) for s in self.hfsq.decode(self.hfsq.denormalise(latents)))
        leader, heading = sampled.leader[rows].flatten(0, 1), sampled.heading[rows].flatten(0, 1)
        joints = from_streams(upper, lower, placement, leader, heading)
        return rigid_body(joints.unflatten(0, (len(rows), -1)), floor=False)


def masked_mean(values: Tensor, valid: Tensor) -> Tensor:
    """(R,) mean square of values (..., N, L, R, C) where valid (N, L) is 1."""
    squared = values.square().mean(-1) * valid[..., None]
    return squared.flatten(0, -2).sum(0) / valid.expand(values.shape[:-2]).sum()


def main(options: Options) -> None:
    fabric = launch(options)
    fabric.seed_everything(options.seed + fabric.global_rank, verbose=False)
    model = load_model(options.out)
    diffusion = options.student or replace(model.diffusion, steps=2, max_steps=4, alternating_phase=True)
    duets = read_split(options.data, options.val, options.test)
    bank = music_of(options, duets)
    config = model.denoiser.config
    clips = duet_clips(options, duets, bank, model.hfsq, model.frame, config.condition)
    clips += solo_clips(options, model.hfsq, model.frame, config.condition)
    torch.manual_seed(options.seed + 1 + fabric.global_rank)
    windows = Windows(
        clips, options.blocks * config.block, model.denoiser.condition.receptive_field, options.stride,
        config.condition, options.seed * 1000 + fabric.global_rank,
    )  # fmt: skip
    teacher = Teacher(model, windows, options.teacher_steps)
    pool = Pool(teacher, options.pool, options.fresh, options.batch, options.seed)
    student = initial_student(options, model)
    trained = [p for p in student.parameters() if p.requires_grad]
    optimizer = torch.optim.AdamW(trained, lr=options.learning_rate, weight_decay=options.weight_decay)
    stage = Distillation(student, model.hfsq, diffusion, options.loss)
    run = Run(fabric, stage, student, optimizer, options, options.out / "student", warmup=50)

    def finish() -> None:
        """Measure and save the averaged student."""
        with run.averaged() as averaged:
            report = validate(replace(model, denoiser=averaged, diffusion=diffusion), bank, duets.val)
            run.logger.write(run.schedule, report)
            run.logger.draw()
            provenance = run.provenance("training.distill", leave_out=("student",))
            save_student(options.out, averaged, diffusion, provenance | {"validation": report})

    run.train(pool.next, finish)
    if fabric.is_global_zero:
        finish()
    fabric.barrier()


def initial_student(options: Options, model: Model) -> Denoiser:
    """The denoiser without dropout, its encoder of leader and song frozen; or the student of another checkpoint."""
    student = Denoiser(
        model.denoiser.latent_width, model.denoiser.layers, replace(model.denoiser.config, dropout=0.0)
    )
    if options.init:
        start_from(student, options.init, "student")
    else:
        student.load_state_dict(model.denoiser.state_dict())
    student.condition.requires_grad_(False)
    return student


def validate(model: Model, bank: MusicBank, duets: Sequence[Duet], seeds: int = 2) -> dict[str, float]:
    """Mean quick report and acceleration over the validation duets and seeds."""
    rows = []
    for duet in duets:
        frames = len(duet) // STRIDE * STRIDE
        leader, truth = duet.leader[:frames], duet.reactor[:frames]
        music = next(iter(bank[duet.name].values()))
        for seed in range(seeds):
            made = react(model, Request(leader, music[:frames], seed))
            acceleration = joint_acceleration(made) / joint_acceleration(truth)
            rows.append(quick_report(leader, truth, made) | {"acceleration_ratio": acceleration})
    return {f"val/{k}": value for k, value in mean_report(rows).items()}


if __name__ == "__main__":
    main(tyro.cli(Options))
