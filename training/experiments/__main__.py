"""Repeat a table of the paper at small scale: trains its rows, samples and measures them.

    python -m training.experiments --table 3 --data my-duets --val duo_3 --test duo_5

What is trained and measured stays in the folder of `--out` and is not repeated: a run that was cut off goes on, more
seeds are added to those that are there, and tables share what they have in common. Equal data, steps and seeds for all
rows. Table 4 trains nothing: it changes the guidance of the weights of `--checkpoint`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from training.command_line import run_program
from training.config import FPS, DenoiserConfig, check_limits
from training.data.music_pairing import build_music_bank, variants
from training.data.sources import read_split
from training.evaluation.protocol import TRUTH
from training.experiments.jobs import Data, run_all, stage1_job, stage2_job
from training.experiments.measure import (
    CHANCE,
    MeasureJob,
    Numbers,
    held_out_duets,
    measure_all,
    reference_rows,
)
from training.experiments.scale import Scale
from training.experiments.tables import TABLES, Table
from training.experiments.write import write_table


@dataclass(frozen=True, kw_only=True)
class Options:
    table: tuple[int, ...]
    """Numbers of the tables, 1 to 6 and 8."""
    data: Path
    """npz archive of duets, a folder of BVH pairs, or a DD100 root."""
    val: tuple[str, ...]
    """Names of duets that are neither trained on nor measured."""
    test: tuple[str, ...]
    """Names of the duets that are measured, and never trained on."""
    out: Path = Path("runs/experiments")
    """Folder of trainings, measurements and tables."""
    checkpoint: Path | None = None
    """Weights for Table 4. They must not have seen the test duets."""
    seeds: tuple[int, ...] = (0, 1)
    """Of the trainings of a row."""
    sampling_seeds: tuple[int, ...] = (0, 1)
    """Dances that are sampled of each training."""
    processes: int = 1
    """Trainings and measurements side by side, each on one thread."""
    scale: Scale = field(default_factory=Scale)

    def __post_init__(self) -> None:
        for number in self.table:
            if number not in TABLES:
                raise ValueError(
                    f"there is no table {number} here: give one of {', '.join(map(str, TABLES))}"
                )
        if not (self.table and self.test and self.seeds and self.sampling_seeds):
            raise ValueError("give one or more of each: --table, --test, --seeds, --sampling-seeds")
        check_limits(self, processes=(1, math.inf))
        if self.table == (4,) and (self.seeds != Options.seeds or self.scale != Scale()):
            raise ValueError("table 4 trains nothing: leave --seeds and --scale out")
        if self.scale.width % DenoiserConfig.heads:
            raise ValueError(
                f"--scale.width {self.scale.width} cannot be shared by {DenoiserConfig.heads} heads"
            )
        if 4 in self.table and self.checkpoint is None:
            raise ValueError("table 4 changes the guidance of trained weights: give them with --checkpoint")
        if self.checkpoint is not None and 4 not in self.table:
            raise ValueError("--checkpoint is for table 4 alone; the other tables train their own weights")


def main(options: Options) -> None:
    log: Callable[[str], None] = lambda line: print(line, flush=True)  # noqa: E731
    data = Data(options.data, options.val, options.test, options.out / "music")
    fill_music_cache(data, options.scale)
    for number in options.table:
        table = TABLES[number]
        log(f"table {number}: {table.title}")
        rows = measure_table(table, options, data, log)
        for path in write_table(options.out / "tables", table, rows, facts(table, options, data)):
            log(f"wrote {path}")


def measure_table(
    table: Table, options: Options, data: Data, log: Callable[[str], None]
) -> dict[str, Numbers]:
    """The truth, chance and every row of a table, trained where they are not yet."""
    given = (options.scale, data, options.out)
    trained = [row for row in table.rows if row.guidance is None]
    pairs = [(row, seed) for row in trained for seed in options.seeds]
    run_all((stage1_job(row, seed, *given) for row, seed in pairs), options.processes, log)
    run_all(
        (stage2_job(row, seed, *given) for row, seed in pairs if not row.reconstruction),
        options.processes,
        log,
    )
    jobs = []
    for row in table.rows:
        if row.guidance is not None:
            assert options.checkpoint is not None
            folders: tuple[Path, ...] = (options.checkpoint,)
        else:
            job = stage1_job if row.reconstruction else stage2_job
            folders = tuple(job(row, seed, *given).folder for seed in options.seeds)
        jobs.append(MeasureJob(row, folders, data, options.sampling_seeds, options.out))
    measured = measure_all(jobs, options.processes, log)
    reference = reference_rows(data, options.out)
    rows = {row.name: numbers for row, numbers in zip(table.rows, measured, strict=True)}
    return {TRUTH: reference[TRUTH], CHANCE: reference[CHANCE], **rows}


def fill_music_cache(data: Data, scale: Scale) -> None:
    """Makes the music of all duets once, so that programs side by side do not make it again."""
    duets = read_split(data.source, data.val, data.test)
    build_music_bank(duets, None, variants(synths=scale.synths, songs=0), cache_dir=data.music_cache)
    held_out_duets(data)


def facts(table: Table, options: Options, data: Data) -> dict[str, Any]:
    """How large the experiment was, in figures and in a sentence."""
    frames = [len(duet) for duet in read_split(data.source, data.val, data.test).test]
    seconds = sum(frames) / FPS
    scale = options.scale
    if options.checkpoint and any(row.guidance for row in table.rows):
        how = f"No training: weights of {options.checkpoint.name}, {len(options.sampling_seeds)} seeds."
    else:
        how = (
            f"Small scale: {scale.stage1_steps} steps of stage 1 and {scale.stage2_steps} of stage 2 with batches of "
            f"{scale.batch}, width {scale.width}, {len(options.seeds)} training and {len(options.sampling_seeds)} "
            "sampling seeds for each row, the same data, steps and seeds."
        )
    note = f"{how} Measured on {len(frames)} test dances ({seconds:.0f} s). In brackets 95 % intervals."
    return {
        "note": note,
        "seeds": list(options.seeds),
        "sampling_seeds": list(options.sampling_seeds),
        "test": list(options.test),
        "scale": asdict(scale),
    }


if __name__ == "__main__":
    run_program(main, Options)
