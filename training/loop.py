"""What the training programs share: options, schedule, EMA of the weights, logging with curves, resumable state."""

from __future__ import annotations

import copy
import json
import math
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, fields, is_dataclass
from pathlib import Path
from typing import Any, Generic, Literal, TypeVar

import numpy as np
import torch
from lightning_fabric import Fabric
from torch import Tensor, nn
from torch.utils.tensorboard import SummaryWriter

from training.config import check_latent_frames, check_limits
from training.data.bvh.file import FRAME_RATES
from training.data.sources import read_split
from training.data.splits import Split, summary
from training.denoiser.clips import Augmentation

Precision = Literal["32-true", "bf16-mixed", "16-mixed"]
M = TypeVar("M", bound=nn.Module)


@dataclass(frozen=True, kw_only=True)
class LoopOptions:
    """Options of every training program."""

    data: Path
    """Duets: an npz archive, a DD100 root, or a folder of paired BVH files (see training/data/sources.py)."""
    fps: float | None = None
    """Frame rate of the BVH files of --data where their headers are wrong."""
    out: Path
    """Folder of this run: checkpoints, logs, curves."""
    val: tuple[str, ...]
    """Names of duets that choose a model; never trained on."""
    test: tuple[str, ...] = ()
    """Names of duets that are never trained on, nor used to choose anything; DD100 has its own."""
    learn_all: bool = False
    """Train on the duets of --val and --test too: for weights that ship once all is chosen and measured without."""
    init: Path | None = None
    """Start from the weights of this checkpoint."""
    solo: Path | None = None
    """npz archive of solo dances that join the training."""
    solo_prefixes: tuple[str, ...] = ("",)
    """Names that those solos begin with; all of them when left out."""
    steps: int
    """Batches to train on."""
    minutes: float | None = None
    """Stop after this time even if the steps are not done; the learning rate follows whichever comes first."""
    batch: int
    """Windows to a step, on each device."""
    learning_rate: float
    """The greatest; it rises at first and falls along half a cosine to 2 % of it."""
    weight_decay: float
    """Of the optimiser; 0 leaves it out."""
    ema_decay: float = 0.998
    """Of the average of the weights that is measured and saved."""
    seed: int = 0
    """Of all random numbers."""
    devices: int = 1
    """Processes on one GPU each, or on the CPU where there is none."""
    threads: int = 0
    """CPU threads for torch, 0 leaves its default."""
    precision: Precision | None = None
    """Left out: bf16 where its products are fast, single elsewhere."""
    log_every: int = 50
    """Steps between printed lines."""
    evaluate_every: int
    """Steps between measurements on the validation duets, at which the state is saved too."""
    resume: bool = False
    """Go on with the training in --out from its saved state."""

    def __post_init__(self) -> None:
        if not self.val:
            raise ValueError("no duets to validate on: name one or more with --val")
        check_limits(
            self,
            **dict.fromkeys(("steps", "batch", "devices", "log_every", "evaluate_every"), (1, math.inf)),
            **dict.fromkeys(("learning_rate", "weight_decay", "threads"), (0, math.inf)),
            minutes=(1e-3, math.inf),
            ema_decay=(0, 1),
            fps=FRAME_RATES,
            seed=(0, 2**20),
        )
        if self.solo is None and self.solo_prefixes != ("",):
            raise ValueError("--solo-prefixes chooses among the dances of --solo, which was not given")


@dataclass(frozen=True, kw_only=True)
class WindowOptions(LoopOptions):
    """Options of the programs that train on windows of latents: the denoiser and the baselines."""

    music_cache: Path | None = None
    """Folder in which music features are kept between runs."""
    steps: int = 6000
    batch: int = 32
    stride: int = 4
    """Frames between training windows, a multiple of 4 (the paper's Table 6)."""
    learning_rate: float = 5e-4
    weight_decay: float = 0.02
    synths: int = 3
    """Synthesised pieces of music per duet and tempo."""
    evaluate_every: int = 600
    augmentation: Augmentation = field(default_factory=Augmentation)

    def __post_init__(self) -> None:
        super().__post_init__()
        check_latent_frames("stride", self.stride)


