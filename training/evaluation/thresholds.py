"""Acceptance thresholds on held-out duets: what a model has to reach (`REQUIRED`), and what a good model reaches
(`TARGETS`), which is measured and reported whether reached or not.

The generated joints and the skeleton that is fitted to them (the rows `solved`) are held to the same limits, except
for the variation of bone lengths. Two names stand for a measure of their own: "told from the truth" is the accuracy
of the classifier two-sample test (`metrics.twosample`), "seams" the boundary jitter ratio (`metrics.seams`).
"""

from __future__ import annotations

from math import inf, isfinite, nextafter

from training.evaluation.limits import (
    Numbers,
    Threshold,
    ThresholdResult,
    at_end,
    beat_echo,
    check,
    constant,
    of_duet,
    of_row,
    of_section,
    points_above,
    ratio,
    repeats_above_truth,
)
from training.evaluation.metrics.speed import BANDS, band_name

BELOW_1 = nextafter(1.0, 0.0)  # "smaller than 1" as an upper limit
BELOW_1_PERCENT = nextafter(0.01, 0.0)  # of a p value


def _required_of(row: str, prefix: str) -> tuple[Threshold, ...]:
    """Thresholds of a row of generated motion."""
    return (
        Threshold(f"{prefix}mean joint speed over the truth's", of_row(row, "speed_ratio"), 0.7, 1.3),
        Threshold(
            f"{prefix}median root distance over the truth's", of_row(row, "distance_ratio"), 0.75, 1.25
        ),
        Threshold(f"{prefix}MPJPE, mm", of_row(row, "mpjpe_mm"), -inf, 125),
        Threshold(f"{prefix}relative-root error, mm", of_row(row, "root_error_mm"), -inf, 280),
    )


REQUIRED: tuple[Threshold, ...] = (
    Threshold("reconstruction MPJPE, mm", of_row("reconstruction", "mpjpe_mm"), -inf, 35),
    Threshold("reconstruction root error, mm", of_row("reconstruction", "root_error_mm"), -inf, 50),
    *_required_of("generated", ""),
    *_required_of("solved", "solved: "),
    Threshold("seams over the truth's", of_section("seams", "ratio"), -inf, 1.3),
    Threshold("number of seams measured", of_section("seams", "seams"), 50, inf),
    Threshold(
        "rise of root error with another leader",
        of_section("responses", "other_leader_raises_root_error"),
        0.2,
        inf,
    ),
    Threshold("two seeds apart in pose, mm", of_section("responses", "seeds_apart_pose_mm"), 5, inf),
)


def check_required(numbers: Numbers) -> list[ThresholdResult]:
    """Results of all of `REQUIRED` whose values are among the numbers of `training.evaluation.evaluate`."""
    return check(numbers, REQUIRED)


def _errors_and_speed(row: str, prefix: str) -> tuple[Threshold, ...]:
    """Distance from the truth, and energy of the motion beside the truth's."""
    return (
        Threshold(f"{prefix}relative-root error, mm", of_row(row, "root_error_mm"), -inf, 215),
        Threshold(f"{prefix}MPJPE, mm", of_row(row, "mpjpe_mm"), -inf, 95),
        Threshold(f"{prefix}mean joint speed over the truth's", of_row(row, "speed_ratio"), 0.9, 1.1),
        Threshold(
            f"{prefix}mean joint acceleration over the truth's", of_row(row, "acceleration_ratio"), 0.9, 1.1
        ),
        *(
            Threshold(
                f"{prefix}energy in {band} against the truth, dB", of_row(row, f"energy_db {band}"), -3, 3
            )
            for band in (band_name(*edges) for edges in BANDS)
        ),
    )


def _contact_and_partner(row: str, prefix: str) -> tuple[Threshold, ...]:
    """Feet on the floor, bodies beside each other, beats with the partner."""
    nearest = "nearest neighbour"
    return (
        Threshold(f"{prefix}skating over the truth's", ratio(row, "skate_share", "truth"), -inf, 1.15),
        Threshold(
            f"{prefix}feet in contact over the truth's", ratio(row, "contact_share", "truth"), 0.85, 1.15
        ),
        Threshold(
            f"{prefix}IPR (capsules) above the truth's, points",
            points_above(row, "ipr_capsules", "truth"),
            -inf,
            3,
        ),
        Threshold(
            f"{prefix}hand distance, W1 over nearest neighbour's",
            ratio(row, "hands_w1_m", nearest),
            -inf,
            BELOW_1,
        ),
        Threshold(
            f"{prefix}facing, W1 over nearest neighbour's",
            ratio(row, "facing_w1_deg", nearest),
            -inf,
            BELOW_1,
        ),
        Threshold(f"{prefix}BED forward above chance over the truth's", beat_echo(row, "forward"), 0.6, inf),
        Threshold(
            f"{prefix}BED backward above chance over the truth's", beat_echo(row, "backward"), 0.6, inf
        ),
        Threshold(f"{prefix}motion beats over the truth's", of_row(row, "beats_ratio"), 0.85, 1.15),
    )


