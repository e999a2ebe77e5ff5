"""Filmstrips: a dance as a row of poses from the front, from the side and from above."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon

from training.config import FPS
from training.motion.skeleton import JOINTS, PARENTS

LEADER, REACTOR, TRUTH = "#2f6fde", "#f07a2b", "#a7adb5"
INK, PAPER, RULE = "#3c434c", "#ffffff", "#e3e6ea"
TRUNK = ("left_shoulder", "right_shoulder", "right_hip", "left_hip")
HEAD_RADIUS = 0.1  # metres
CELL_HEIGHT = 2.15  # metres that the side views show


@dataclass(frozen=True)
class View:
    """A parallel projection: what is right, up and towards the eye on the picture, as unit vectors (3,)."""

    name: str
    right: np.ndarray
    up: np.ndarray
    eye: np.ndarray

    @staticmethod
    def from_axes(name: str, right: Sequence[float], up: Sequence[float]) -> View:
        return View(name, np.array(right, float), np.array(up, float), np.cross(right, up))


def views(leader: np.ndarray, reactor: np.ndarray) -> tuple[View, View, View]:
    """Front, side and top for a stretch of dance, fixed in the room so that turns are seen as turns.

    The front view looks across the line on which the two stand most of the time.
    """
    offset = (reactor[:, 0] - leader[:, 0])[:, [0, 2]].astype(np.float64)
    # The longest axis of their offsets, sign ignored: partners change places all the time.
    _, axes = np.linalg.eigh(offset.T @ offset)
    x, z = axes[:, -1] if axes[0, -1] >= 0 else -axes[:, -1]
    across = (x, 0.0, z)
    return (
        View.from_axes("front", across, (0, 1, 0)),
        View.from_axes("side", (-z, 0.0, x), (0, 1, 0)),
        View.from_axes("top", across, (z, 0.0, -x)),
    )


def shade(colour: str, amount: float) -> tuple[float, float, float]:
    """The colour mixed with white (amount > 0) or black (amount < 0)."""
    red, green, blue = to_rgb(colour)
    target, share = (1.0, amount) if amount > 0 else (0.0, -amount)
    return red + (target - red) * share, green + (target - green) * share, blue + (target - blue) * share


def draw_body(
    axes: Axes, pose: np.ndarray, view: View, colour: str, shift: tuple[float, float], ghost: bool = False
) -> None:
    """One body (22, 3) metres in a projection, moved by shift (metres); nearer limbs cover farther ones.

    The body's right side is darker, so that left and right can be told apart; a ghost is flat and lies
    behind.
    """
    x, y, near = pose @ view.right + shift[0], pose @ view.up + shift[1], pose @ view.eye
    behind = 1.0 if ghost else 10.0

    def order(depth: float) -> float:
        return behind + (0.0 if ghost else depth)

    trunk = [JOINTS.index(name) for name in TRUNK]
    flat = shade(colour, 0.45)
    axes.add_patch(
        Polygon(
            np.stack([x[trunk], y[trunk]], axis=-1),
            facecolor=flat,
            edgecolor=flat,
            joinstyle="round",
            linewidth=1.5,
            alpha=0.35 if ghost else 0.9,
            zorder=order(float(near[trunk].mean())),
        )
    )
    for joint, parent in enumerate(PARENTS):
        if parent < 0:
            continue
        name = JOINTS[joint]
        tone = shade(colour, -0.3) if name.startswith("right") else to_rgb(colour)
        axes.plot(
            [x[parent], x[joint]],
            [y[parent], y[joint]],
            color=flat if ghost else tone,
            linewidth=1.3 if ghost else 2.4,
            solid_capstyle="round",
            zorder=order(float(near[joint] + near[parent]) / 2),
        )
    head, neck = JOINTS.index("head"), JOINTS.index("neck")
    along = pose[head] - pose[neck]
    middle = pose[head] + along / max(float(np.linalg.norm(along)), 1e-6) * 0.5 * HEAD_RADIUS
    axes.add_patch(
        Circle(
            (float(middle @ view.right) + shift[0], float(middle @ view.up) + shift[1]),
            HEAD_RADIUS,
            facecolor=flat if ghost else colour,
            edgecolor=PAPER,
            linewidth=0.6,
            alpha=0.6 if ghost else 1.0,
            zorder=order(float(middle @ view.eye)) + 0.01,
        )
    )


def _cell_width(bodies: list[np.ndarray], centre: np.ndarray, right: np.ndarray) -> float:
    """Width in metres of one pose's place in a row: enough for all poses, but no wider than 3.2."""
    reach = max(np.abs((body - centre[:, None]) @ right).max() for body in bodies)
    return float(np.clip(2 * reach + 0.15, 1.3, 3.2))