def read_duets_to_train(options: LoopOptions, fabric: Fabric, window: int) -> Split:
    """The options' duets, split by name; with `learn_all` all of them are to train on and none is left to measure.

    window: frames of a training window. Prints what was read. Raises ValueError where none is left to train on.
    """
    duets = read_split(options.data, options.val, options.test, options.fps)
    if options.learn_all:
        duets = Split(duets.train + duets.val + duets.test, (), ())
    if not duets.train:
        raise ValueError(
            f"nothing is left of {options.data} to train on: name fewer duets with --val and --test, or add --learn-all"
        )
    fabric.print(summary(duets, window))
    return duets


def launch(options: LoopOptions) -> Fabric:
    """Fabric on the options' devices, this process among them."""
    if options.threads:
        torch.set_num_threads(options.threads)
    fabric = Fabric(
        accelerator="auto", devices=options.devices, precision=options.precision or fast_precision()
    )
    fabric.launch()
    return fabric


def fast_precision() -> Precision:
    """bf16 on a GPU and on processors with matrix tiles; without tiles it pays on some processors alone."""
    tiles = torch.cpu._is_amx_tile_supported()
    return "bf16-mixed" if torch.accelerator.is_available() or tiles else "32-true"


def flat_options(options: Any, prefix: str = "") -> dict[str, str]:
    """The options by the names that they have on the command line, `hfsq.groups`, as text."""
    flat: dict[str, str] = {}
    for each in fields(options):
        value, name = getattr(options, each.name), prefix + each.name.replace("_", "-")
        flat |= flat_options(value, f"{name}.") if is_dataclass(value) else {name: str(value)}
    return flat


@dataclass
class Schedule:
    """How far a training has come: by steps, or by minutes if a time limit is given and reached first."""

    steps: int
    minutes: float | None
    step: int = 0
    spent: float = 0.0  # seconds, over all resumed parts
    _since: float = field(default_factory=time.monotonic)

    def tick(self) -> None:
        now = time.monotonic()
        self.spent += now - self._since
        self._since = now
        self.step += 1

    @property
    def progress(self) -> float:
        """0 at the start, 1 at the end."""
        by_time = self.spent / (60 * self.minutes) if self.minutes else 0.0
        by_steps = self.step / self.steps if self.steps else 1.0
        return min(1.0, max(by_steps, by_time))


def learning_rate(peak: float, schedule: Schedule, warmup: int) -> float:
    """Linear warm-up over `warmup` steps, then half a cosine down to 2 % of the peak."""
    warm = min(1.0, (schedule.step + 1) / warmup)
    return peak * warm * (0.02 + 0.98 * 0.5 * (1 + math.cos(math.pi * schedule.progress)))


class Ema(Generic[M]):
    """Exponential moving average of a module's parameters (buffers are copied)."""

    def __init__(self, module: M, decay: float) -> None:
        self.module = copy.deepcopy(module).eval().requires_grad_(False)
        self.decay = decay
        self.updates = 0

    @torch.no_grad()
    def update(self, module: nn.Module) -> None:
        self.updates += 1
        # Early on the average would mostly remember the initial weights.
        decay = min(self.decay, self.updates / (self.updates + 10))
        for mine, theirs in zip(self.module.parameters(), module.parameters(), strict=True):
            mine.lerp_(theirs.detach().to(mine.dtype), 1 - decay)
        for mine, theirs in zip(self.module.buffers(), module.buffers(), strict=True):
            mine.copy_(theirs)


