"""The constants of model and training as frozen dataclasses, kept as JSON beside the weights."""

from __future__ import annotations

import dataclasses
import json
import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, get_args

FPS = 30
STRIDE = 4  # motion frames per latent frame (paper 3.2: n = N/4)
StreamName = Literal["upper", "lower", "placement"]
STREAMS: tuple[StreamName, ...] = get_args(StreamName)


def check_limits(options: Any, **limits: tuple[float, float]) -> None:
    """Raises ValueError where a number among the options is below the first or above the second of its limits."""
    for name, (low, high) in limits.items():
        value = getattr(options, name)
        for number in value if isinstance(value, tuple) else (value,):
            if number is not None and not low <= number <= high:
                allowed = f"at least {low:g}" if math.isinf(high) else f"between {low:g} and {high:g}"
                raise ValueError(f"--{name.replace('_', '-')} {number:g} is not {allowed}")


def check_latent_frames(what: str, frames: int) -> None:
    """Raises ValueError for a number of frames that is no whole number of latent frames."""
    if frames <= 0 or frames % STRIDE:
        raise ValueError(f"a {what} of {frames} frames is not a multiple of {STRIDE}, a latent frame")


@dataclass(frozen=True)
class FrameConfig:
    """The frame of reference: the leader's heading, smoothed over time on the whole clip."""

    sigma: float = 15.0  # frames
    radius: int = 45  # frames; the Gaussian is cut at three sigma

    def __post_init__(self) -> None:
        check_limits(self, sigma=(0.1, math.inf), radius=(1, math.inf))


@dataclass(frozen=True)
class MaskingConfig:
    """Progressive masking (paper 3.2): residual masking and code masking, both only while training."""

    residual: float = 0.35  # share of windows whose layers above the base are hidden
    cutoff: float | None = 2.25  # Hz; those windows decode to the motion below it, None to all of it
    base_noise: float = 0.1  # std of the noise on the base layer of those windows, in units of the code range
    code: float = 0.15  # share of windows with code masking
    code_rate: float = 0.1  # share of code dimensions masked in those windows

    def __post_init__(self) -> None:
        check_limits(self, residual=(0, 1), code=(0, 1), code_rate=(0, 1), base_noise=(0, math.inf))
        if self.cutoff is not None and not 0 < self.cutoff < FPS / 2:
            raise ValueError(
                f"--cutoff {self.cutoff:g} Hz is not between 0 and {FPS / 2:g}, half the frame rate"
            )


@dataclass(frozen=True)
class HfsqConfig:
    """Stage 1: autoencoder, quantiser and the weights of its losses (Eq. 1 to 5)."""

    quantiser: Literal["hfsq", "rvq", "kl", "none"] = "hfsq"
    groups: int = 8
    layers: int = 2
    levels: tuple[int, ...] = (8, 5, 5, 5)  # 2^10 codes per group
    scales: tuple[float, ...] = (1.0, 0.25)  # s_r of Eq. 1
    group_width: int = 16
    codebook: int = 1024  # residual VQ only
    widths: tuple[int, int, int] = (192, 192, 96)  # per stream
    depth: int = 3
    refine_width: int = 64
    masking: MaskingConfig | None = field(default_factory=MaskingConfig)
    weight_position: float = 1.0
    weight_velocity: float = 5.0
    weight_acceleration: float = 5.0
    weight_energy: float = 3.0
    weight_latent: float = 0.02
    beta: float = 0.25  # Eq. 5
    weight_kl: float = 1e-4

    def __post_init__(self) -> None:
        check_limits(self, levels=(2, math.inf), scales=(1e-6, math.inf))
        # A deeper decoder would reach farther than RECEPTIVE_FIELD in training/diffusion/decode.py.
        check_limits(self, depth=(1, 6))
        check_limits(self, **dict.fromkeys(("groups", "layers", "group_width", "codebook"), (1, math.inf)))


@dataclass(frozen=True)
class ConditionConfig:
    """The condition encoder. drop_*: shares of windows in which conditions are dropped while training."""

    leader: bool = True
    music: bool = True
    depth: int = 2  # residual blocks with kernel 3 at the latent rate
    drop_layer: float = 0.2  # independent per residual layer (paper 3.5)
    drop_all: float = 0.1
    drop_leader: float = 0.1
    drop_music: float = 0.1
    # Augmentation of the leader's features; what it is worth was not separated (docs/experiment-log.md).
    leader_shift: int = 3  # frames, at most; the leader is early or late in 43 % of the windows
    leader_blur: float = 6.0  # frames, sigma of a Gaussian over time, which removes the leader's timing
    blurred: float = 0.25  # share of windows with a blurred leader

    def __post_init__(self) -> None:
        shares = ("drop_layer", "drop_all", "drop_leader", "drop_music", "blurred")
        check_limits(self, **dict.fromkeys(shares, (0, 1)))
        if not (self.leader or self.music):
            raise ValueError("--no-leader and --no-music together leave nothing to react to")


