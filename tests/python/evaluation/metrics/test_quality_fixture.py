"""The measures that both languages take of a dance.

`python -m tests.python.evaluation.metrics.test_quality_fixture` rewrites tests/fixtures/quality.npz
(a duet) and quality.json (its numbers), which the TypeScript tests read.
"""

import json
from pathlib import Path

import numpy as np
import pytest

from export.manifest import quality_rules
from tests.python.support.duets import made_duet
from training.evaluation.metrics.beats import bas, bed
from training.evaluation.metrics.contact import foot_skating
from training.evaluation.metrics.distance import root_distance
from training.evaluation.metrics.penetration import depth, penetration
from training.evaluation.metrics.seams import against_interior, boundaries, velocity_change

MOTIONS = Path(__file__).parents[3] / "fixtures" / "quality.npz"
NUMBERS = MOTIONS.with_suffix(".json")
MANIFESTS = sorted(Path(__file__).parents[4].glob("web/public/models/*/manifest.json"))
BLOCK = 240  # frames
FRAMES = 2 * BLOCK + 90
STEP = (
    2.0**-12
)  # metres; positions are whole multiples, which compress well and are the same on every machine


def faulty_duet() -> dict[str, np.ndarray]:
    """A made duet with feet that stand and slide, bodies that run into each other, and a jump at the second seam."""
    duet = made_duet(FRAMES, 3)
    leader, reactor = duet.leader.astype(np.float64), duet.reactor.astype(np.float64)
    time = np.arange(FRAMES)
    slide = np.interp(time, [100, 190, 300, 330], [0, 0.5, 0.5, 0])  # 0.17 m/s, then back at 0.5 m/s
    for foot in ([7, 10], [8, 11]):  # two stretches in which a foot stands, moved by the slide alone
        for first, last in ((95, 200), (290, 340)) if 7 in foot else ((20, 120), (400, 470)):
            reactor[first:last, foot] = reactor[first, foot] + slide[first:last, None, None] * np.array(
                [1, 0, 0]
            )
            reactor[first:last, foot, 1] = np.percentile(reactor[:, foot, 1], 3, axis=0)
    reactor[..., 0] -= 0.75 * np.exp(-(((time - 370) / 25) ** 2))[:, None]
    reactor[2 * BLOCK :, :, 2] += 0.04
    neck, head = leader[:, 12], leader[:, 15]
    for first, part in (
        (510, 0.5),
        (530, 1.5),
    ):  # a forearm across the leader's neck, and one through the skull
        for joint, side in ((18, -0.1), (20, 0.1)):
            place = neck + (head - neck) * part + np.array([side, 0, 0])
            reactor[first : first + 12, joint] = place[first : first + 12]
    return {name: np.round(m / STEP) * STEP for name, m in (("leader", leader), ("reactor", reactor))}


def numbers(leader: np.ndarray, reactor: np.ndarray) -> dict:
    """Everything the page shows of a dance, in double precision as there, and curves over its frames."""
    music = np.arange(7, FRAMES, 16)
    seams = boundaries(FRAMES, BLOCK)
    change = velocity_change(reactor)
    return {
        "fps": 30,
        "block": BLOCK,
        "music_beats": music.tolist(),
        "rules": quality_rules(),
        "feet": foot_skating(reactor),
        "closeness": {
            **penetration(leader, reactor),
            "deepest": depth(leader, reactor).max(),
            "closest": root_distance(leader, reactor).min(),
        },
        "beats": {**bed(leader, reactor), **bas(music, reactor)},
        "seams": {"ratio": against_interior(reactor, seams)},
        "seam_frames": seams.tolist(),
        "depth": depth(leader, reactor).tolist(),
        "velocity_change": change[1:-1].tolist(),
    }


def stored() -> dict[str, np.ndarray]:
    with np.load(MOTIONS) as file:
        return {name: file[name].astype(np.float64) for name in ("leader", "reactor")}


def test_the_golden_motions_are_up_to_date() -> None:
    kept = stored()
    for name, motion in faulty_duet().items():
        np.testing.assert_allclose(kept[name], motion, atol=2 * STEP, err_msg=name)


def test_the_golden_numbers_are_up_to_date() -> None:
    old, new = json.loads(NUMBERS.read_text()), numbers(**stored())
    assert old.keys() == new.keys()
    assert old["rules"] == new["rules"]
    for part in old.keys() - {"rules"}:
        assert new[part] == pytest.approx(old[part], rel=1e-9), part


@pytest.mark.parametrize("path", MANIFESTS, ids=lambda path: path.parent.name)
def test_every_manifest_has_the_constants_of_today(path: Path) -> None:
    assert json.loads(path.read_text())["quality"] == quality_rules(), "export the model again"


def test_the_golden_duet_has_every_fault() -> None:
    known = numbers(**stored())
    assert 0.1 < known["feet"]["skate_share"] < 0.9
    assert known["feet"]["contact_share"] > 0.1
    assert 0.05 < known["closeness"]["ipr_capsules"] < 0.5
    assert known["seams"]["ratio"] > 1.5
    assert min(known["beats"][key] for key in ("forward", "value")) > 0.05


if __name__ == "__main__":
    motions = {name: m.astype(np.float32) for name, m in faulty_duet().items()}
    np.savez_compressed(MOTIONS, **motions)  # pyright: ignore
    NUMBERS.write_text(json.dumps(numbers(**stored())) + "\n")