class Logger:
    """Numbers of a run: printed, sent to TensorBoard, kept as JSON lines and drawn as curves.png. Rank 0 only."""

    def __init__(self, folder: Path, enabled: bool, step: int) -> None:
        """step: where the run begins or goes on; what the folder's log has of later steps is dropped."""
        self.folder, self.enabled = folder, enabled
        self._sums: dict[str, list[float]] = defaultdict(list)
        if enabled:
            folder.mkdir(parents=True, exist_ok=True)
            self._board = SummaryWriter(str(folder), purge_step=step + 1)
            kept = [row for row in self._rows() if row["step"] <= step]
            self._log.write_text("".join(json.dumps(row) + "\n" for row in kept))

    @property
    def _log(self) -> Path:
        return self.folder / "log.jsonl"

    def _rows(self) -> list[dict[str, float]]:
        return [json.loads(line) for line in self._log.read_text().splitlines()] if self._log.exists() else []

    def add(self, values: dict[str, Tensor]) -> None:
        for name, value in values.items():
            self._sums[name].append(float(value))

    def write(self, schedule: Schedule, extra: dict[str, float] | None = None) -> None:
        """Log the means since the last call, and `extra` as it is."""
        means = {name: sum(v) / len(v) for name, v in self._sums.items()} | (extra or {})
        self._sums.clear()
        if not self.enabled:
            return
        row = {"step": schedule.step, "minutes": round(schedule.spent / 60, 2), **means}
        with self._log.open("a") as file:
            file.write(json.dumps(row) + "\n")
        for name, value in means.items():
            self._board.add_scalar(name, value, schedule.step)
        shown = "  ".join(f"{name} {value:.4g}" for name, value in means.items())
        print(
            f"{100 * schedule.progress:5.1f} %  step {schedule.step}  {row['minutes']} min  {shown}",
            flush=True,
        )

    def draw(self) -> None:
        """Redraw curves.png from the whole log."""
        if not self.enabled:
            return
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        rows = self._rows()
        names = sorted({name for row in rows for name in row} - {"step", "minutes"})
        columns = 4
        height = max(1, math.ceil(len(names) / columns))
        figure, axes = plt.subplots(height, columns, figsize=(4 * columns, 2.6 * height), squeeze=False)
        for axis in axes.flat:
            axis.set_visible(False)
        for axis, name in zip(axes.flat, names, strict=False):
            points = [(row["step"], row[name]) for row in rows if name in row]
            axis.plot(*zip(*points, strict=True), lw=1)
            axis.set_title(name, fontsize=9)
            axis.grid(alpha=0.3)
            axis.set_visible(True)
        figure.tight_layout()
        figure.savefig(self.folder / "curves.png", dpi=80)
        plt.close(figure)


