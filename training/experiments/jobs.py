"""Trains what the rows of a table need: each training once, whichever rows and tables share it."""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from training.checkpoint import copy_stage1
from training.config import write_json
from training.experiments.scale import Scale
from training.experiments.tables import Row

COST = "cost.json"
"""Written when a training has ended; checkpoints are there long before."""


@dataclass(frozen=True)
class Data:
    """What all trainings of a run have in common. npz archive, BVH folder or DD100 root, split by names."""

    source: Path
    val: tuple[str, ...]
    test: tuple[str, ...]
    music_cache: Path

    def options(self, music: bool) -> list[str]:
        cache = ["--music-cache", str(self.music_cache)] if music else []
        return ["--data", str(self.source), "--val", *self.val, "--test", *self.test, *cache]


@dataclass(frozen=True)
class Job:
    """One training: a command and the folder that it writes to."""

    command: tuple[str, ...]
    folder: Path
    stage1: Path | None = None
    """Folder of the stage-1 checkpoint that is copied in first."""


def command(program: str, changes: Mapping[str, str]) -> list[str]:
    """The command line of a program. Options that choose a subcommand, such as `a.b:none`, come last."""
    plain = [
        part for name, value in changes.items() if ":" not in name for part in (f"--{name}", *value.split())
    ]
    return [sys.executable, "-m", program, *plain, *(name for name in changes if ":" in name)]


def _folder(root: Path, kind: str, *parts: object) -> Path:
    """A folder that only the same training has."""
    digest = hashlib.sha256(json.dumps(parts, sort_keys=True, default=str).encode()).hexdigest()[:16]
    return root / "trained" / f"{kind}-{digest}"


def _job(
    program: str, kind: str, changes: Mapping[str, str], data: list[str], root: Path, *more: object
) -> Job:
    folder = _folder(root, kind, program, dict(changes), data, *more)
    line = command(program, changes)
    # The data's options first, so that a subcommand stays last.
    return Job((*line[:3], *data, "--out", str(folder), *line[3:]), folder)


def stage1_job(row: Row, seed: int, scale: Scale, data: Data, root: Path) -> Job:
    """Stage 1 of a row. Baselines in joint space have one that learns nothing."""
    options = data.options(music=False)
    if row.baseline in ("edge", "intergen", "tcdiff"):
        return _job("training.evaluation.no_latent_baseline", "joints", {}, options, root)
    changes = {**scale.stage1(), "seed": str(seed), "threads": "1", **row.stage1}
    return _job("training.train_hfsq", "stage1", changes, options, root)


def stage2_job(row: Row, seed: int, scale: Scale, data: Data, root: Path) -> Job:
    """Stage 2 of a row: the denoiser, or a baseline in its place."""
    stage1 = stage1_job(row, seed, scale, data, root)
    options = data.options(music=True)
    common = {"seed": str(seed), "threads": "1"}
    if row.baseline:
        changes = {**scale.baseline(), **common, "method": row.baseline, **row.stage2}
        job = _job("training.baselines", row.baseline, changes, options, root, stage1.folder)
    else:
        changes = {**scale.stage2(), **common, **row.stage2}
        job = _job("training.train_denoiser", "stage2", changes, options, root, stage1.folder)
    return Job(job.command, job.folder, stage1.folder)


def run_all(jobs: Iterable[Job], processes: int, log: Callable[[str], None]) -> None:
    """Runs what is not done yet, several side by side; the same job once.

    Raises RuntimeError with the end of its log where one fails; what others have finished stays.
    """
    unique = list({job.folder: job for job in jobs}.values())
    waiting = [job for job in unique if not (job.folder / COST).exists()]
    log(f"{len(unique)} trainings, {len(unique) - len(waiting)} of them done")
    with ThreadPoolExecutor(processes) as pool:
        for job in pool.map(_run, waiting):
            log(f"trained {job.folder.name}")


def _run(job: Job) -> Job:
    """Runs a job, going on where it was cut off if it left a state."""
    job.folder.mkdir(parents=True, exist_ok=True)
    if job.stage1:
        copy_stage1(job.stage1, job.folder)
    line = list(job.command)
    resumed = any((job.folder / stage / "state.ckpt").exists() for stage in ("hfsq", "denoiser", "baseline"))
    if resumed:
        line.insert(3, "--resume")
    path = job.folder / "log.txt"
    with path.open("w") as output:
        process = subprocess.Popen(line, stdout=output, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        end = "\n".join(path.read_text().splitlines()[-12:])
        raise RuntimeError(f"{' '.join(line)}\nfailed, see {path}:\n{end}")
    # Of a training that was cut off the time of its first part is not known.
    minutes = None if resumed else round((usage.ru_utime + usage.ru_stime) / 60, 3)
    cost = {"cpu_minutes": minutes, "command": line[1:]}
    write_json(job.folder / COST, cost)
    return job
