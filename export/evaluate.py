"""Measure a model on held-out duets: exported graphs under onnxruntime, or a checkpoint under PyTorch.

    python -m export.evaluate --model web/public/models/salsa --checkpoint training/checkpoints/salsa \
        --data ../shared/data/cmu_salsa/duets.npz --test salsa_05 salsa_11 --out runs/evaluation \
        --elsewhere ../shared/data/cmu_solo/solo.npz --solve \
        --settings.phase-seeds 16 --settings.guidance-grid 0 0.5 1.2

With a model folder the graphs dance, and the checkpoint, if given, adds the rows of its autoencoder; with a
checkpoint alone PyTorch dances.
"""

from __future__ import annotations

import json
import subprocess
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import torch
import tyro
from rich.console import Console

from export.manifest import quality_rules
from export.runtime import Exported, default_guidance, open_model, plan, sample
from training.checkpoint import load_model, read_config
from training.config import STREAMS
from training.data.music_pairing import Variant, build_music_bank
from training.data.sources import read_split
from training.data.splits import Split
from training.diffusion.noise import noise
from training.diffusion.sampler import Model, condition, decode, pad_to_stride
from training.diffusion.sampler import sample as torch_sample
from training.diffusion.schedule import alphas_cumprod, ddim_steps
from training.evaluation.evaluate import evaluate, generate
from training.evaluation.out_of_distribution import read_leaders
from training.evaluation.protocol import Dancer, Motions, Settings, Solver, Trial
from training.evaluation.report.report import write_report
from training.hfsq.reconstruct import reconstruct
from training.motion.skeleton import body_height

ROOT = Path(__file__).parents[1]


@dataclass(frozen=True)
class Options:
    data: Path
    """npz archive of duets, a folder of BVH pairs, or a DD100 root."""
    out: Path
    """Folder for metrics.json, report.md, pictures and videos."""
    model: Path | None = None
    """Folder with manifest.json and graphs."""
    checkpoint: Path | None = None
    """Folder with hfsq and denoiser weights."""
    val: tuple[str, ...] = ("salsa_03",)
    test: tuple[str, ...] = ("salsa_05", "salsa_11")
    measure: Literal["test", "val"] = "test"
    """Which of the two to measure: choose models by val, report on test."""
    songs: Path | None = None
    """Folder of songs; the held-out ones among them are paired with the trials instead of the synthesiser."""
    music: bool = True
    music_cache: Path | None = None
    elsewhere: tuple[Path, ...] = ()
    """Leaders from elsewhere: npz archives of solo dances, single BVH files."""
    steps: int | None = None
    guidance: tuple[float, float] | None = None
    """Coarse and fine, Eq. 9's s; the model's default when left out."""
    music_guidance: float | None = None
    """How much of what the song changes is added; the model's default when left out."""
    threads: int = 0
    pictures: bool = True
    """Spectra and filmstrips."""
    videos: bool = True
    """True and generated couple of every trial side by side, WebM."""
    plain: Path | None = None
    """Checkpoint of a plain model (see training/evaluation/no_latent_baseline.py), for a row beside the others."""
    solve: bool = False
    """Measure the solved skeleton too, without and with foot lock, by the page's own code under Node."""
    settings: Settings = field(default_factory=Settings)


def condition_inputs(
    leader: np.ndarray, music: np.ndarray | None, heard_leader: np.ndarray | None, height: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.float32]:
    """Leader and heard leader at the reference height and padded to a multiple of 4, music, its validity,
    the scale.
    """
    scale = np.float32(height / body_height(leader))
    padded = pad_to_stride((leader * scale).astype(np.float32))
    heard = padded
    if heard_leader is not None:
        heard = pad_to_stride(
            (heard_leader * np.float32(height / body_height(heard_leader))).astype(np.float32)
        )
    features, valid = np.zeros((len(padded), 54), np.float32), np.zeros(len(padded), np.float32)
    if music is not None:
        count = min(len(music), len(padded))
        features[:count], valid[:count] = music[:count], 1
    return padded, heard, features, valid, scale


