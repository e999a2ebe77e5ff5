"""What a model has to reach on held-out duets (`BARS`), so that an evaluation can say pass or fail, and what a good
model reaches (`QUALITY`): measured and reported whether reached or not.

The graphs' joints and the skeleton solved onto them are held to the same limits, except for raw bones.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, isfinite, nextafter
from typing import Any

from training.evaluation.metrics.speed import BANDS, band_name

Numbers = dict[str, Any]


@dataclass(frozen=True)
class Bar:
    """A measured value that has to lie between two limits."""

    name: str
    value: float
    low: float
    high: float

    @property
    def passed(self) -> bool:
        return self.low <= self.value <= self.high  # NaN fails

    @property
    def limits(self) -> str:
        if self.low == -inf:
            return f"at most {self.high:g}"
        return f"at least {self.low:g}" if self.high == inf else f"{self.low:g} to {self.high:g}"


def of_row(name: str, key: str) -> Callable[[Numbers], float | None]:
    def read(numbers: Numbers) -> float | None:
        row = numbers["rows"].get(name)
        return None if row is None else row["mean"].get(key)

    return read


def of_probe(section: str, key: str) -> Callable[[Numbers], float | None]:
    return lambda numbers: numbers.get(section, {}).get(key)


Rule = tuple[str, Callable[[Numbers], float | None], float, float]
"""Name, how to read it, limits; what a report does not have is left out."""


def _of_motion(row: str, prefix: str) -> tuple[Rule, ...]:
    """Bars on a row of generated motion: the joints that the graphs give, or the skeleton solved onto them."""
    return (
        (f"{prefix}mean joint speed over the truth's", of_row(row, "speed_ratio"), 0.7, 1.3),
        (f"{prefix}median root distance over the truth's", of_row(row, "distance_ratio"), 0.75, 1.25),
        (f"{prefix}MPJPE, mm", of_row(row, "mpjpe_mm"), -inf, 125),
        (f"{prefix}relative-root error, mm", of_row(row, "root_error_mm"), -inf, 280),
    )


BARS: tuple[Rule, ...] = (
    ("reconstruction MPJPE, mm", of_row("reconstruction", "mpjpe_mm"), -inf, 35),
    ("reconstruction root error, mm", of_row("reconstruction", "root_error_mm"), -inf, 50),
    *_of_motion("generated", ""),
    *_of_motion("solved", "solved: "),
    ("seams over the truth's", of_probe("seams", "ratio"), -inf, 1.3),
    ("number of seams measured", of_probe("seams", "seams"), 50, inf),
    (
        "rise of root error with another leader",
        of_probe("responses", "other_leader_raises_root_error"),
        0.2,
        inf,
    ),
    ("two seeds apart in pose, mm", of_probe("responses", "seeds_apart_pose_mm"), 5, inf),
)


def judge(numbers: Numbers, rules: Sequence[Rule]) -> list[Bar]:
    """Every rule whose measure is among the numbers."""
    read = [(name, value(numbers), low, high) for name, value, low, high in rules]
    return [Bar(name, float(value), low, high) for name, value, low, high in read if value is not None]


def check(numbers: Numbers) -> list[Bar]:
    """All bars that the numbers of `training.evaluation.evaluate` can be held to."""
    return judge(numbers, BARS)


LESS = nextafter(1.0, 0.0)  # "smaller than" as an upper limit of a ratio
BEATS_UNKNOWN = frozenset({"salsa_05"})  # its tempo cannot be told from its steps, so neither can its beats


def _mean(numbers: Numbers, row: str, key: str) -> float | None:
    return numbers["rows"].get(row, {}).get("mean", {}).get(key)


def _beside(
    row: str, key: str, other: str, how: Callable[[float, float], float]
) -> Callable[[Numbers], float | None]:
    """A measure of one row beside the same of another."""

    def read(numbers: Numbers) -> float | None:
        value, reference = _mean(numbers, row, key), _mean(numbers, other, key)
        return None if value is None or reference is None else how(value, reference)

    return read


def _ratio(value: float, reference: float) -> float:
    return value / reference if reference else float("nan")


def _points_above(value: float, reference: float) -> float:
    return (value - reference) * 100


def _answered(row: str, direction: str) -> Callable[[Numbers], float | None]:
    """Beat echo above its own chance over the truth's above its own.

    Each has its own chance, since more motion beats meet more of the partner's by accident.
    """

    def read(numbers: Numbers) -> float | None:
        def excess(name: str) -> float | None:
            value, chance = (_mean(numbers, name, f"bed_{direction}{end}") for end in ("", "_chance"))
            return None if value is None or chance is None else value - chance

        made, true = excess(row), excess("truth")
        if made is None or true is None:
            return None
        return made / true if true > 0 else float("nan")  # a truth without echo sets no bar

    return read


def _quality_of(row: str, prefix: str) -> tuple[Rule, ...]:
    """What good motion reaches, of the joints that the graphs give or of the skeleton solved onto them."""
    return (
        (f"{prefix}relative-root error, mm", of_row(row, "root_error_mm"), -inf, 200),
        (f"{prefix}MPJPE, mm", of_row(row, "mpjpe_mm"), -inf, 100),
        (f"{prefix}mean joint speed over the truth's", of_row(row, "speed_ratio"), 0.9, 1.1),
        (f"{prefix}mean joint acceleration over the truth's", of_row(row, "acceleration_ratio"), 0.9, 1.1),
        *(
            (f"{prefix}energy in {band} against the truth, dB", of_row(row, f"energy_db {band}"), -3, 3)
            for band in (band_name(*edges) for edges in BANDS)
        ),
        (f"{prefix}skating over the truth's", _beside(row, "skate_share", "truth", _ratio), -inf, 1.15),
        (
            f"{prefix}feet in contact over the truth's",
            _beside(row, "contact_share", "truth", _ratio),
            0.85,
            1.15,
        ),
        (
            f"{prefix}IPR (capsules) above the truth's, points",
            _beside(row, "ipr_capsules", "truth", _points_above),
            -inf,
            3,
        ),
        (
            f"{prefix}hand distance, W1 over nearest neighbour's",
            _beside(row, "hands_w1_m", "nearest neighbour", _ratio),
            -inf,
            LESS,
        ),
        (
            f"{prefix}facing, W1 over nearest neighbour's",
            _beside(row, "facing_w1_deg", "nearest neighbour", _ratio),
            -inf,
            LESS,
        ),
        (f"{prefix}BED forward above chance over the truth's", _answered(row, "forward"), 0.6, inf),
        (f"{prefix}BED backward above chance over the truth's", _answered(row, "backward"), 0.6, inf),
        (f"{prefix}motion beats over the truth's", of_row(row, "beats_ratio"), 0.85, 1.15),
    )


def _repeated(numbers: Numbers) -> float | None:
    """Share of windows that come again in a long dance, over the truth's, in points."""
    dance = numbers.get("long_dance")
    return dance and _points_above(dance["generated"]["repeat_share"], dance["truth"]["repeat_share"])


