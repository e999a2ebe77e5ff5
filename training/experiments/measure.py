"""Samples the trained rows of a table on the test duets and measures them, all by the same code."""

from __future__ import annotations

import hashlib
import json
import multiprocessing
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from safetensors import safe_open

from training.baselines.trained import load_baseline
from training.checkpoint import load_hfsq, load_model
from training.config import STRIDE, DenoiserConfig, write_json
from training.data.music_pairing import Variant, build_music_bank
from training.data.sources import read_split
from training.data.splits import Split
from training.diffusion.react import Request, react
from training.evaluation.baselines import baselines
from training.evaluation.metrics.seams import boundaries, paper_jitter
from training.evaluation.protocol import TRUTH, HeldOutDuet, Motions
from training.evaluation.rows import bootstrap_interval, measure_row
from training.experiments.jobs import COST, Data
from training.experiments.tables import Row
from training.hfsq.reconstruct import reconstruct

CHANCE = "nearest neighbour"
"""The reactor of the training window whose leader is nearest: what needs no training."""
BLOCK = STRIDE * DenoiserConfig().block
"""Frames of a block; no row has other blocks."""
Generate = Callable[[HeldOutDuet, int], np.ndarray]
"""A reactor (T, 22, 3) metres beside the leader of a duet, by a seed."""
Numbers = dict[str, Any]
"""`mean` and `interval` (low, high), each by the key of a measure."""


@dataclass(frozen=True)
class MeasureJob:
    """A row and the folders that its trainings have written, one for each seed."""

    row: Row
    folders: tuple[Path, ...]
    data: Data
    sampling_seeds: tuple[int, ...]
    root: Path

    @property
    def result(self) -> Path:
        row = {k: v for k, v in asdict(self.row).items() if k != "name"}
        weights = [
            hashlib.sha256(file.read_bytes()).hexdigest()
            for folder in self.folders
            for file in sorted(folder.glob("*.safetensors"))
        ]
        return _measured(self.root, self.data, weights, row, self.sampling_seeds)


def _measured(root: Path, data: Data, *given: object) -> Path:
    """The file of what has been measured on these test duets, by all that it depends on."""
    key = json.dumps([data.source, data.val, data.test, *given], default=str)
    return root / "measured" / f"{hashlib.sha256(key.encode()).hexdigest()[:16]}.json"


def measure_all(jobs: Sequence[MeasureJob], processes: int, log: Callable[[str], None]) -> list[Numbers]:
    """Numbers of every job, in order; what has been measured before is read."""
    waiting = [job for job in jobs if not job.result.exists()]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(processes, mp_context=context) as pool:
        for job in pool.map(_measure, waiting):
            log(f"measured {job.row.name}")
    return [json.loads(job.result.read_text()) for job in jobs]


def _measure(job: MeasureJob) -> MeasureJob:
    torch.set_num_threads(1)
    held_out = held_out_duets(job.data)
    motions: Motions = {item.duet.name: [] for item in held_out}
    seconds: list[float] = []
    for folder in job.folders:
        generate = generator(job.row, folder)
        for item in held_out:
            for seed in job.sampling_seeds[: 1 if job.row.reconstruction else None]:
                started = time.process_time()
                motions[item.duet.name].append(generate(item, seed))
                seconds.append(time.process_time() - started)
    numbers = measured(held_out, motions)
    numbers["mean"]["seconds"] = float(np.mean(seconds))
    costs = [folder / COST for folder in job.folders if (folder / COST).exists()]
    times = [json.loads(path.read_text())["cpu_minutes"] for path in costs]
    minutes = [one for one in times if one is not None]
    if minutes:
        numbers["mean"]["cpu_minutes"] = float(np.mean(minutes))
    numbers["mean"]["parameters"] = parameters(job.folders[0], job.row) / 1000
    write_json(job.result, numbers)
    return job


def parameters(folder: Path, row: Row) -> int:
    """How many numbers the weights of a row's stage 2 have; of stage 1 for a reconstruction."""
    name = "hfsq" if row.reconstruction else "baseline" if row.baseline else "denoiser"
    with safe_open(str(folder / f"{name}.safetensors"), "pt") as file:
        return sum(int(np.prod(file.get_slice(key).get_shape())) for key in file.keys())  # noqa: SIM118


def generator(row: Row, folder: Path) -> Generate:
    """The trained row as a function."""
    if row.reconstruction:
        hfsq, frame = load_hfsq(folder)
        return lambda item, seed: reconstruct(hfsq, item.duet, frame)
    if row.baseline:
        baseline = load_baseline(folder)
        return lambda item, seed: baseline.react(item.duet.leader, item.music, seed)
    model = load_model(folder)

    def generate(item: HeldOutDuet, seed: int) -> np.ndarray:
        if row.guidance is None:
            return react(model, Request(item.duet.leader, item.music, seed))
        request = Request(
            item.duet.leader, item.music, seed,
            guidance=row.guidance, music_guidance=0.0, variety=1.0, at_every_step=True,
        )  # fmt: skip
        return react(model, request)

    return generate


def held_out_duets(data: Data) -> list[HeldOutDuet]:
    """The test duets with music that fits the leader's steps."""
    variant = Variant(1.0, "synth", 0)
    duets = read_split(data.source, data.val, data.test)
    bank = build_music_bank(Split((), duets.val, duets.test), None, [variant], cache_dir=data.music_cache)
    return [HeldOutDuet(duet, bank[duet.name][variant]) for duet in duets.test]


def measured(held_out: Sequence[HeldOutDuet], motions: Motions) -> Numbers:
    """`measure_row` and the paper's jitter at block boundaries, which are at the same frames in every row; motions:
    several of each duet.
    """
    row = measure_row(held_out, motions)
    mean, interval = dict(row["mean"]), dict(row["interval"])
    made = [motions[item.duet.name] for item in held_out]
    long = [of_duet for of_duet in made if len(boundaries(len(of_duet[0]), BLOCK))]
    if long:
        by_seed = [
            float(np.mean([paper_jitter(motion, boundaries(len(motion), BLOCK)) for motion in of_seed]))
            for of_seed in zip(*long, strict=True)
        ]
        mean["jitter"] = float(np.mean(by_seed))
        interval["jitter"] = bootstrap_interval(by_seed)
    return {"mean": mean, "interval": interval}


def reference_rows(data: Data, root: Path) -> dict[str, Numbers]:
    """The truth and what chance gives: a copied dance."""
    path = _measured(root, data, "reference")
    if not path.exists():
        held_out = held_out_duets(data)
        train = read_split(data.source, data.val, data.test).train
        truth: Motions = {item.duet.name: [item.duet.reactor] for item in held_out}
        rows = {TRUTH: truth, CHANCE: baselines(held_out, train)[CHANCE]}
        write_json(path, {name: measured(held_out, motions) for name, motions in rows.items()})
    return json.loads(path.read_text())
