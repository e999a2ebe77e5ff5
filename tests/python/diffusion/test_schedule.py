"""Diffusion: the schedule, the forward process, and DDIM against a case with a closed form."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from training.config import DiffusionConfig
from training.diffusion.schedule import add_noise, alphas_cumprod, ddim_steps, stratified_timesteps

ALPHA_BAR = alphas_cumprod(DiffusionConfig())


def test_the_schedule_falls_from_signal_to_noise() -> None:
    assert ALPHA_BAR.shape == (1000,)
    assert (np.diff(ALPHA_BAR) < 0).all()
    assert ALPHA_BAR[0] > 0.9999
    assert ALPHA_BAR[-1] < 1e-4
    middle = np.cos((500 / 1000 + 0.008) / 1.008 * np.pi / 2) ** 2 / np.cos(0.008 / 1.008 * np.pi / 2) ** 2
    assert ALPHA_BAR[499] == pytest.approx(middle, rel=1e-9)


@pytest.mark.parametrize("last_time", [0.001, 0.1, 0.25])
@pytest.mark.parametrize("count", [2, 3, 7, 25, 50, 751])
def test_steps_are_even_from_the_noisiest_timestep_to_the_last_time(count: int, last_time: float) -> None:
    steps = ddim_steps(ALPHA_BAR, count, last_time)
    assert len(steps) == count
    assert steps[0].time == 0.999
    assert steps[-1].time == pytest.approx(last_time - 0.001, abs=1e-12)
    assert (steps[-1].a, steps[-1].b) == (0, 1), "the last one lands on the clean latents"
    gaps = -np.diff([round(s.time * 1000) for s in steps])
    assert gaps.min() >= 1
    assert gaps.max() - gaps.min() <= 1


def test_one_step_predicts_from_noise_alone() -> None:
    (step,) = ddim_steps(ALPHA_BAR, 1, 0.1)
    assert (step.time, step.a, step.b) == (0.999, 0, 1)


@pytest.mark.parametrize(("count", "last_time"), [(0, 0.1), (902, 0.1), (1001, 0.001), (3, 0.0), (3, 1.1)])
def test_steps_out_of_range_are_refused(count: int, last_time: float) -> None:
    with pytest.raises(ValueError, match="between"):
        ddim_steps(ALPHA_BAR, count, last_time)


def test_ddim_reaches_the_closed_form_of_a_gaussian() -> None:
    """For data N(m, s^2) the ideal x0 is known and the probability flow carries a sample to its quantile."""
    mean, std = 1.5, 0.4
    start = torch.linspace(-2.5, 2.5, 11, dtype=torch.float64)

    def error(count: int) -> float:
        x = start.clone()
        for step in ddim_steps(ALPHA_BAR, count, last_time=0.001):
            ab = ALPHA_BAR[round(step.time * 1000)]
            variance = ab * std**2 + 1 - ab
            x0 = mean + np.sqrt(ab) * std**2 / variance * (x - np.sqrt(ab) * mean)
            x = step.a * x + step.b * x0
        return float((x - (mean + std * start)).abs().max())

    assert error(1000) < 3e-3
    assert error(250) < 0.01
    assert error(1000) < error(250) < error(50) < error(10)


def test_forward_process_has_the_stated_moments() -> None:
    torch.manual_seed(0)
    x0, signal = torch.full((50000, 1), 2.0), torch.full((50000,), 0.3)
    noisy = add_noise(x0, torch.randn_like(x0), signal)
    assert float(noisy.mean()) == pytest.approx(2 * 0.3**0.5, abs=0.02)
    assert float(noisy.var()) == pytest.approx(0.7, abs=0.02)


def test_stratified_timesteps_cover_all_noise_levels_in_order() -> None:
    torch.manual_seed(0)
    times = stratified_timesteps(64, 1000, torch.device("cpu"))
    assert torch.equal(times, times.sort().values)
    assert ((times * 64 // 1000) - torch.arange(64)).abs().max() <= 1
    assert times.max() <= 999


def test_a_timestep_is_drawn_anywhere_in_its_slice_and_never_after_the_last(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    torch.manual_seed(0)
    draws = torch.stack([stratified_timesteps(4, 1000, torch.device("cpu")) for _ in range(200)])
    assert (draws.amax(0) - draws.amin(0) > 200).all()
    # The greatest number that torch.rand gives: single precision rounds the end of the last slice up.
    monkeypatch.setattr(torch, "rand", lambda n, device: torch.full((n,), 1 - 2**-24))
    assert stratified_timesteps(64, 1000, torch.device("cpu")).max() == 999
