"""Draws when the feet of every duet are planted, beside the beats of the tempo that is fitted to them.

    python -m training.evaluation.report.beat_pictures --data my-duets --val duo_3 --test duo_5 --out runs/beats

A duet without a song gets music of that tempo. One PNG per duet, and a table of tempi and fits on the screen; of
validation and test duets only the leader's steps are read, as for their music.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from rich.console import Console
from rich.table import Table

from training.command_line import run_program
from training.config import FPS
from training.data.duet import Duet
from training.data.sources import read_split
from training.data.step_tempo import duet_tempo, foot_plants, foot_speed, plant_fit
from training.music.tempo import CYCLE, Tempo

_LEFT, _RIGHT = "tab:red", "tab:blue"


def draw(duet: Duet, tempo: Tempo, path: Path) -> None:
    """Foot speeds and plants over time with the beats, and plants over the eight counts, of both dancers."""
    figure, axes = plt.subplots(4, 1, figsize=(16, 10), height_ratios=(2, 2, 1, 1), layout="constrained")
    seconds = np.arange(len(duet)) / FPS
    beats, counts = tempo.beats(len(duet) / FPS)
    for begins, (role, motion) in enumerate((("leader", duet.leader), ("reactor", duet.reactor))):
        plants = foot_plants(motion)
        fit = plant_fit(plants, tempo, begins)
        timeline, histogram = axes[begins], axes[2 + begins]
        timeline.set_title(
            f"{duet.name} {role}: foot speed (m/s), dots: plants, lines: beats, thick: count 1"
        )
        for beat, count in zip(beats, counts, strict=True):
            timeline.axvline(beat, color="black", lw=1.5 if count == 0 else 0.5, alpha=0.5)
        for foot, (speed, colour) in enumerate(zip(foot_speed(motion), (_LEFT, _RIGHT), strict=True)):
            own = plants.foot == foot
            timeline.plot(seconds, speed, color=colour, lw=1, label=("left foot", "right foot")[foot])
            timeline.plot(plants.seconds[own], 0.5 * plants.speed[own], "o", color=colour, ms=4)
            # The picture begins half a count early, so that plants around count 1 stay together.
            position = (tempo.counts(plants.seconds[own]) + 0.5) % CYCLE - 0.5
            histogram.hist(position, bins=np.arange(-0.5, CYCLE - 0.49, 0.125), color=colour, alpha=0.6)
        timeline.set_xlim(0, seconds[-1])
        timeline.legend(loc="upper right")
        histogram.set_xticks(range(CYCLE), [str(k + 1) for k in range(CYCLE)])
        histogram.grid(axis="x")
        histogram.set_title(
            f"{role}, {tempo.bpm:.1f} BPM: {fit.plants} plants over the eight counts, {fit.on_count:.0%} on "
            f"a count of their foot (25% by chance), concentration {fit.concentration:.2f}"
        )
    figure.savefig(path, dpi=70)
    plt.close(figure)


@dataclass(frozen=True)
class Options:
    data: Path
    """As for training: an .npz archive, a DD100 root, or a folder of BVH pairs."""
    val: tuple[str, ...] = ()
    test: tuple[str, ...] = ()
    out: Path = Path("runs/beats")


def main(options: Options) -> None:
    parts = read_split(options.data, options.val, options.test)
    options.out.mkdir(parents=True, exist_ok=True)
    table = Table(
        "duet", "tempo from", "BPM", "count 1 (s)", "leader on count", "conc.", "reactor on count", "conc."
    )
    for duets, leader_only in ((parts.train, False), (parts.val + parts.test, True)):
        for duet in duets:
            tempo = duet_tempo(duet, leader_only)
            draw(duet, tempo, options.out / f"{duet.name}.png")
            row = [duet.name, "leader" if leader_only else "both", f"{tempo.bpm:.1f}", f"{tempo.first:.2f}"]
            for begins, motion in enumerate((duet.leader, duet.reactor)):
                fit = plant_fit(foot_plants(motion), tempo, begins)
                row += [f"{fit.on_count:.0%} of {fit.plants}", f"{fit.concentration:.2f}"]
            table.add_row(*row)
    Console(width=110).print(table)


if __name__ == "__main__":
    run_program(main, Options)
