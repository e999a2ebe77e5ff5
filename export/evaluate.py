"""Measure a model on held-out duets: exported graphs under onnxruntime, or a checkpoint under PyTorch.

    python -m export.evaluate --model web/public/models/mine --checkpoint runs/mine \
        --data my-duets --val duo_3 --test duo_5 --out runs/report \
        --out-of-distribution solo.npz --solve \
        --settings.phase-seeds 16 --settings.guidance-grid 0 0.5 1.2 --settings.controls

With a model folder its graphs are measured, and the checkpoint, if given, adds the rows of its autoencoder; with a
checkpoint alone it is measured under PyTorch. With --solve leaders are given to it as on the page, in the bodies of the
training.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import torch
from rich.console import Console

from export.node import SOLVERS, in_training_bodies
from export.runtime import open_model
from training.checkpoint import duets_seen, load_model, read_card, solos_seen
from training.command_line import run_program
from training.config import STRIDE, check_limits
from training.data.bvh.file import FRAME_RATES
from training.data.music_pairing import Variant, build_music_bank
from training.data.sources import read_split
from training.data.splits import Split
from training.diffusion.cached_model import CachedModel
from training.diffusion.model import ReactionModel
from training.diffusion.react import Request, react
from training.evaluation.evaluate import evaluate
from training.evaluation.out_of_distribution import read_leaders
from training.evaluation.protocol import HeldOutDuet, Motions, ReactorGenerator, Settings
from training.evaluation.report.conditions import commit, machine
from training.evaluation.report.report import write_report
from training.evaluation.rows import generate_motions
from training.hfsq.reconstruct import reconstruct


@dataclass(frozen=True)
class Options:
    data: Path
    """npz archive of duets, a folder of BVH pairs, or a DD100 root."""
    out: Path
    """Folder for metrics.json, report.md, pictures and videos."""
    fps: float | None = None
    """Frame rate of the BVH files of --data where their headers are wrong."""
    model: Path | None = None
    """Folder with manifest.json and graphs."""
    checkpoint: Path | None = None
    """Folder with hfsq and denoiser weights."""
    val: tuple[str, ...] = ()
    """Names of the duets that chose the model; DD100 has its own."""
    test: tuple[str, ...] = ()
    """Names of the duets that were kept for the end; DD100 has its own."""
    measure: Literal["test", "val"] = "test"
    """Which of the two to measure: choose models by val, report on test."""
    songs: Path | None = None
    """Folder of songs; the held-out ones among them are paired with the duets instead of the synthesiser."""
    music: bool = True
    music_cache: Path | None = None
    out_of_distribution: tuple[Path, ...] = ()
    """Leaders of other dances, without a partner: npz archives of solo dances, single BVH files."""
    controlled: tuple[Path, ...] = ()
    """Further leaders beside whom controls are moved: npz archives of solo dances, single BVH files."""
    steps: int | None = None
    """Sampling steps; the model's default when left out."""
    threads: int = 0
    pictures: bool = True
    """Spectra and filmstrips."""
    videos: bool = True
    """True and generated couple of every duet side by side, WebM."""
    no_latent_baseline: Path | None = None
    """Checkpoint of training/evaluation/no_latent_baseline.py, for a row beside the others."""
    solve: bool = False
    """Measure the solved skeleton too, without and with foot lock, by the page's own code under Node."""
    settings: Settings = field(default_factory=Settings)

    def __post_init__(self) -> None:
        check_limits(self, fps=FRAME_RATES)
        settings, measured = self.settings, self.test if self.measure == "test" else self.val
        wrong = {
            "give --model (a folder with manifest.json), --checkpoint, or both": not (
                self.model or self.checkpoint
            ),
            "give one or more --settings.seeds": not settings.seeds,
            "--songs are not read with --no-music": self.songs and not self.music,
            "--settings.guidance-grid is measured under PyTorch: give --checkpoint": settings.guidance_grid
            and not self.checkpoint,
            "--controlled and --settings.controlled-leaders are for --settings.controls": not settings.controls
            and (self.controlled or settings.controlled_leaders),
            "--settings.seen-leaders are of --out-of-distribution, which was not given": settings.seen_leaders
            and not self.out_of_distribution,
            f"--settings.beats-unknown names a dance that is not measured ({', '.join(measured)} are)": measured
            and not set(settings.beats_unknown) <= set(measured),
        }
        for sentence, found in wrong.items():
            if found:
                raise ValueError(sentence)