@dataclass(frozen=True)
class DenoiserConfig:
    """The denoiser of stage 2 (paper 3.3)."""

    width: int = 256
    heads: int = 4
    mlp: int = 3
    depths: tuple[int, ...] = (4, 2)  # transformer layers of the coarse trunk and of the fine head
    alibi_slopes: tuple[float, ...] = (0.0, 0.05, 0.15, 0.5)  # per head, per latent frame (`alibi_bias`)
    block: int = 60  # latent frames
    mask: Literal["causal", "bidirectional"] = "causal"  # of the attention within a block (paper 3.4)
    positions: Literal["periodic", "sinusoidal"] = "periodic"  # Eq. 8, or those of Vaswani et al. 2017
    dropout: float = 0.15  # of channels, for a whole window at once
    condition: ConditionConfig = field(default_factory=ConditionConfig)

    def __post_init__(self) -> None:
        check_limits(self, block=(1, 10_000), dropout=(0, 0.99))


@dataclass(frozen=True)
class DiffusionConfig:
    """Length of the noise schedule, sampling and what follows decoding; see training/diffusion."""

    train_steps: int = 1000
    steps: int = 10
    last_time: float = 0.1  # share of train_steps at which the last step predicts
    # In Python alone: a model with one of these two is not exported.
    extrapolation: tuple[float, float, float] = (0.0, 0.0, 0.0)  # of each stream, see `extrapolated_ddim`
    stitching: bool = False  # windows overlap by half and cross-fade
    guidance: tuple[float, float] = (0.0, 0.0)  # default of coarse and fine, Eq. 9's s
    music_guidance: float = 0.0  # default guidance weight m of the music, see `blend`
    variety: float = 1.0  # default distance v from the mean of several seeds, see `blend`
    mean_seeds: int = 4  # seeds 0, 1, ... whose mean that is
    foot_contact: float = 0.0  # m/s, strength of the foot-contact correction of the root

    def __post_init__(self) -> None:
        check_limits(self, steps=(1, self.train_steps), mean_seeds=(1, 64), foot_contact=(0, math.inf))
        check_limits(self, extrapolation=(-10, 10))


@dataclass(frozen=True)
class ControlRange:
    """Weights that a control of the page reaches, chosen on validation; where the effect is, see docs/results.md."""

    low: float
    high: float
    step: float


CONTROLS = {
    "coarse": ControlRange(-0.6, 0.75, 0.05),
    "fine": ControlRange(-1.0, 1.0, 0.05),
    "music": ControlRange(0.0, 10.0, 0.5),
    "variety": ControlRange(0.0, 2.0, 0.05),
}


@dataclass(frozen=True)
class DenoiserLossConfig:
    """Weights of the losses of stage 2 (Eq. 6 and 7)."""

    layers: tuple[float, ...] = (1.0, 0.5)  # lambda^r of Eq. 6
    snr: float = 0.5  # share of Eq. 6's weight that follows the signal-to-noise ratio
    kinematic: float = 0.02
    velocity: float = 5.0
    acceleration: float = 5.0
    contact: float = 0.5
    energy: float = 0.2
    orientation: float = 0.05
    windows: int = 8  # the windows with least noise in the batch, the only ones that are decoded

    def __post_init__(self) -> None:
        check_limits(self, snr=(0, 1), windows=(0, math.inf))


def to_json(config: Any) -> dict[str, Any]:
    """The fields of a (nested) config, for JSON."""
    return dataclasses.asdict(config)


def from_json(cls: type, values: dict[str, Any]) -> Any:
    """Inverse of `to_json`. Raises ValueError for an unknown or missing key."""
    fields = {f.name: f for f in dataclasses.fields(cls)}
    unknown = set(values) - set(fields)
    missing = set(fields) - set(values)
    if unknown or missing:
        raise ValueError(f"{cls.__name__}: unknown keys {sorted(unknown)}, missing keys {sorted(missing)}")
    out: dict[str, Any] = {}
    for name, value in values.items():
        nested = _NESTED.get((cls.__name__, name))
        if nested and value is not None:
            out[name] = from_json(nested, value)
        elif isinstance(value, list):
            out[name] = tuple(value)
        else:
            out[name] = value
    return cls(**out)


_NESTED: dict[tuple[str, str], type] = {
    ("HfsqConfig", "masking"): MaskingConfig,
    ("DenoiserConfig", "condition"): ConditionConfig,
}


def write_json(path: Path, values: dict[str, Any]) -> None:
    """Writes a JSON file; its folder is made."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(values, indent=2) + "\n")
