"""What the report films, and of which seed."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tests.python.support.duets import made_duet
from training.evaluation.evaluate import Evaluation
from training.evaluation.out_of_distribution import OutOfDistributionDance
from training.evaluation.protocol import HeldOutDuet
from training.evaluation.report.report import film
from training.evaluation.report.video import write_video


def test_the_report_films_the_first_seed(tmp_path: Path):
    duet, solo = made_duet(8, 1, "one"), made_duet(4, 2, "martial_1")
    made = [duet.reactor + np.float32(0.1 * seed) for seed in (1, 2)]
    swapped = [duet.leader + np.float32(0.1 * seed) for seed in (1, 2)]
    others = [OutOfDistributionDance(f"martial_{n}", solo.leader, solo.reactor) for n in (1, 2)]
    filmed = film(
        [HeldOutDuet(duet, None)],
        Evaluation({}, {"generated": {"one": made}}, {"one": swapped}, others),
        tmp_path,
    )
    assert [path.name for path in filmed] == [
        "one.webm",
        "one-role-swap.webm",
        "out-of-distribution-martial_1.webm",
    ]
    for path, leader, reactors in zip(
        filmed,
        (duet.leader, duet.reactor, solo.leader),
        (
            {"truth": duet.reactor, "generated": made[0]},
            {"truth": duet.leader, "reactor leads": swapped[0]},
            {"generated": solo.reactor},
        ),
        strict=True,
    ):
        alone = write_video(leader, reactors, tmp_path / "alone.webm")
        assert path.read_bytes() == alone.read_bytes(), path.name
