"""One training: steps on one or more devices, and a state to go on from."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, fields, is_dataclass
from pathlib import Path
from typing import Any, Generic

import numpy as np
import torch
from lightning_fabric import Fabric
from torch import nn

from training.data.naming import naming
from training.loop.ema import Ema, M
from training.loop.logger import Logger
from training.loop.options import LoopOptions, Precision
from training.loop.schedule import Schedule, learning_rate


def launch(options: LoopOptions) -> Fabric:
    """Fabric on the options' devices, this process among them.

    Raises ValueError where torchrun started another number of processes: each would train by itself.
    """
    started = int(os.environ.get("WORLD_SIZE", options.devices))
    if started != options.devices:
        raise ValueError(
            f"{started} processes were started for --devices {options.devices}: give --devices {started}"
        )
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


MAY_DIFFER = (
    "devices", "evaluate-every", "log-every", "minutes", "music-cache", "music-guidance", "out",
    "precision", "resume", "steps", "threads",
)  # fmt: skip
"""Options that a training may go on with in other values: those of its length, its machine and its report, and the
default weight of a student, of which nothing is learnt."""


def flat_options(options: Any, prefix: str = "") -> dict[str, str]:
    """The options by the names that they have on the command line, `hfsq.groups`, as text. Of a path only that it was
    given, since a folder may have been moved.
    """
    flat: dict[str, str] = {}
    for each in fields(options):
        value, name = getattr(options, each.name), prefix + each.name.replace("_", "-")
        if is_dataclass(value):
            flat |= flat_options(value, f"{name}.")
        else:
            flat[name] = "given" if isinstance(value, Path) else str(value)
    return flat


@contextmanager
def interruption() -> Iterator[Callable[[], bool]]:
    """Whether Ctrl-C was pressed, asked between steps so that none is cut in two. Pressed again it stops at once."""
    is_pressed = False

    def press(*_: Any) -> None:
        nonlocal is_pressed
        if is_pressed:
            raise KeyboardInterrupt
        is_pressed = True

    before = signal.signal(signal.SIGINT, press)
    try:
        yield lambda: is_pressed
    finally:
        signal.signal(signal.SIGINT, before)


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
        begins_with: Mapping[str, str],
    ) -> None:
        """stage: from a batch to the loss and its parts; model: what of it is trained, averaged and saved; begins_with:
        digests, by name, of the weights that the training begins with or learns from, which --resume has to find again.
        """
        self.fabric, self.model, self.options, self.warmup = fabric, model, options, warmup
        self.begins_with = dict(begins_with)
        self.ema = Ema(model, options.ema_decay)
        self.ema.module.to(fabric.device)
        self.stage, self.optimizer = fabric.setup(stage, optimizer)
        self.schedule = Schedule(options.steps, options.minutes)
        self.state = folder / "state.ckpt"
        if options.resume:
            self.load()
        self.logger = Logger(folder, fabric.is_global_zero, self.schedule.step)

    def train(
        self,
        next_batch: Callable[[np.random.Generator], Any],
        evaluate: Callable[[], None],
        finish: Callable[[], None],
    ) -> None:
        """Steps until the schedule ends. On rank 0 `evaluate` is called every so many steps, and `finish` at the end.
        The state is saved before each, and on Ctrl-C.

        Random numbers depend on the seed, the rank and the step of the last evaluation alone: a training that goes on
        from one draws those that it would have drawn. `next_batch` draws from the generator it is given, the stage from
        torch's.
        """
        with interruption() as is_interrupted:
            self._steps(next_batch, evaluate, is_interrupted)
        self.save()
        if self.fabric.is_global_zero:
            finish()
        self.fabric.barrier()

    def _steps(
        self,
        next_batch: Callable[[np.random.Generator], Any],
        evaluate: Callable[[], None],
        is_interrupted: Callable[[], bool],
    ) -> None:
        random = self._seed()
        while self.schedule.progress < 1:
            self._step(next_batch(random))
            if self.schedule.step % self.options.log_every == 0:
                self.logger.write(self.schedule)
            if self.schedule.step % self.options.evaluate_every == 0 and self.schedule.progress < 1:
                self.save()
                if self.fabric.is_global_zero:
                    evaluate()
                random = self._seed()
            if is_interrupted():
                # Saving waits for all ranks, and another one may not have been stopped.
                if self.fabric.world_size > 1:
                    raise KeyboardInterrupt
                self.save()
                raise SystemExit(f"stopped after step {self.schedule.step}; go on with --resume")

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
            "begins_with": self.begins_with,
            "step": self.schedule.step,
            "spent": self.schedule.spent,
        }
        part = self.state.with_suffix(".part")
        self.fabric.save(part, state)
        if self.fabric.is_global_zero:
            part.replace(self.state)

    def load(self) -> None:
        """Inverse of `save`, strict. Raises FileNotFoundError where nothing was saved, and ValueError for a damaged
        state and for a training whose other options were not those of this one: the checkpoint would say of its weights
        what is not true.
        """
        if not self.state.exists():
            raise FileNotFoundError(f"{self.state} is missing: there is nothing to go on from with --resume")
        with naming(self.state):
            saved = self.fabric.load(self.state)
            before, now = saved["options"], flat_options(self.options)
            differ = [name for name in before | now if before.get(name) != now.get(name)]
            if wrong := [name for name in differ if name not in MAY_DIFFER]:
                were = ", ".join(f"--{name} (it was {before.get(name, 'not there')})" for name in wrong)
                raise ValueError(
                    f"--resume goes on with the same training, but these options differ: {were}; give them as they "
                    "were, or begin another training from its checkpoint with --init"
                )
            if other := [
                name for name, digest in self.begins_with.items() if saved["begins_with"][name] != digest
            ]:
                raise ValueError(
                    f"it is of another {other[0]} than there is now: begin without --resume, or put the earlier back"
                )
            parts = {"model": self.stage, "optimizer": self.optimizer}
            rest = self.fabric.load(self.state, parts, strict=True)
            self.ema.module.load_state_dict(rest["ema"], strict=True)
        self.ema.updates = rest["updates"]
        self.schedule.step, self.schedule.spent = rest["step"], rest["spent"]