class Run(Generic[M]):
    """One training: steps under Fabric, an EMA of the model, logs, and a state to go on from."""

    def __init__(
        self,
        fabric: Fabric,
        stage: nn.Module,
        model: M,
        optimizer: torch.optim.Optimizer,
        options: LoopOptions,
        folder: Path,
        warmup: int,
    ) -> None:
        """stage: from a batch to the loss and its parts; model: what of it is trained, averaged and saved."""
        self.fabric, self.model, self.options, self.warmup = fabric, model, options, warmup
        self.ema = Ema(model, options.ema_decay)
        self.ema.module.to(fabric.device)
        self.stage, self.optimizer = fabric.setup(stage, optimizer)
        self.schedule = Schedule(options.steps, options.minutes)
        self.state = folder / "state.ckpt"
        if options.resume:
            self.load()
        self.logger = Logger(folder, fabric.is_global_zero, self.schedule.step)

    def train(self, next_batch: Callable[[np.random.Generator], Any], evaluate: Callable[[], None]) -> None:
        """Steps until the schedule ends; `evaluate` on rank 0 every so many. The state is saved then, at the end and on
        Ctrl-C.

        Random numbers depend on the seed, the rank and the step of the last evaluation alone: a training that goes on
        from one draws those that it would have drawn. `next_batch` draws from the generator it is given, the stage from
        torch's.
        """
        try:
            self._steps(next_batch, evaluate)
        except KeyboardInterrupt:
            # Saving waits for all ranks, and another one may not have been stopped.
            if self.fabric.world_size > 1:
                raise
            self.save()
            raise SystemExit(f"stopped after step {self.schedule.step}; go on with --resume") from None
        self.save()

    def _steps(self, next_batch: Callable[[np.random.Generator], Any], evaluate: Callable[[], None]) -> None:
        random = self._seed()
        while self.schedule.progress < 1:
            self._step(next_batch(random))
            if self.schedule.step % self.options.log_every == 0:
                self.logger.write(self.schedule)
            if self.schedule.step % self.options.evaluate_every == 0:
                self.save()
                if self.fabric.is_global_zero:
                    evaluate()
                random = self._seed()

    def _seed(self) -> np.random.Generator:
        """Seeds torch, and gives a generator for batches."""
        entropy = (self.options.seed, self.fabric.global_rank, self.schedule.step)
        for_torch, for_batches = np.random.SeedSequence(entropy).spawn(2)
        torch.manual_seed(int(for_torch.generate_state(1, np.uint64)[0]))
        return np.random.default_rng(for_batches)

    def _step(self, batch: Any) -> None:
        self.model.train()
        for group in self.optimizer.param_groups:
            group["lr"] = learning_rate(self.options.learning_rate, self.schedule, self.warmup)
        loss, parts = self.stage(self.fabric.to_device(batch))
        self.fabric.backward(loss)
        self.fabric.clip_gradients(self.stage, self.optimizer, max_norm=1.0)
        self.optimizer.step()
        self.optimizer.zero_grad()
        self.ema.update(self.model)
        self.schedule.tick()
        # One clock for all ranks: it sets the learning rate.
        self.schedule.spent = self.fabric.broadcast(self.schedule.spent)
        self.logger.add(parts)

    @contextmanager
    def averaged(self) -> Iterator[M]:
        """The averaged model on the CPU, to be measured and saved."""
        yield self.ema.module.cpu()
        self.ema.module.to(self.fabric.device)

    def provenance(self, program: str, leave_out: tuple[str, ...]) -> dict[str, Any]:
        """How a checkpoint came to be: program, steps, minutes and options, without those that are kept elsewhere."""
        options = asdict(self.options) | {"precision": self.options.precision or fast_precision()}
        return {
            "program": program,
            "steps": self.schedule.step,
            "minutes": round(self.schedule.spent / 60, 1),
            "options": {k: str(v) for k, v in options.items() if k not in leave_out},
        }

    def save(self) -> None:
        """Everything needed to go on after a crash, in one file that is replaced only when written whole."""
        state = {
            "model": self.stage,
            "optimizer": self.optimizer,
            "ema": self.ema.module.state_dict(),
            "updates": self.ema.updates,
            "options": flat_options(self.options),
            "step": self.schedule.step,
            "spent": self.schedule.spent,
        }
        part = self.state.with_suffix(".part")
        self.fabric.save(part, state)
        if self.fabric.is_global_zero:
            part.replace(self.state)

    def load(self) -> None:
        """Inverse of `save`, strict. Raises FileNotFoundError where nothing was saved, and ValueError for a state of
        another network.
        """
        if not self.state.exists():
            raise FileNotFoundError(f"{self.state} is missing: there is nothing to go on from with --resume")
        parts = {"model": self.stage, "optimizer": self.optimizer}
        try:
            rest = self.fabric.load(self.state, parts, strict=True)
        except RuntimeError as error:
            before, now = self.fabric.load(self.state).get("options", {}), flat_options(self.options)
            differ = ", ".join(
                f"--{key} (it was {before[key]})" for key in before if before[key] != now.get(key)
            )
            raise ValueError(
                f"{self.state} is of another network, so --resume cannot go on with it; these options differ: {differ}"
            ) from error
        self.ema.module.load_state_dict(rest["ema"], strict=True)
        self.ema.updates = rest["updates"]
        self.schedule.step, self.schedule.spent = rest["step"], rest["spent"]
