"""The block and sampler arithmetic that both languages share.

`python -m tests.python.diffusion.test_sampling_fixture` rewrites tests/fixtures/sampling.json, which the
TypeScript tests read.
"""

import json
from pathlib import Path

import numpy as np

from training.config import DiffusionConfig
from training.diffusion.blocks import partition
from training.diffusion.schedule import alphas_cumprod, ddim_steps

GOLDEN = Path(__file__).parents[2] / "fixtures" / "sampling.json"
BLOCK = 60
# Full blocks from 1 to 10, and tails on both sides of every boundary of the two partitions.
LENGTHS = sorted({n for b in range(1, 11) for n in (b * BLOCK + d for d in (-59, -31, -30, -29, -1, 0))})
COUNTS = (1, 2, 3, 4, 7, 10, 25, 50)


def golden() -> dict:
    def starts_and_lengths(frames: int, shifted: bool) -> list[list[int]]:
        return [[b.start, b.length] for b in partition(frames, BLOCK, shifted)]

    alphas = alphas_cumprod(DiffusionConfig())
    return {
        "block": BLOCK,
        "partitions": [
            {"latents": n, "plain": starts_and_lengths(n, False), "shifted": starts_and_lengths(n, True)}
            for n in LENGTHS
        ],
        "schedules": [
            {"steps": count, "plan": [[s.time, s.a, s.b] for s in ddim_steps(alphas, count)]}
            for count in COUNTS
        ],
    }


def test_the_golden_file_is_up_to_date() -> None:
    stored, fresh = json.loads(GOLDEN.read_text()), golden()
    assert stored["partitions"] == fresh["partitions"]
    for old, new in zip(stored["schedules"], fresh["schedules"], strict=True):
        assert old["steps"] == new["steps"]
        np.testing.assert_allclose(old["plan"], new["plan"], atol=1e-12)


if __name__ == "__main__":
    GOLDEN.write_text(json.dumps(golden()) + "\n")
