"""Rows and measures of the paper's tables, and what each row changes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from training.experiments.scale import DEPTHS, LAYER_WEIGHTS, SCALES

Changes = Mapping[str, str]
"""Options of a training program by name, values separated by blanks; flags and options such as `a.b:none` have none."""


@dataclass(frozen=True)
class Row:
    """One method of a table. stage1 and stage2: options of the two programs that differ from those of all rows."""

    name: str
    stage1: Changes = field(default_factory=dict)
    stage2: Changes = field(default_factory=dict)
    reconstruction: bool = False
    """Measure stage 1 alone: the reactor through the autoencoder and back."""
    baseline: str | None = None
    """A method of `training.baselines` in the denoiser's place."""
    guidance: tuple[float, float] | None = None
    """Of coarse and fine at every step, with the weights of `--checkpoint`: nothing is trained."""


@dataclass(frozen=True)
class Measure:
    """A column. key: in a measured row; better: "lower", "truth" for the nearer to the truth, or ""."""

    label: str
    key: str
    better: str = "lower"


MEASURES: Mapping[str, Measure] = {
    "fid_k": Measure("FID_k", "fid_k corrected"),
    "fid_g": Measure("FID_g", "fid_g corrected"),
    "fid_cd": Measure("FID_cd", "fid_cd"),
    "div_k": Measure("Div_k", "div_k corrected", "truth"),
    "div_g": Measure("Div_g", "div_g corrected", "truth"),
    "div_cd": Measure("Div_cd", "div_cd", "truth"),
    "mpjpe": Measure("MPJPE, mm", "mpjpe_mm"),
    "mpjve": Measure("MPJVE, mm a frame", "mpjve_mm"),
    "root": Measure("root error, mm", "root_error_mm"),
    "pfc": Measure("PFC", "pfc", "truth"),
    "bas": Measure("BAS", "bas", "truth"),
    "bed": Measure("BED", "bed_forward", "truth"),
    "ipr": Measure("IPR (capsules)", "ipr_capsules", "truth"),
    "contact": Measure("feet in contact", "contact_share", "truth"),
    "jitter": Measure("jitter, mm a frame²", "jitter", "truth"),
    "seconds": Measure("seconds a dance", "seconds"),
    "train": Measure("training time, relative", "train", ""),
    "parameters": Measure("parameters, thousands", "parameters", ""),
}


@dataclass(frozen=True)
class Table:
    number: int
    title: str
    measures: tuple[str, ...]
    rows: tuple[Row, ...]
    ours: str
    """Name of the row that others are compared with."""


def _stages(layers: int) -> tuple[Changes, Changes]:
    """Options for R residual layers."""
    return (
        {"hfsq.layers": str(layers), "hfsq.scales": SCALES[layers]},
        {"denoiser.depths": DEPTHS[layers], "loss.layers": LAYER_WEIGHTS[layers]},
    )


NO_MASKING = {"hfsq.masking:none": ""}
RVQ = {"hfsq.quantiser": "rvq", "hfsq.codebook": "256"}
ONE_CODE = {**RVQ, "hfsq.layers": "1", "hfsq.groups": "1", "hfsq.group-width": "64", **NO_MASKING}
KL = {"hfsq.quantiser": "kl", "hfsq.layers": "1", **NO_MASKING}
ONE_LAYER = {"denoiser.depths": DEPTHS[1], "loss.layers": LAYER_WEIGHTS[1]}
STITCHING = {
    "denoiser.mask": "bidirectional",
    "denoiser.positions": "sinusoidal",
    "diffusion.stitching": "",
}

_TOKENISERS: tuple[tuple[str, Changes, Changes], ...] = (
    ("VAE", KL, ONE_LAYER),
    ("RVQ-VAE without PM", {**RVQ, **NO_MASKING}, {}),
    ("RVQ-VAE with PM", RVQ, {}),
    ("HFSQ without PM", NO_MASKING, {}),
    ("HFSQ with PM", {}, {}),
)
_LAYERS: tuple[tuple[str, Changes, Changes], ...] = (
    ("R = 1", *_stages(1)),
    ("R = 2", {}, {}),
    ("R = 3", *_stages(3)),
    ("R = 4", *_stages(4)),
)
_GUIDANCE = ((0.0, 0.0), (1.0, 1.0), (1.0, 1.2), (1.0, 1.5), (1.2, 1.2), (1.2, 1.5), (1.5, 1.5))


def _both_stages(rows: tuple[tuple[str, Changes, Changes], ...]) -> tuple[Row, ...]:
    """Every row as a reconstruction, then every row whole."""
    return (
        *(Row(f"reconstruction: {name}", one, two, reconstruction=True) for name, one, two in rows),
        *(Row(name, one, two) for name, one, two in rows),
    )


_ALL = (
    Table(
        1,
        "Baselines",
        (
            *("fid_k", "fid_g", "div_k", "div_g", "mpjpe", "mpjve", "root", "pfc", "bas"),
            *("fid_cd", "div_cd", "bed", "ipr", "contact", "seconds", "parameters"),
        ),
        (
            Row("GestureLSM", RVQ, baseline="gesturelsm"),
            Row("EDGE", baseline="edge"),
            Row("TCDiff", baseline="tcdiff"),
            Row("InterGen", baseline="intergen"),
            Row("Duolando", ONE_CODE, baseline="duolando"),
            Row("ReactDance"),
        ),
        "ReactDance",
    ),
    Table(
        2,
        "Tokenisers and progressive masking (PM)",
        ("fid_g", "div_g", "mpjpe", "bas"),
        _both_stages(_TOKENISERS),
        "HFSQ with PM",
    ),
    Table(
        3,
        "Dense sliding window and blockwise local context",
        ("fid_cd", "div_cd", "bed", "seconds"),
        (
            Row("stride 64", stage2={"stride": "64"}),
            Row("stride 16", stage2={"stride": "16"}),
            Row("stitching without periodic positions and causal mask", stage2=STITCHING),
            Row("stride 4, blockwise"),
        ),
        "stride 4, blockwise",
    ),
    Table(
        4,
        "Guidance of coarse and fine at every step",
        ("fid_k", "fid_g", "div_k", "div_g", "mpjpe", "mpjve", "bas", "fid_cd", "div_cd", "bed"),
        tuple(Row(f"S = [{c}, {f}]", guidance=(c, f)) for c, f in _GUIDANCE),
        "S = [1.2, 1.2]",
    ),
    Table(
        5,
        "Residual layers R",
        ("fid_k", "fid_g", "mpjpe", "fid_cd", "train", "parameters"),
        _both_stages(_LAYERS),
        "R = 2",
    ),
    # The paper has a stride of 1 too. Here a latent frame has four frames, so 4 is the least.
    Table(
        6,
        "Stride of the training windows",
        ("fid_cd", "bed", "jitter", "train"),
        (
            *(Row(f"stride {s}", stage2={"stride": str(s)}) for s in (128, 64, 16)),
            Row("stride 4"),
        ),
        "stride 4",
    ),
    Table(
        8,
        "Conditions",
        ("mpjpe", "mpjve", "root", "fid_cd", "bas"),
        (
            Row("without the leader", stage2={"denoiser.condition.no-leader": ""}),
            Row("without music", stage2={"denoiser.condition.no-music": ""}),
            Row("both"),
        ),
        "both",
    ),
)

TABLES: Mapping[int, Table] = {table.number: table for table in _ALL}
