"""Eq. 9 on sampled latents with the terms of the song and of the other seeds, and Eq. 9 at every step."""

from __future__ import annotations

from pathlib import Path

import pytest
import torch

from export.tiny import tiny_model
from training.config import ConditionConfig, DenoiserConfig
from training.denoiser.denoiser import Denoiser
from training.diffusion.guidance import (
    Branches,
    blend,
    clamp_to_range,
    classifier_free_guidance,
    layer_gains,
    per_channel,
)

CHANNELS = 6
PUBLIC = Path(__file__).parents[3] / "web" / "public"


@pytest.fixture(scope="module")
def branches() -> Branches:
    torch.manual_seed(0)
    return Branches(*torch.randn(4, 5, 7, 2, CHANNELS))


@pytest.fixture(scope="module")
def denoiser() -> Denoiser:
    return tiny_model().denoiser


def noisy(d: Denoiser) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor, torch.Tensor, torch.Tensor]:
    """x, time, memory, memory without the song and valid of two full blocks."""
    torch.manual_seed(0)
    x = torch.randn(2, 60, d.layers, d.latent_width)
    memory, silent = torch.randn(2, 2, 60, d.condition.memory_width)
    return x, torch.tensor([0.4]), memory, silent, torch.ones(2, 60)


def test_blend_is_equation_9_with_a_term_for_the_song_and_one_for_other_seeds(branches: Branches) -> None:
    weights = torch.tensor([0.5, -0.6, 0.0])
    music, variety = 1.5, 0.3
    made = blend(branches, per_channel(weights, CHANNELS), music, variety)
    cond, silent, uncond = branches.conditional, branches.silent, branches.unconditional
    song = music * (cond - silent)
    for stream, s in enumerate(weights):
        own = slice(2 * stream, 2 * stream + 2)
        coarse = (1 + s) * cond - s * uncond + song + (variety - 1) * (cond - branches.mean)
        assert torch.allclose(made[..., 0, own], coarse[..., 0, own], atol=1e-5)
    assert torch.allclose(made[..., 1, :], (cond + song)[..., 1, :], atol=1e-5), (
        "the fine layer hears the song alone"
    )


def test_weights_at_which_a_term_is_gone_or_alone(branches: Branches) -> None:
    none, cond = torch.zeros(1), branches.conditional
    assert torch.equal(blend(branches, none, 0.0, 1.0), cond)
    for made, coarse in (
        (blend(branches, none - 1, 0.0, 1.0), branches.unconditional),
        (blend(branches, none, 0.0, 0.0), branches.mean),
    ):
        assert torch.allclose(made[..., 0, :], coarse[..., 0, :], atol=1e-6)
        assert torch.equal(made[..., 1, :], cond[..., 1, :])
    assert torch.allclose(blend(branches, none, -1.0, 1.0), branches.silent, atol=1e-6)


def test_a_channel_has_the_weight_of_its_stream() -> None:
    assert per_channel(torch.tensor([1.0, 2.0, 3.0]), CHANNELS).tolist() == [1, 1, 2, 2, 3, 3]


def test_fine_guidance_multiplies_the_layers_above_the_coarse_one() -> None:
    fine = torch.tensor([-1.0, 0.0, 0.5])
    assert layer_gains(fine, 1).tolist() == [[1], [1], [1]]
    assert layer_gains(fine, 2).tolist() == [[1, 0], [1, 1], [1, 1.5]]
    assert layer_gains(fine, 3).tolist() == [[1, 0, 0], [1, 1, 1], [1, 1.5, 1.5]]


@torch.no_grad()
def test_guidance_at_every_step_is_equation_9_clamped(denoiser: Denoiser) -> None:
    d = denoiser
    x, time, memory, silent, valid = noisy(d)
    yes, no = torch.ones(2, 2), torch.zeros(2, 2)
    conditional = d(x, time, memory, valid, yes, yes)
    unconditional = d(x, time, memory, valid, no, no)
    s = torch.tensor([[0.5, -1.0], [1.2, 0.0], [3.0, 2.0]])
    guided = classifier_free_guidance(d, x, time, memory, silent, valid, s, 0.0)
    per_stream = d.latent_width // 3
    for stream in range(3):
        for layer in range(2):
            channels = slice(stream * per_stream, (stream + 1) * per_stream)
            w = s[stream, layer]
            expected = ((1 + w) * conditional - w * unconditional)[:, :, layer, channels]
            expected = expected.clamp(d.lowest[layer, channels], d.highest[layer, channels])
            assert torch.allclose(guided[:, :, layer, channels], expected, atol=1e-5)


@torch.no_grad()
def test_music_guidance_at_every_step_adds_the_difference_that_the_song_makes(denoiser: Denoiser) -> None:
    d = denoiser
    x, time, memory, silent, valid = noisy(d)
    yes = torch.ones(2, 2)
    with_song, without = (d(x, time, heard, valid, yes, yes) for heard in (memory, silent))
    guided = classifier_free_guidance(d, x, time, memory, silent, valid, torch.zeros(3, 2), 1.5)
    expected = (with_song + 1.5 * (with_song - without)).clamp(d.lowest, d.highest)
    assert torch.allclose(guided, expected, atol=1e-5)
    assert not torch.allclose(guided, with_song.clamp(d.lowest, d.highest), atol=1e-2)


@torch.no_grad()
@pytest.mark.parametrize(("weight", "music"), [(0.0, 20.0), (5.0, 0.0)])
def test_guided_predictions_are_clamped_to_the_range_of_the_quantiser(
    denoiser: Denoiser, weight: float, music: float
) -> None:
    d = denoiser
    guided = classifier_free_guidance(d, *noisy(d), torch.full((3, 2), weight), music)
    assert (guided >= d.lowest).all()
    assert (guided <= d.highest).all()
    met = ((guided == d.lowest) | (guided == d.highest)).unflatten(-1, (3, -1))
    assert met.any(-1).flatten(0, 1).any(0).all(), "every stream and layer meets its limit"


def test_an_infinite_range_clamps_nothing() -> None:
    d = Denoiser(6, 1, DenoiserConfig(width=32, depths=(1,), mlp=2, condition=ConditionConfig(depth=1)))
    x0 = 100 * torch.randn(2, 60, 1, 6)
    assert torch.equal(clamp_to_range(d, x0), x0)