def exported_dancer(
    model: Exported, steps: int | None, default: tuple[float, float] | None, louder: float
) -> Dancer:
    """The exported graphs as a dancer: what the page computes."""
    manifest = model.manifest
    height, layers = manifest["skeleton"]["reference_height"], len(manifest["latent"]["layers"])

    def dance(
        leader: np.ndarray,
        music: np.ndarray | None,
        seed: int,
        heard_leader: np.ndarray | None = None,
        guidance: tuple[float, float] | None = None,
        coarse_only: bool = False,
        role: float = 0.0,
    ) -> np.ndarray:
        padded, heard, features, valid, scale = condition_inputs(leader, music, heard_leader, height)
        (memory,) = model.run(
            "condition", leader=heard, music=features, music_valid=valid, role=np.array([role])
        )
        chosen = guidance or default
        weights = (
            default_guidance(manifest) if chosen is None else np.tile(np.array(chosen), (len(STREAMS), 1))
        )
        schedule = plan(manifest, steps)
        latents = sample(model, memory, seed, schedule, weights.astype(np.float32), louder)
        kept = np.array([1] + [0 if coarse_only else 1] * (layers - 1))
        (reactor,) = model.run("decode", latents=latents, leader=padded, layers=kept)
        return reactor[: len(leader)] / scale

    return dance


def torch_dancer(
    model: Model,
    height: float,
    steps: int | None,
    default: tuple[float, float] | None,
    louder: float,
) -> Dancer:
    """A checkpoint under PyTorch as a dancer."""
    layers, width = model.denoiser.layers, model.denoiser.latent_width
    schedule = ddim_steps(alphas_cumprod(model.diffusion), steps or model.diffusion.steps)

    def dance(
        leader: np.ndarray,
        music: np.ndarray | None,
        seed: int,
        heard_leader: np.ndarray | None = None,
        guidance: tuple[float, float] | None = None,
        coarse_only: bool = False,
        role: float = 0.0,
    ) -> np.ndarray:
        padded, heard, features, valid, scale = condition_inputs(leader, music, heard_leader, height)
        memory = condition(
            model, torch.from_numpy(heard), torch.from_numpy(features), torch.from_numpy(valid), role
        )
        initial = torch.from_numpy(noise(seed, len(memory), layers * width)).float()
        weights = torch.tensor(guidance or default or model.diffusion.guidance).repeat(len(STREAMS), 1)
        latents = torch_sample(
            model,
            memory,
            initial.unflatten(1, (layers, width)),
            schedule,
            weights,
            louder,
        )
        kept = torch.tensor([1.0] + [0.0 if coarse_only else 1.0] * (layers - 1))
        return decode(model, latents, torch.from_numpy(padded), kept)[: len(leader)].numpy() / scale

    return dance


def either(asked: float | None, default: float) -> float:
    """0 is a wish too."""
    return default if asked is None else asked


