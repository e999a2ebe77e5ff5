"""The second opinion from the mirror: the formula, and what it must not touch."""

from __future__ import annotations

from dataclasses import replace

import pytest
import torch

from export.tiny import tiny_model
from training.diffusion import alphas_cumprod
from training.sampler import Model, guided_x0
from training.second_opinion import TRUSTED, second_opinion, trusted


@pytest.fixture(scope="module")
def model() -> Model:
    return tiny_model()


def weighed(model: Model, mirror: float) -> Model:
    return replace(model, diffusion=replace(model.diffusion, mirror=mirror, reach=(9.0, 9.0, 9.0)))


def given(model: Model) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
    """x (2, 60, R, C), memory (2, 60, M), valid (2, 60) with padding in the second block."""
    torch.manual_seed(0)
    d = model.denoiser
    valid = torch.ones(2, 60)
    valid[1, 40:] = 0
    return torch.randn(2, 60, d.layers, d.latent_width), torch.randn(2, 60, d.condition.memory_width), valid


@torch.no_grad()
def test_a_mirror_that_changes_nothing_compares_two_answers_of_the_network(model: Model) -> None:
    x, memory, valid = given(model)
    coarse, memory = x[:, :, 0] * valid[..., None], memory.chunk(2, dim=-1)[0]
    time, left = torch.tensor([0.499]), float(alphas_cumprod(model.diffusion)[499]) ** 0.5
    config = replace(model.diffusion, mirror=15.0)
    change = second_opinion(model.denoiser, torch.nn.Identity(), config, coarse, time, memory, valid)  # pyright: ignore
    answer = model.denoiser.coarse(left * coarse, time, memory, valid)
    expected = 15.0 * left * trusted(answer - coarse)
    assert torch.allclose(change[0], expected[0], atol=1e-5)
    assert torch.allclose(change[1, :40], expected[1, :40], atol=1e-5)
    assert change.abs().mean() > 0.01


def test_what_contradicts_by_far_counts_less() -> None:
    torch.manual_seed(0)
    signs = torch.randn(1, 4, 24).sign()
    sizes = torch.tensor([0.5, 0.99, 2.0, 8.0]) * TRUSTED
    counted = trusted(signs * sizes[:, None]).abs().mean(-1)[0]
    expected = torch.tensor([0.5, 0.99, 2.0 / 8, 8.0 / 512]) * TRUSTED
    assert torch.allclose(counted, expected, rtol=1e-3)
    assert torch.isfinite(trusted(torch.zeros(1, 2, 3))).all()


@torch.no_grad()
def test_it_corrects_the_coarse_layer_and_leaves_the_fine_one(model: Model) -> None:
    x, memory, valid = given(model)
    time, off = torch.tensor([0.3]), torch.zeros(3, 2)

    def predicted(mirror: float) -> torch.Tensor:
        return guided_x0(weighed(model, mirror), x, time, memory, valid, off, torch.zeros(1))

    alone, half, whole = predicted(0.0), predicted(15.0), predicted(30.0)
    assert torch.allclose(half[:, :, 1], alone[:, :, 1], atol=1e-6)
    change = (half - alone)[:, :, 0]
    assert change.abs().mean() > 0.01
    assert torch.allclose((whole - alone)[:, :, 0], 2 * change, atol=1e-5), "as much as its weight"


@torch.no_grad()
def test_it_hears_the_song_and_sees_the_mirrored_leader_but_not_the_silence(model: Model) -> None:
    x, memory, valid = given(model)
    time = torch.tensor([0.3])
    coarse = x[:, :, 0]

    def change(memory: torch.Tensor) -> torch.Tensor:
        """What the opinion adds; Eq. 9 and the music's guidance are off."""
        parts = [
            guided_x0(weighed(model, m), x, time, memory, valid, torch.zeros(3, 2), torch.zeros(1))
            for m in (30.0, 0.0)
        ]
        return (parts[0] - parts[1])[:, :, 0]

    width = memory.shape[-1] // 4
    before = change(memory)
    assert before.shape == coarse.shape
    for part, matters in ((2, False), (3, True)):
        other = memory.clone()
        other[..., part * width : (part + 1) * width] = torch.randn(2, 60, width)
        assert torch.allclose(change(other), before, atol=1e-5) is not matters


@torch.no_grad()
def test_where_there_is_noise_alone_it_has_nothing_to_say(model: Model) -> None:
    x, memory, valid = given(model)
    coarse, memory = x[:, :, 0], memory.chunk(2, dim=-1)[0]
    first, last = (
        second_opinion(
            model.denoiser, model.hfsq.mirror, model.diffusion, coarse, torch.tensor([time]), memory, valid
        )
        for time in (0.999, 0.0)
    )
    assert first.abs().max() < 1e-3
    assert last.abs().mean() > 0.01