def filmstrip(
    leader: np.ndarray,
    reactor: np.ndarray,
    path: Path | str,
    truth: np.ndarray | None = None,
    poses: int = 12,
    start: float = 0.0,
    seconds: float = 8.0,
    title: str = "",
) -> Path:
    """Write a PNG of `poses` moments, evenly spread over `seconds` from second `start`, and return its path.

    leader, reactor and truth (the true reactor, in grey behind) are (T, 22, 3) metres, y up. Three rows:
    front, side and top, each moment centred on the middle of the couple. Times and the distance of the
    roots stand below. Raises ValueError where less than two frames of the motion are asked for.
    """
    first = round(start * FPS)
    last = min(round((start + seconds) * FPS), len(leader) - 1)
    if not 0 <= first < last:
        raise ValueError(
            f"nothing to show between {start:g} s and {start + seconds:g} s of {len(leader)} frames"
        )
    frames = np.linspace(first, last, poses).round().astype(int)
    bodies = [motion[frames] for motion in (leader, reactor, truth) if motion is not None]
    centre = (bodies[0][:, 0] + bodies[1][:, 0]) / 2 * np.array([1.0, 0.0, 1.0])
    angles = views(leader[first : last + 1], reactor[first : last + 1])
    cell = max(_cell_width(bodies, centre, view.right) for view in angles[:2])
    top_height = float(np.clip(cell, 1.3, 2.0))

    heights = [CELL_HEIGHT, CELL_HEIGHT, top_height]
    width = min(1.25 * poses * max(cell / 1.3, 1.0), 26.0)
    scale = width / (cell * poses)  # inches per metre
    margins = 0.45, 0.75  # inches below and above
    figure = Figure(figsize=(width + 0.6, sum(heights) * scale + sum(margins)), facecolor=PAPER)
    FigureCanvasAgg(figure)
    rows = figure.subplots(3, 1, gridspec_kw={"height_ratios": heights, "hspace": 0.02})
    total = figure.get_figheight()
    figure.subplots_adjust(
        left=0.5 / (width + 0.6), right=0.995, bottom=margins[0] / total, top=1 - margins[1] / total
    )
    for axes, view, height in zip(rows, angles, heights, strict=True):
        top = view.name == "top"
        axes.set(xlim=(0, cell * poses), ylim=(-height / 2, height / 2) if top else (-0.08, height - 0.08))
        axes.set_aspect("equal")
        axes.axis("off")
        if not top:
            axes.axhline(0, color=RULE, linewidth=1, zorder=0)
        axes.text(-0.012 * poses * cell, height * (0 if top else 0.45), view.name, color=INK, fontsize=9,
                  rotation=90, ha="right", va="center")  # fmt: skip
        for i in range(poses):
            shift = (cell * (i + 0.5) - float(centre[i] @ view.right), -float(centre[i] @ view.up))
            if truth is not None:
                draw_body(axes, bodies[2][i], view, TRUTH, shift, ghost=True)
            draw_body(axes, bodies[0][i], view, LEADER, shift)
            draw_body(axes, bodies[1][i], view, REACTOR, shift)
            if i:
                axes.axvline(cell * i, color=RULE, linewidth=0.6, zorder=0)
    for i, frame in enumerate(frames):
        apart = np.linalg.norm(bodies[1][i, 0] - bodies[0][i, 0])
        rows[2].text(cell * (i + 0.5), -top_height / 2, f"{frame / FPS:.2f} s   {apart:.2f} m", color=INK,
                     fontsize=8, ha="center", va="top")  # fmt: skip
    named = [("leader", LEADER), ("reactor", REACTOR)] + (
        [("true reactor", TRUTH)] if truth is not None else []
    )
    figure.legend(
        handles=[Line2D([], [], color=colour, linewidth=4, label=name) for name, colour in named],
        loc="upper right", ncols=3, frameon=False, fontsize=9, labelcolor=INK,
    )  # fmt: skip
    figure.text(
        0.5 / (width + 0.6), 1 - 0.3 / total, title, color=INK, fontsize=12, va="center", weight="bold"
    )
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=110)
    return path
