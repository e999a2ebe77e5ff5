"""Trains stage 1, the HFSQ autoencoder (paper 3.2).

python -m training.train_hfsq --data my-duets --val duo_3 --test duo_5 --out runs/mine
"""

from __future__ import annotations

from dataclasses import dataclass, field

from lion_pytorch import Lion
from torch import Tensor, nn

from training.checkpoint import earlier_training, load_hfsq, save_hfsq, start_from, weights_digest
from training.command_line import run_program
from training.config import STREAMS, STRIDE, FrameConfig, HfsqConfig, StreamName, check_latent_frames
from training.data.duet import Duet
from training.data.npz import read_solo
from training.data.splits import Split
from training.evaluation.metrics import mean_report, quick_report
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.losses import stage1_loss
from training.hfsq.reconstruct import reconstruct
from training.hfsq.statistics import bins_used, set_input_statistics, set_latent_statistics
from training.hfsq.windows import Clip, Streams, Windows, training_clips
from training.loop.options import LoopOptions, read_duets_to_train
from training.loop.run import Run, launch


@dataclass(frozen=True, kw_only=True)
class Options(LoopOptions):
    """solo: dances whose bodies join the training of the upper and lower streams."""

    decoders: tuple[StreamName, ...] = ()
    """Train these streams' decoders alone. Latents stay, so a denoiser of the `init` checkpoint goes on fitting."""
    steps: int = 4000
    batch: int = 48
    window: int = 240
    """Frames; dances that are shorter at a tempo are left out there."""
    learning_rate: float = 3e-4
    weight_decay: float = 1e-3
    tempos: tuple[float, ...] = (0.9, 1.0, 1.1)
    """At which every duet is learnt, in times its own."""
    evaluate_every: int = 500
    hfsq: HfsqConfig = field(default_factory=HfsqConfig)
    frame: FrameConfig = field(default_factory=FrameConfig)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.decoders and self.init is None:
            raise ValueError("--decoders goes on with those of a checkpoint: name it with --init")
        if self.hfsq.quantiser == "none":
            raise ValueError(
                "--hfsq.quantiser none has nothing to learn: training.evaluation.no_latent_baseline writes it"
            )
        check_latent_frames("window", self.window)


def main(options: Options) -> None:
    fabric = launch(options)
    fabric.seed_everything(options.seed, verbose=False)
    duets = read_duets_to_train(options, fabric, options.window)
    clips = read_clips(options, duets)
    windows = Windows(clips, options.window)
    autoencoder = initial_autoencoder(options, clips)
    before = earlier_training(options.init, "hfsq")
    stage = Stage1(autoencoder, options.hfsq)
    trained = [p for p in stage.parameters() if p.requires_grad]
    optimizer = Lion(trained, lr=options.learning_rate, weight_decay=options.weight_decay)
    begins_with = {"--init": weights_digest(autoencoder)} if options.init else {}
    run = Run(fabric, stage, autoencoder, optimizer, options, options.out / "hfsq", 100, begins_with)

    def report() -> None:
        with run.averaged() as model:
            run.logger.write(run.schedule, evaluate(model, duets.val, options.frame))
            run.logger.draw()

    run.train(
        lambda random: windows.batch(options.batch, random),
        report,
        lambda: finish(run, clips, duets.val, options, before),
    )


def read_clips(options: Options, duets: Split) -> list[Clip]:
    """The clips to train on: duets, and solos where there are any."""
    solos = read_solo(options.solo, options.solo_prefixes) if options.solo else []
    cutoff = options.hfsq.masking.cutoff if options.hfsq.masking else None
    return training_clips(duets.train, solos, options.tempos, options.frame, cutoff, options.window)


def initial_autoencoder(options: Options, clips: list[Clip]) -> Autoencoder:
    """Random weights with the clips' statistics, or those of another checkpoint.

    Raises ValueError where that one was quantised in another way.
    """
    autoencoder = Autoencoder(options.hfsq)
    if options.init:
        before = load_hfsq(options.init)[0].config
        for name in ("levels", "scales"):
            there, here = getattr(before, name), getattr(options.hfsq, name)
            if there != here:
                raise ValueError(f"--init was trained with --hfsq.{name} {there}, not {here}")
        start_from(autoencoder, options.init, "hfsq")
    else:
        set_input_statistics(autoencoder, clips)
    if options.decoders:
        autoencoder.requires_grad_(False)
        for name, stream in zip(STREAMS, autoencoder.each, strict=True):
            stream.decoder.requires_grad_(name in options.decoders)
    return autoencoder


class Stage1(nn.Module):
    """The loss as a module, so that distributed training sees one forward pass."""

    def __init__(self, model: Autoencoder, config: HfsqConfig) -> None:
        super().__init__()
        self.model, self.config = model, config

    def forward(self, batch: tuple[Streams, Streams]) -> tuple[Tensor, dict[str, Tensor]]:
        motions, slow = batch
        return stage1_loss(self.model, motions, slow, self.config)


def evaluate(model: Autoencoder, duets: tuple[Duet, ...], frame: FrameConfig) -> dict[str, float]:
    """Mean reconstruction errors over duets, of all layers and of the coarse layer alone."""
    rows: list[dict[str, float]] = []
    for duet in duets:
        frames = len(duet) // STRIDE * STRIDE
        row: dict[str, float] = {}
        for name, layers in (("all", None), ("coarse", 1)):
            motion = reconstruct(model, duet, frame, layers)
            report = quick_report(duet.leader[:frames], duet.reactor[:frames], motion)
            row |= {f"val/{name}/{k}": report[k] for k in ("mpjpe_mm", "root_error_mm", "speed_ratio")}
        rows.append(row)
    return mean_report(rows)


def finish(
    run: Run[Autoencoder], clips: list[Clip], val: tuple[Duet, ...], options: Options, before: dict
) -> None:
    """Measure and save the averaged autoencoder with the statistics of its latents. before: `earlier_training`."""
    with run.averaged() as model:
        if not options.decoders:
            set_latent_statistics(model, clips)
        report = evaluate(model, val, options.frame)
        if options.hfsq.quantiser == "hfsq":
            report |= {f"bins/{i}": share for i, share in enumerate(bins_used(model, clips))}
        run.logger.write(run.schedule, report)
        run.logger.draw()
        provenance = run.provenance("training.train_hfsq", leave_out=("hfsq", "frame"))
        save_hfsq(options.out, model, options.frame, provenance | {"validation": report} | before)


if __name__ == "__main__":
    run_program(main, Options)