def _size(read: Callable[[Numbers], float | None]) -> Callable[[Numbers], float | None]:
    """How far, in either direction."""

    def size(numbers: Numbers) -> float | None:
        value = read(numbers)
        return None if value is None else abs(value)

    return size


QUALITY: tuple[Rule, ...] = (
    ("reconstruction MPJPE, mm", of_row("reconstruction", "mpjpe_mm"), -inf, 25),
    ("reconstruction root error, mm", of_row("reconstruction", "root_error_mm"), -inf, 25),
    *_quality_of("generated", ""),
    ("variation of raw bones", of_row("generated", "bone_variation"), -inf, 0.02),
    *_quality_of("solved", "solved: "),
    (
        "foot lock: skating over the truth's",
        _beside("solved, foot lock", "skate_share", "truth", _ratio),
        -inf,
        1.15,
    ),
    (
        "foot lock: skating over without",
        _beside("solved, foot lock", "skate_share", "solved", _ratio),
        -inf,
        0.5,
    ),
    ("two minutes: repeated windows above the truth's, points", _repeated, -inf, 5),
    ("two seeds apart in pose, mm", of_probe("responses", "seeds_apart_pose_mm"), 40, inf),
    ("told from the truth, accuracy", of_probe("two_sample", "generated"), -inf, 0.66),
    ("seams over the truth's", of_probe("seams", "ratio"), 0.9, 1.15),
    ("another song's change over another leader's", of_probe("responses", "song_over_leader"), 0.1, inf),
    *(
        rule
        for layer, own, other in (
            ("coarse", "under 1.5 Hz", "over 3 Hz"),
            ("fine", "over 3 Hz", "under 1.5 Hz"),
        )
        for rule in (
            (
                f"{layer} guidance moves energy {own} by",
                _size(of_probe("separability", f"{layer}_moves_own")),
                0.05,
                inf,
            ),
            (
                f"{layer} guidance leaves energy {other}",
                of_probe("separability", f"{layer}_moves_other"),
                -0.1,
                0.1,
            ),
        )
    ),
)


def _trial_rules(numbers: Numbers) -> list[Rule]:
    """Bars that stand for one trial: BAS within the interval of the truth's, and following half a beat.

    p alone says that something changes with the music; that the motion turns round with it, `following` says.
    """
    rules: list[Rule] = []
    truth = numbers["rows"]["truth"]["trials"]
    for trial in (t for t in numbers["trials"] if t not in BEATS_UNKNOWN):
        low, high = (truth[trial]["mean"].get(f"bas_{end}") for end in ("low", "high"))
        if low is None or high is None or not isfinite(low):
            continue
        for row, prefix in (("generated", ""), ("solved", "solved: ")):
            rules.append(
                (f"{prefix}BAS of {trial} in the truth's interval", _of_trial(row, trial, "bas"), low, high)
            )
    for trial, test in numbers.get("beat_following", {}).items():
        rules.append((f"half a beat later, {trial}: p", _constant(test["p"]), -inf, nextafter(0.01, 0.0)))
        rules.append((f"half a beat later, {trial}: following", _constant(test["following"]), 0.0, inf))
    return rules


def _of_trial(row: str, trial: str, key: str) -> Callable[[Numbers], float | None]:
    return lambda numbers: (
        numbers["rows"].get(row, {}).get("trials", {}).get(trial, {}).get("mean", {}).get(key)
    )


def _constant(value: float) -> Callable[[Numbers], float | None]:
    return lambda _: value


def check_quality(numbers: Numbers) -> list[Bar]:
    """All bars of quality that the numbers of `training.evaluation.evaluate` can be held to."""
    return judge(numbers, [*QUALITY, *_trial_rules(numbers)])
