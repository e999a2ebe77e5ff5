"""BVH files of a made dancer in the names of several programs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from training.data.bvh.names import BVH_NAMES
from training.data.made import made_dancer
from training.motion.skeleton import JOINTS, PARENTS

_DAZ = {
    "pelvis": "hip",
    "spine1": "abdomen",
    "spine2": "chest",
    "spine3": "chestUpper",
    "neck": "neck",
    "head": "head",
} | {
    f"{side}_{ours}": f"{side[0]}{theirs}"
    for side in ("left", "right")
    for ours, theirs in (
        *(("hip", "Thigh"), ("knee", "Shin"), ("ankle", "Foot"), ("foot", "Toe")),
        *(("collar", "Collar"), ("shoulder", "Shldr"), ("elbow", "ForeArm"), ("wrist", "Hand")),
    )
}
_CHARACTER_CREATOR = {
    "pelvis": "CC_Base_Hip",
    "spine1": "CC_Base_Waist",
    "spine2": "CC_Base_Spine01",
    "spine3": "CC_Base_Spine02",
    "neck": "CC_Base_NeckTwist01",
    "head": "CC_Base_Head",
} | {
    f"{side}_{ours}": f"CC_Base_{side[0].upper()}_{theirs}"
    for side in ("left", "right")
    for ours, theirs in (
        *(("hip", "Thigh"), ("knee", "Calf"), ("ankle", "Foot"), ("foot", "ToeBase")),
        *(("collar", "Clavicle"), ("shoulder", "Upperarm"), ("elbow", "Forearm"), ("wrist", "Hand")),
    )
}
NAMES: dict[str, dict[str, str]] = {
    "own": BVH_NAMES,
    "Mixamo": {joint: f"mixamorig{name}" for joint, name in BVH_NAMES.items()},
    # The CMU library's conversion for MotionBuilder has a joint more below the back than we have.
    "CMU": BVH_NAMES | {"spine1": "LowerBack", "spine2": "Spine", "spine3": "Spine1"},
    "DAZ": _DAZ,
    "Character Creator": _CHARACTER_CREATOR,
}


class MadeDancer:
    """A body with constant bones that turns, travels and bends. positions: (frames, 22, 3) metres, y up."""

    def __init__(self, frames: int, seed: int, aside: float = 0.0) -> None:
        rng = np.random.default_rng(seed)
        rest = made_dancer(1, seed=0)[0].astype(np.float64)
        self.offsets = np.array(
            [rest[j] - rest[p] if p >= 0 else np.zeros(3) for j, p in enumerate(PARENTS)], dtype=np.float64
        )
        time = np.arange(frames)[:, None] / 30
        self.root = np.hstack([aside + 0.3 * np.sin(time), 0.95 + 0.02 * np.cos(9 * time), 0.2 * time])
        # Degrees of the local Z, X and Y turns of every joint over time.
        self.angles = 12 * np.sin(2 * time[:, :, None] + rng.uniform(0, 6, (1, len(JOINTS), 3)))
        self.angles[:, 0, 2] += 40 * time[:, 0]
        matrices = np.stack(
            [
                Rotation.from_euler("ZXY", self.angles[:, joint], degrees=True).as_matrix()
                for joint in range(len(JOINTS))
            ],
            axis=1,
        )
        world = matrices.copy()
        self.positions = np.zeros((frames, len(JOINTS), 3), dtype=np.float32)
        self.positions[:, 0] = self.root
        for joint, parent in enumerate(PARENTS):
            if parent >= 0:
                world[:, joint] = world[:, parent] @ matrices[:, joint]
                self.positions[:, joint] = self.positions[:, parent] + world[:, parent] @ self.offsets[joint]


def write_bvh(
    path: Path,
    dancer: MadeDancer,
    convention: str,
    unit: float,
    z_up: bool = False,
    fps: float = 30,
    without: tuple[str, ...] = (),
    hips_offset: tuple[float, float, float] | None = None,
) -> Path:
    """Writes a dancer in a convention's names, without some joints. unit: metres per unit of the file.

    hips_offset: OFFSET of the hips in the file's unit, where they hang on a root that stands still. All joints have
    position channels then, which hold the OFFSET.
    """
    names = NAMES[convention]
    kept = [j for j, joint in enumerate(JOINTS) if joint not in without]
    order: list[int] = []

    def block(joint: int, depth: int) -> list[str]:
        order.append(joint)
        tab = "\t" * depth
        kind = "ROOT" if joint == 0 and hips_offset is None else "JOINT"
        placed = joint == 0 or hips_offset is not None
        place = "Xposition Yposition Zposition " if placed else ""
        offset = dancer.offsets[joint] / unit if joint or hips_offset is None else hips_offset
        lines = [f"{tab}{kind} {names[JOINTS[joint]]}", f"{tab}{{"]
        lines.append(f"{tab}\tOFFSET " + " ".join(f"{v:.6f}" for v in offset))
        lines.append(f"{tab}\tCHANNELS {6 if placed else 3} {place}Zrotation Xrotation Yrotation")
        children = [j for j in kept if PARENTS[j] == joint]
        for child in children:
            lines += block(child, depth + 1)
        if not children and "foot" not in JOINTS[joint] and "ankle" not in JOINTS[joint]:
            lines += [f"{tab}\tEnd Site", f"{tab}\t{{", f"{tab}\t\tOFFSET 0 0 {0.05 / unit}", f"{tab}\t}}"]
        return [*lines, f"{tab}}}"]

    skeleton = ["HIERARCHY", *block(0, 0)]
    if hips_offset is not None:
        skeleton = ["HIERARCHY", "ROOT Reference", "{", "OFFSET 0 0 0", "CHANNELS 0", *skeleton[1:], "}"]
    root, angles = dancer.root / unit, dancer.angles.copy()
    if z_up:
        root = np.stack([root[:, 0], -root[:, 2], root[:, 1]], axis=1)
        turned = Rotation.from_euler("X", 90, degrees=True) * Rotation.from_euler(
            "ZXY", angles[:, 0], degrees=True
        )
        angles[:, 0] = turned.as_euler("ZXY", degrees=True)
    columns = [root, angles[:, 0]]
    for joint in order[1:]:
        if hips_offset is not None:
            columns.append(np.tile(dancer.offsets[joint] / unit, (len(root), 1)))
        columns.append(angles[:, joint])
    rows = np.hstack(columns)
    motion = [
        "MOTION",
        f"Frames: {len(rows)}",
        f"Frame Time: {1 / fps:.7f}",
        *(" ".join(f"{value:.6f}" for value in row) for row in rows),
    ]
    path.write_text("\n".join(skeleton + motion) + "\n")
    return path