def _targets_of_controls() -> tuple[Threshold, ...]:
    """A control moves the dance over its travel, and changes its own end of the spectrum alone."""
    tolerance = 0.25  # of the energy that coarse guidance leaves alone
    return (
        *(
            Threshold(
                f"coarse at its {end} end moves {what}, mm",
                at_end("coarse", end, f"{what}_moved_mm"),
                mm,
                inf,
            )
            for end, what, mm in (
                ("lower", "pose", 60),
                ("lower", "root", 200),
                ("upper", "pose", 30),
                ("upper", "root", 100),
            )
        ),
        *(
            Threshold(
                f"coarse at its {end} end: energy over 3 Hz",
                at_end("coarse", end, "quick_ratio"),
                1 - tolerance,
                1 + tolerance,
            )
            for end in ("lower", "upper")
        ),
        Threshold(
            "fine at its lower end: energy over 3 Hz", at_end("fine", "lower", "quick_ratio"), -inf, 0.5
        ),
        Threshold(
            "fine at its upper end: energy over 3 Hz", at_end("fine", "upper", "quick_ratio"), 2.5, inf
        ),
        *(
            Threshold(
                f"fine at its {end} end: energy under 1.5 Hz", at_end("fine", end, "slow_ratio"), 0.9, 1.1
            )
            for end in ("lower", "upper")
        ),
        Threshold(
            "fine at its upper end: acceleration over the truth's",
            at_end("fine", "upper", "acceleration_ratio"),
            -inf,
            1.6,
        ),
        Threshold(
            "music at its upper end: two songs apart in pose, mm",
            at_end("music", "upper", "songs_apart_mm"),
            50,
            inf,
        ),
    )


TARGETS: tuple[Threshold, ...] = (
    Threshold("reconstruction MPJPE, mm", of_row("reconstruction", "mpjpe_mm"), -inf, 25),
    Threshold("reconstruction root error, mm", of_row("reconstruction", "root_error_mm"), -inf, 25),
    *_errors_and_speed("generated", ""),
    *_contact_and_partner("generated", ""),
    Threshold("variation of raw bones", of_row("generated", "bone_variation"), -inf, 0.02),
    *_errors_and_speed("solved", "solved: "),
    *_contact_and_partner("solved", "solved: "),
    Threshold(
        "foot lock: skating over the truth's", ratio("solved, foot lock", "skate_share", "truth"), -inf, 1.15
    ),
    Threshold(
        "foot lock: skating over without", ratio("solved, foot lock", "skate_share", "solved"), -inf, 0.5
    ),
    Threshold("two minutes: repeated windows above the truth's, points", repeats_above_truth, -inf, 5),
    Threshold("two seeds apart in pose, mm", of_section("responses", "seeds_apart_pose_mm"), 45, inf),
    Threshold("told from the truth, accuracy", of_section("two_sample", "generated"), -inf, 0.66),
    Threshold("seams over the truth's", of_section("seams", "ratio"), 0.9, 1.15),
    Threshold(
        "another song's change over another leader's", of_section("responses", "song_over_leader"), 0.1, inf
    ),
    *_targets_of_controls(),
)


def check_targets(numbers: Numbers) -> list[ThresholdResult]:
    """Results of all of `TARGETS`, and of those of single duets, whose values are among the numbers."""
    return check(numbers, [*TARGETS, *_targets_of_duets(numbers)])


def _targets_of_duets(numbers: Numbers) -> list[Threshold]:
    """BAS of each duet within the 95 % interval of the truth's, unless its beats are unknown; and the half-beat test.

    p alone says that something changes with the music; `following` says that the motion moves with it.
    """
    targets: list[Threshold] = []
    truth = numbers["rows"]["truth"]["trials"]
    for duet in (name for name in numbers["trials"] if name not in numbers["beats_unknown"]):
        low, high = (truth[duet]["mean"].get(f"bas_{end}") for end in ("low", "high"))
        if low is None or high is None or not isfinite(low):
            continue
        for row, prefix in (("generated", ""), ("solved", "solved: ")):
            name = f"{prefix}BAS of {duet} in the truth's interval"
            targets.append(Threshold(name, of_duet(row, duet, "bas"), low, high))
    for duet, test in numbers.get("beat_following", {}).items():
        p, following = constant(test["p"]), constant(test["following"])
        targets.append(Threshold(f"half a beat later, {duet}: p", p, -inf, BELOW_1_PERCENT))
        targets.append(Threshold(f"half a beat later, {duet}: following", following, 0.0, inf))
    return targets
