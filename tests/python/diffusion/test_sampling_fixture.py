"""The sampler arithmetic that both languages share.

`python -m tests.python.diffusion.test_sampling_fixture` rewrites tests/fixtures/sampling.json, which the
TypeScript tests read.
"""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import torch

from export.tiny import tiny_model
from training.config import DiffusionConfig
from training.diffusion.sampler import sample
from training.diffusion.schedule import alphas_cumprod, ddim_steps

GOLDEN = Path(__file__).parents[2] / "fixtures" / "sampling.json"
# Numbers of steps and last times; the steps of 7 and 25 to 0.1 do not divide the timesteps evenly.
SCHEDULES = [(count, last) for last in (0.1, 0.25) for count in (1, 2, 3, 4, 7, 10, 25, 50)]
SCHEDULES += [(2, 0.0125)]  # half a timestep, which languages round differently
ALPHAS = alphas_cumprod(DiffusionConfig())


def sampled(steps: int = 3, latents: int = 3, channels: int = 6) -> dict:
    """A sampling in which x0 = x / 2 + time: its noise, which is cos 0, cos 1, ..., and the clean latents."""
    sampling = replace(tiny_model().sampling, block=60, layers=2, channels=channels)
    initial = torch.arange(latents * 2 * channels).cos().view(latents, 2, channels)
    result = sample(
        sampling,
        lambda x, memory, valid, time: x / 2 + time,
        torch.zeros(latents, 1),
        initial,
        ddim_steps(ALPHAS, steps, sampling.last_time),
    )
    return {
        "steps": steps,
        "last_time": sampling.last_time,
        "layers": 2,
        "channels": channels,
        "noise": initial.flatten().tolist(),
        "latents": result.flatten().tolist(),
    }


def golden() -> dict:
    return {
        "schedules": [
            {
                "steps": count,
                "last_time": last,
                "plan": [[s.time, s.a, s.b] for s in ddim_steps(ALPHAS, count, last)],
            }
            for count, last in SCHEDULES
        ],
        "sampled": sampled(),
    }


def test_the_golden_file_is_up_to_date() -> None:
    stored, fresh = json.loads(GOLDEN.read_text()), golden()
    for old, new in zip(stored["schedules"], fresh["schedules"], strict=True):
        assert (old["steps"], old["last_time"]) == (new["steps"], new["last_time"])
        np.testing.assert_allclose(old["plan"], new["plan"], atol=1e-12)
    old, new = stored["sampled"], fresh["sampled"]
    assert {k: v for k, v in old.items() if k not in ("noise", "latents")} == {
        k: v for k, v in new.items() if k not in ("noise", "latents")
    }
    for name in ("noise", "latents"):
        np.testing.assert_allclose(old[name], new[name], atol=1e-6)


if __name__ == "__main__":
    GOLDEN.write_text(json.dumps(golden()) + "\n")