def commit() -> str | None:
    """The commit the program runs from, None outside a repository."""
    try:
        out = subprocess.run(["git", "rev-parse", "HEAD"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return out.stdout.strip()


def solve_with_node(motion: np.ndarray, leader: np.ndarray, *flags: str) -> np.ndarray:
    """The motion (T, 22, 3) on the skeleton that the page draws and exports, kept out of the leader's body
    (T, 22, 3): web/motion under Node, files in between. flags: of tools/solve.mjs.
    """
    with tempfile.TemporaryDirectory() as folder:
        raw, beside, body, solved = (Path(folder) / name for name in ("raw", "beside", "body.json", "solved"))
        for path, joints in ((raw, motion), (beside, leader)):
            path.write_bytes(np.ascontiguousarray(joints, dtype="<f4").tobytes())
        body.write_text(json.dumps(quality_rules()["penetration"]))
        subprocess.run(
            ["node", "tools/solve.mjs", "--beside", beside, "--body", body, *flags, raw, solved],
            cwd=ROOT,
            check=True,
            capture_output=True,
        )
        return np.frombuffer(solved.read_bytes(), dtype="<f4").reshape(motion.shape).astype(np.float32)


SOLVERS: dict[str, Solver] = {
    "solved": solve_with_node,
    "solved, foot lock": lambda motion, leader: solve_with_node(motion, leader, "--foot-lock"),
}


def paired_trials(options: Options, duets: Split) -> list[Trial]:
    """The trials to measure with the music that training pairs them with, its tempo fitted from the leader
    alone.
    """
    chosen = duets.test if options.measure == "test" else duets.val
    if not options.music:
        return [Trial(duet, None) for duet in chosen]
    variant = Variant(1.0, "song" if options.songs else "synth", 0)
    held_out = Split((), duets.val, duets.test)  # training duets need no music here
    bank = build_music_bank(held_out, options.songs, [variant], cache_dir=options.music_cache)
    return [Trial(duet, bank[duet.name][variant]) for duet in chosen]


def main(options: Options) -> None:
    console = Console()
    if options.threads:
        torch.set_num_threads(options.threads)
    if options.model is None and options.checkpoint is None:
        raise SystemExit("give --model (a folder with manifest.json), --checkpoint, or both")
    duets = read_split(options.data, options.val, options.test)
    trials = paired_trials(options, duets)
    facts: dict[str, Any] = {"data": options.data.name, "split": {"val": options.val, "test": options.test}}

    given: dict[str, Motions] = {}
    checkpoint = load_model(options.checkpoint) if options.checkpoint else None
    if checkpoint is not None:
        for name, layers in (("reconstruction", None), ("reconstruction, coarse alone", 1)):
            given[name] = {
                t.duet.name: [reconstruct(checkpoint.hfsq, t.duet, checkpoint.frame, layers)] for t in trials
            }
    if options.model is not None:
        exported = open_model(options.model, options.threads)
        louder = either(options.music_guidance, exported.manifest["guidance"]["music"]["default"])
        dancer = exported_dancer(exported, options.steps, options.guidance, louder)
        alternating = exported.manifest["diffusion"]["alternating_phase"]
        facts |= {"model": exported.manifest["id"], "runtime": "onnxruntime"}
        facts["graphs"] = {k: g["files"]["wasm"]["sha256"] for k, g in exported.manifest["graphs"].items()}
        sampled = exported.manifest["diffusion"]["steps"]["default"]
        guided = tuple(exported.manifest["guidance"]["default"].values())
        name = exported.manifest["name"]
    else:
        assert checkpoint is not None and options.checkpoint is not None
        height = read_config(options.checkpoint, "card")["reference_height"]
        louder = either(options.music_guidance, checkpoint.diffusion.music)
        dancer = torch_dancer(checkpoint, height, options.steps, options.guidance, louder)
        alternating = checkpoint.diffusion.alternating_phase
        facts |= {"model": options.checkpoint.name, "runtime": "pytorch"}
        sampled, guided = checkpoint.diffusion.steps, checkpoint.diffusion.guidance
        name = options.checkpoint.name
    if options.plain is not None:
        height = read_config(options.plain, "card")["reference_height"]
        plain_model = load_model(options.plain)
        plain = torch_dancer(plain_model, height, None, None, plain_model.diffusion.music)
        given["plain model"] = generate(plain, trials, options.settings.seeds)[0]
    spacing = Settings.seam_spacing // 2 if alternating else Settings.seam_spacing
    settings = replace(options.settings, seam_spacing=spacing)
    facts |= {
        "commit": commit(),
        "sampling": {
            "steps": options.steps or sampled,
            "guidance": options.guidance or guided,
            "music": louder,
        },
    }
    evaluation = evaluate(
        dancer,
        trials,
        duets.train,
        settings,
        given,
        SOLVERS if options.solve else None,
        read_leaders(options.elsewhere),
        console.print,
    )
    title = f"{name}, measured"
    bars = write_report(evaluation, trials, options.out, title, facts, options.pictures, options.videos)
    console.print(
        f"wrote {options.out / 'report.md'}; {sum(b.passed for b in bars)} of {len(bars)} bars reached"
    )


if __name__ == "__main__":
    main(tyro.cli(Options))
