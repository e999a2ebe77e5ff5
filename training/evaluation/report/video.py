"""A video of one leader with several reactors side by side, from the front and from the side.

Drawn with Pillow lines, not with matplotlib: a minute of dance is 1800 frames.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from scipy.ndimage import gaussian_filter1d

from training.config import FPS
from training.evaluation.report.filmstrip import (
    HEAD_RADIUS,
    INK,
    LEADER,
    PAPER,
    REACTOR,
    RULE,
    TRUNK,
    View,
    shade,
    views,
)
from training.evaluation.report.webm import webm
from training.motion.skeleton import JOINTS, PARENTS

CELL_PIXELS = (400, 320)  # width and height of one couple from one side
CAPTION_PIXELS = 28  # above the cells
SUPERSAMPLING = 2  # drawn so many times larger and then averaged: Pillow's lines have hard edges
LIMB_WIDTH = 0.045  # metres
HEIGHT = 2.15  # metres that a cell shows at least, in height
CAMERA_SIGMA_FRAMES = (
    30.0  # of the Gaussian that smooths the camera's path, so that single steps do not move it
)

_TRUNK = [JOINTS.index(name) for name in TRUNK]
_HEAD, _NECK = JOINTS.index("head"), JOINTS.index("neck")


@dataclass(frozen=True)
class Camera:
    """A parallel projection that goes with the couple: centre (T, 3) metres in the room, pixels per metre."""

    view: View
    centre: np.ndarray
    scale: float

    def project(self, pose: np.ndarray, frame: int, corner: tuple[int, int]) -> np.ndarray:
        """Pose (22, 3) to pixels (22, 2) in the cell at a corner, and how near (22,): (22, 3)."""
        seen = pose - self.centre[frame]
        x = corner[0] + CELL_PIXELS[0] * SUPERSAMPLING / 2 + seen @ self.view.right * self.scale
        y = corner[1] + CELL_PIXELS[1] * SUPERSAMPLING * 0.94 - seen @ self.view.up * self.scale
        return np.stack([x, y, seen @ self.view.eye], axis=-1)


def cameras(leader: np.ndarray, reactors: Sequence[np.ndarray]) -> tuple[Camera, Camera]:
    """Front and side of all dancers (T, 22, 3), the same for every couple so that places can be compared."""
    beside = np.mean([reactor[:, 0] for reactor in reactors], axis=0)
    middle = (leader[:, 0] + beside) / 2 * np.array([1.0, 0.0, 1.0])
    centre = gaussian_filter1d(middle.astype(np.float64), CAMERA_SIGMA_FRAMES, axis=0, mode="nearest")
    result = []
    for view in views(leader, reactors[0])[:2]:
        reach = max(float(np.abs((m - centre[:, None]) @ view.right).max()) for m in (leader, *reactors))
        width = max(2 * (reach + 2 * HEAD_RADIUS), HEIGHT * CELL_PIXELS[0] / CELL_PIXELS[1])
        result.append(Camera(view, centre, CELL_PIXELS[0] * SUPERSAMPLING / width))
    return result[0], result[1]


@cache
def _colour(name: str, joint: int) -> tuple[int, int, int]:
    """A limb's colour; the body's right side is darker, so that left and right can be told apart."""
    red, green, blue = shade(name, -0.3 if JOINTS[joint].startswith("right") else 0.0)
    return round(red * 255), round(green * 255), round(blue * 255)


def _draw_couple(
    draw: ImageDraw.ImageDraw,
    bodies: dict[str, np.ndarray],
    camera: Camera,
    frame: int,
    corner: tuple[int, int],
) -> None:
    """Bodies (22, 3) by colour into the cell at a corner; what is nearer covers what is farther."""
    floor = corner[1] + CELL_PIXELS[1] * SUPERSAMPLING * 0.94
    draw.line(
        [(corner[0], floor), (corner[0] + CELL_PIXELS[0] * SUPERSAMPLING, floor)],
        fill=RULE,
        width=2 * SUPERSAMPLING,
    )
    width, radius = round(LIMB_WIDTH * camera.scale), HEAD_RADIUS * camera.scale
    parts = []
    for colour, pose in bodies.items():
        seen = camera.project(pose, frame, corner)
        light = tuple(round(part * 255) for part in shade(colour, 0.45))
        parts.append((seen[_TRUNK, 2].mean(), "trunk", seen[_TRUNK, :2], light))
        for joint, parent in enumerate(PARENTS):
            if parent >= 0:
                near = (seen[parent, 2] + seen[joint, 2]) / 2
                parts.append((near, "bone", seen[[parent, joint], :2], _colour(colour, joint)))
        along = pose[_HEAD] - pose[_NECK]
        up = along / max(float(np.linalg.norm(along)), 1e-6) * 0.5 * HEAD_RADIUS
        middle = camera.project(pose[_HEAD : _HEAD + 1] + up, frame, corner)
        parts.append((middle[0, 2] + 0.01, "head", middle[:, :2], _colour(colour, _HEAD)))
    for _, kind, points, colour in sorted(parts, key=lambda part: part[0]):
        flat = [(float(x), float(y)) for x, y in points]
        if kind == "trunk":
            draw.polygon(flat, fill=colour)
        elif kind == "head":
            draw.circle(flat[0], radius, fill=colour)
        else:
            draw.line(flat, fill=colour, width=width)
            for point in flat:  # round ends
                draw.circle(point, width / 2, fill=colour)


def pictures(leader: np.ndarray, reactors: Mapping[str, np.ndarray]) -> Iterator[Image.Image]:
    """One RGB picture for every frame: a column for each reactor under its name, front above, side below."""
    lengths = [len(leader), *(len(reactor) for reactor in reactors.values())]
    if len(lengths) < 2 or min(lengths) != max(lengths) or not lengths[0]:
        raise ValueError(f"cannot show {' and '.join(map(str, lengths))} frames side by side")
    sides = cameras(leader, list(reactors.values()))
    size = (len(reactors) * CELL_PIXELS[0], 2 * CELL_PIXELS[1] + CAPTION_PIXELS)
    font = ImageFont.load_default(15)
    for frame in range(len(leader)):
        large = Image.new("RGB", (size[0] * SUPERSAMPLING, size[1] * SUPERSAMPLING), PAPER)
        draw = ImageDraw.Draw(large)
        for column, reactor in enumerate(reactors.values()):
            for row, camera in enumerate(sides):
                left, top = column * CELL_PIXELS[0], CAPTION_PIXELS + row * CELL_PIXELS[1]
                corner = (left * SUPERSAMPLING, top * SUPERSAMPLING)
                bodies = {LEADER: leader[frame], REACTOR: reactor[frame]}
                _draw_couple(draw, bodies, camera, frame, corner)
        picture = large.reduce(SUPERSAMPLING)
        caption = ImageDraw.Draw(picture)
        for column, name in enumerate(reactors):
            caption.text(((column + 0.5) * CELL_PIXELS[0], 16), name, fill=INK, font=font, anchor="mm")
            if column:
                caption.line(
                    [(column * CELL_PIXELS[0], CAPTION_PIXELS), (column * CELL_PIXELS[0], size[1])], fill=RULE
                )
        caption.text((size[0] - 8, 16), f"{frame / FPS:.1f} s", fill=INK, font=font, anchor="rm")
        yield picture


def write_video(leader: np.ndarray, reactors: Mapping[str, np.ndarray], path: Path) -> Path:
    """Write the WebM of a leader and its reactors by name, (T, 22, 3) metres each; returns its path."""
    path.write_bytes(webm(pictures(leader, reactors)))
    return path