def reactor_generator(
    model: ReactionModel, steps: int | None = None, at_every_step: bool = False
) -> ReactorGenerator:
    """A model as evaluation asks it. at_every_step: with the paper's form of guidance, under PyTorch alone."""

    def generate(leader: np.ndarray, music: np.ndarray | None, seed: int, **controls: Any) -> np.ndarray:
        if at_every_step:
            controls = {"variety": 1.0} | controls  # it has no other
        request = Request(leader, music, seed, steps=steps, at_every_step=at_every_step, **controls)
        return react(model, request)

    return generate


def paired_duets(options: Options, duets: Split) -> list[HeldOutDuet]:
    """The held-out duets to measure with the music that training pairs them with, its tempo fitted from the leader
    alone.
    """
    chosen = duets.test if options.measure == "test" else duets.val
    if not chosen:
        raise ValueError(f"no duets to measure on: name them with --{options.measure}")
    if not options.music:
        return [HeldOutDuet(duet, None) for duet in chosen]
    variant = Variant(1.0, "song" if options.songs else "synth", 0)
    split = Split((), duets.val, duets.test)  # baselines use no music
    bank = build_music_bank(split, options.songs, [variant], cache_dir=options.music_cache)
    return [HeldOutDuet(duet, bank[duet.name][variant]) for duet in chosen]


def main(options: Options) -> None:
    console = Console()
    if options.threads:
        torch.set_num_threads(options.threads)
    duets = read_split(options.data, options.val, options.test, options.fps)
    held_out = paired_duets(options, duets)
    options.out.mkdir(parents=True, exist_ok=True)  # before all is measured, which takes minutes
    split = {part: [duet.name for duet in getattr(duets, part)] for part in ("train", "val", "test")}
    facts: dict[str, Any] = {"data": options.data.name, "split": split, "machine": machine()}
    # The names of DD100's own test part are in no training's options.
    named = options.test if options.measure == "test" else options.val
    facts["seen"] = duets_seen(options.checkpoint, named) if options.checkpoint else ()

    given: dict[str, Motions] = {}
    checkpoint = load_model(options.checkpoint) if options.checkpoint else None
    if checkpoint is not None:
        for name, layers in (("reconstruction", None), ("reconstruction, coarse alone", 1)):
            given[name] = {
                i.duet.name: [reconstruct(checkpoint.hfsq, i.duet, checkpoint.frame, layers)]
                for i in held_out
            }
    if options.model is not None:
        model = open_model(options.model, options.threads)
        graphs = {k: g["files"]["wasm"]["sha256"] for k, g in model.manifest["graphs"].items()}
        facts |= {"model": model.manifest["id"], "runtime": "onnxruntime", "graphs": graphs}
        name, card = model.manifest["name"], model.manifest["skeleton"]
    else:
        assert checkpoint is not None and options.checkpoint is not None
        model, name = checkpoint, options.checkpoint.name
        card = read_card(options.checkpoint)
        facts |= {"model": name, "runtime": "pytorch"}
    if options.no_latent_baseline is not None:
        baseline = reactor_generator(load_model(options.no_latent_baseline))
        given["no-latent baseline"] = generate_motions(baseline, held_out, options.settings.seeds)[0]
    sampling = model.sampling
    coarse, fine = sampling.guidance
    defaults = {
        "coarse": coarse,
        "fine": fine,
        "music": sampling.music_guidance,
        "variety": sampling.variety,
    }
    facts |= {
        "commit": commit(),
        "sampling": {
            "steps": options.steps or sampling.steps,
            "last_time": sampling.last_time,
            "extrapolation": sampling.extrapolation,
            **defaults,
        },
    }
    generate = reactor_generator(CachedModel(model), options.steps)
    every_step = reactor_generator(checkpoint, options.steps, at_every_step=True) if checkpoint else None
    if options.solve:
        generate = in_training_bodies(generate, card["training_bodies"])
        every_step = every_step and in_training_bodies(every_step, card["training_bodies"])
    seen = options.settings.seen_leaders or (solos_seen(options.checkpoint) if options.checkpoint else ())
    evaluation = evaluate(
        generate,
        held_out,
        duets.train,
        STRIDE * sampling.block,
        replace(options.settings, seen_leaders=seen),
        given,
        SOLVERS if options.solve else None,
        read_leaders(options.out_of_distribution),
        read_leaders(options.controlled),
        defaults,
        every_step,
        console.print,
    )
    title = f"{name}, measured"
    required = write_report(evaluation, held_out, options.out, title, facts, options.pictures, options.videos)
    reached = sum(result.passed for result in required)
    console.print(
        f"wrote {options.out / 'report.md'}; {reached} of {len(required)} required thresholds reached "
        "(they were set for the shipped model's salsa couple)"
    )


if __name__ == "__main__":
    run_program(main, Options)
