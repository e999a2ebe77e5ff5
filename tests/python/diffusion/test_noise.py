"""The noise both languages share. `python tests/python/diffusion/test_noise.py` rewrites tests/fixtures/noise.json."""

import json
from pathlib import Path

import numpy as np
import pytest

from training.diffusion.noise import noise, philox

GOLDEN = Path(__file__).parents[2] / "fixtures" / "noise.json"
CASES = [
    {"seed": 0, "frames": 3, "channels": 8, "start": 0},
    {"seed": 1234, "frames": 2, "channels": 192, "start": 58},
    {"seed": 0xFFFFFFFF, "frames": 2, "channels": 6, "start": 100_000},
    {"seed": 7, "frames": 4, "channels": 64, "start": 599},
]


def golden() -> dict:
    return {"cases": [{**case, "values": noise(**case).ravel().astype(float).tolist()} for case in CASES]}


# Known answers published with the Random123 library (kat_vectors, philox4x32 with 10 rounds).
@pytest.mark.parametrize(
    ("counter", "key", "expected"),
    [
        ([0] * 4, (0, 0), [0x6627E8D5, 0xE169C58D, 0xBC57AC4C, 0x9B00DBD8]),
        ([0xFFFFFFFF] * 4, (0xFFFFFFFF,) * 2, [0x408F276D, 0x41C83B0E, 0xA20BC7C6, 0x6D5451FD]),
        (
            [0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344],
            (0xA4093822, 0x299F31D0),
            [0xD16CFE09, 0x94FDCCEB, 0x5001E420, 0x24126EA1],
        ),
    ],
)
def test_philox_gives_the_published_answers(
    counter: list[int], key: tuple[int, int], expected: list[int]
) -> None:
    assert philox(np.array(counter, dtype=np.uint32), key).tolist() == expected


def test_the_golden_file_is_up_to_date() -> None:
    stored = json.loads(GOLDEN.read_text())["cases"]
    assert [{k: v for k, v in case.items() if k != "values"} for case in stored] == CASES
    for case, fresh in zip(stored, golden()["cases"], strict=True):
        np.testing.assert_allclose(case["values"], fresh["values"], atol=1e-7)


def test_a_frame_has_the_same_noise_in_any_range_and_order() -> None:
    whole = noise(seed=5, frames=130, channels=16)
    for first, last in [(60, 120), (0, 60), (120, 130), (37, 38)]:
        np.testing.assert_array_equal(whole[first:last], noise(5, last - first, 16, start=first))


def test_a_channel_has_the_same_noise_whatever_the_width() -> None:
    wide = noise(seed=5, frames=4, channels=16)
    for channels in (1, 2, 3, 5, 12):
        np.testing.assert_array_equal(wide[:, :channels], noise(5, 4, channels))


def test_it_is_standard_normal() -> None:
    values = noise(seed=3, frames=2000, channels=192).astype(np.float64)
    count = values.size
    assert abs(values.mean()) < 5 / np.sqrt(count)
    assert abs(values.std() - 1) < 5 / np.sqrt(2 * count)
    assert abs((values**3).mean()) < 5 * np.sqrt(15 / count)
    assert abs((values**4).mean() - 3) < 5 * np.sqrt(96 / count)
    # The largest of n normals is near sqrt(2 ln n).
    assert 4 < np.abs(values).max() < 7


def test_neighbours_and_seeds_do_not_correlate() -> None:
    base = noise(seed=3, frames=500, channels=64).astype(np.float64)
    limit = 5 / np.sqrt(base.size)
    for other in (
        np.roll(base, 1, axis=0),
        np.roll(base, 1, axis=1),
        noise(4, 500, 64),
        noise(3, 500, 64, start=1000),
    ):
        assert abs((base * other).mean()) < limit


if __name__ == "__main__":
    GOLDEN.write_text(json.dumps(golden()) + "\n")
