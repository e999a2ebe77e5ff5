"""Blockwise sampling and layer-decoupled guidance, over whole samplings of a tiny model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import torch

from export.tiny import tiny_model
from training.config import ConditionConfig, DenoiserConfig
from training.data.made import made_dancer
from training.denoiser.denoiser import Denoiser
from training.diffusion.blocks import Block, gather, overlapping, partition, scatter
from training.diffusion.guidance import clamp_to_range, classifier_free_guidance
from training.diffusion.model import Model
from training.diffusion.noise import noise
from training.diffusion.react import Request, react
from training.diffusion.sampler import sample
from training.diffusion.schedule import alphas_cumprod, ddim_steps


@pytest.fixture(scope="module")
def model() -> Model:
    return tiny_model()


def run(
    model: Model, length: int, guidance: np.ndarray, start: int = 0, music: float = 0.0, **changes: bool
) -> torch.Tensor:
    d = model.denoiser
    torch.manual_seed(3)
    memory = torch.randn(200, d.condition.memory_width)[start : start + length]
    initial = torch.from_numpy(noise(5, length, d.layers * d.latent_width, start=start))
    config = replace(model.diffusion, **changes)
    steps = ddim_steps(alphas_cumprod(config), 4)
    return sample(
        replace(model, diffusion=config),
        memory,
        initial.reshape(length, d.layers, d.latent_width),
        steps,
        torch.from_numpy(guidance).float(),
        music,
    )


def flat(coarse: float, fine: float) -> np.ndarray:
    return np.tile(np.array([coarse, fine], dtype=np.float32), (3, 1))


@pytest.mark.parametrize("frames", [1, 29, 30, 31, 59, 60, 61, 90, 91, 150, 541])
@pytest.mark.parametrize("shifted", [False, True])
def test_blocks_tile_any_length(frames: int, shifted: bool) -> None:
    blocks = partition(frames, 60, shifted)
    covered = [i for b in blocks for i in range(b.start, b.start + b.length)]
    assert covered == list(range(frames))
    assert blocks[0].length == min(30 if shifted else 60, frames)
    assert all(b.length == 60 for b in blocks[1:-1])
    values = torch.randn(frames, 2, 3)
    assert torch.allclose(scatter(gather(values, blocks, 60), blocks, frames), values, atol=1e-6)


def test_a_shifted_partition_has_its_boundaries_in_the_middle_of_the_others() -> None:
    assert partition(150, 60) == [Block(0, 60), Block(60, 60), Block(120, 30)]
    assert partition(150, 60, shifted=True) == [Block(0, 30), Block(30, 60), Block(90, 60)]


def test_stitched_windows_overlap_by_half_and_cross_fade() -> None:
    blocks = overlapping(150, 60)
    assert [b.start for b in blocks] == [0, 30, 60, 90]
    parts = torch.stack([torch.full((60,), float(i)) for i in range(len(blocks))])
    mixed = scatter(parts, blocks, 150)
    assert mixed[0] == 0
    assert mixed[149] == 3
    assert (mixed.diff() >= 0).all(), "a cross-fade from window to window"
    assert mixed.diff().max() < 0.1


def test_any_guidance_weight_changes_the_result(model: Model) -> None:
    base = run(model, 70, flat(0, 0))
    for stream in range(3):
        for layer in range(2):
            weights = flat(0, 0)
            weights[stream, layer] = 1.0
            change = (run(model, 70, weights) - base).abs().amax((0,))
            own = change[layer].reshape(3, -1)[stream].max()
            assert own > 1e-3, f"stream {stream}, layer {layer}: guidance is a no-op"


@pytest.mark.parametrize("alternating", [False, True])
def test_fine_guidance_leaves_the_coarse_latents_bit_identical(model: Model, alternating: bool) -> None:
    low = run(model, 150, flat(0.4, 0), alternating_phase=alternating)
    high = run(model, 150, flat(0.4, 2.5), alternating_phase=alternating)
    assert torch.equal(low[:, 0], high[:, 0])
    assert (low[:, 1] - high[:, 1]).abs().max() > 1e-3


def test_guidance_is_equation_9_clamped(model: Model) -> None:
    torch.manual_seed(0)
    d = model.denoiser
    x, memory = torch.randn(2, 60, d.layers, d.latent_width), torch.randn(2, 60, d.condition.memory_width)
    heard = memory[..., : 2 * d.config.width]
    valid, time = torch.ones(2, 60), torch.tensor([0.4])
    yes, no = torch.ones(2, 2), torch.zeros(2, 2)
    with torch.no_grad():
        conditional = d(x, time, heard, valid, yes, yes)
        unconditional = d(x, time, heard, valid, no, no)
        s = torch.tensor([[0.5, -1.0], [1.2, 0.0], [3.0, 2.0]])
        guided = classifier_free_guidance(d, x, time, memory, valid, s, torch.zeros(1))
    per_stream = d.latent_width // 3
    for stream in range(3):
        for layer in range(2):
            channels = slice(stream * per_stream, (stream + 1) * per_stream)
            w = s[stream, layer]
            yes, no = conditional[:, :, layer, channels], unconditional[:, :, layer, channels]
            expected = (1 + w) * yes - w * no
            expected = expected.clamp(d.lowest[layer, channels], d.highest[layer, channels])
            assert torch.allclose(guided[:, :, layer, channels], expected, atol=1e-5)


def test_music_guidance_adds_the_difference_that_the_song_makes(model: Model) -> None:
    torch.manual_seed(0)
    d = model.denoiser
    width = d.config.width
    x, memory = torch.randn(2, 60, d.layers, d.latent_width), torch.randn(2, 60, d.condition.memory_width)
    valid, time = torch.ones(2, 60), torch.tensor([0.4])
    yes, none = torch.ones(2, 2), torch.zeros(3, 2)
    leader, _, silence = memory.chunk(3, dim=-1)
    with torch.no_grad():
        with_song = d(x, time, memory[..., : 2 * width], valid, yes, yes)
        without = d(x, time, torch.cat([leader, silence], dim=-1), valid, yes, yes)
        guided = classifier_free_guidance(d, x, time, memory, valid, none, torch.tensor([1.5]))
    expected = (with_song + 1.5 * (with_song - without)).clamp(d.lowest, d.highest)
    assert torch.allclose(guided, expected, atol=1e-5)
    assert not torch.allclose(guided, with_song.clamp(d.lowest, d.highest), atol=1e-2)


def test_without_a_song_music_guidance_changes_nothing(model: Model) -> None:
    leader = made_dancer(100, 1)
    music = np.random.default_rng(0).normal(size=(100, 54)).astype(np.float32)
    silent = react(model, Request(leader, None, 1, music_guidance=3.0))
    assert np.allclose(silent, react(model, Request(leader, None, 1, music_guidance=0.0)), atol=1e-5)
    loud = react(model, Request(leader, music, 1, music_guidance=3.0))
    assert not np.allclose(loud, react(model, Request(leader, music, 1, music_guidance=0.0)), atol=1e-3)


def test_guided_predictions_are_clamped_to_the_range_of_the_quantiser(model: Model) -> None:
    d = model.denoiser
    torch.manual_seed(0)
    x, memory = torch.randn(2, 60, d.layers, d.latent_width), torch.randn(2, 60, d.condition.memory_width)
    valid, time = torch.ones(2, 60), torch.tensor([0.4])
    for weights, music in ((flat(0, 0), 20.0), (flat(3, 3), 0.0)):
        with torch.no_grad():
            guided = classifier_free_guidance(
                d, x, time, memory, valid, torch.from_numpy(weights), torch.tensor([music])
            )
        assert (guided >= d.lowest).all()
        assert (guided <= d.highest).all()
        met = ((guided == d.lowest) | (guided == d.highest)).unflatten(-1, (3, -1))
        assert met.any(-1).flatten(0, 1).any(0).all(), "every stream and layer meets its limit"


def test_an_infinite_range_clamps_nothing() -> None:
    d = Denoiser(6, 1, DenoiserConfig(width=32, depths=(1,), mlp=2, condition=ConditionConfig(depth=1)))
    x0 = 100 * torch.randn(2, 60, 1, 6)
    assert torch.equal(clamp_to_range(d, x0), x0)


def test_blocks_are_independent_unless_their_phase_alternates(model: Model) -> None:
    """One block alone equals the same block of the whole song; alternating phase couples neighbours on purpose."""
    whole = run(model, 150, flat(0.5, 0.5), alternating_phase=False)
    alone = run(model, 60, flat(0.5, 0.5), start=60, alternating_phase=False)
    assert torch.allclose(whole[60:120], alone, atol=1e-5)
    coupled = run(model, 150, flat(0.5, 0.5), alternating_phase=True)
    assert not torch.allclose(coupled[60:120], alone, atol=1e-2)


def test_the_beginning_does_not_depend_on_the_length(model: Model) -> None:
    """Causal blocks and counter-based noise: later blocks change nothing before them."""
    assert torch.allclose(
        run(model, 150, flat(0, 0), alternating_phase=False)[:120],
        run(model, 120, flat(0, 0), alternating_phase=False),
        atol=1e-5,
    )


def test_sampling_with_stitching(model: Model) -> None:
    stitched = run(model, 150, flat(0, 0), alternating_phase=False, stitching=True)
    assert stitched.isfinite().all()
    assert not torch.allclose(stitched, run(model, 150, flat(0, 0), alternating_phase=False), atol=1e-2)


@pytest.mark.parametrize("frames", [1, 5, 240, 333])
def test_a_reaction_is_as_long_as_its_leader(model: Model, frames: int) -> None:
    leader = made_dancer(frames, 1)
    music = np.random.default_rng(0).normal(size=(frames // 2 + 1, 54))
    made = react(model, Request(leader, music, 1))
    assert made.shape == leader.shape
    assert np.isfinite(made).all()
    assert not np.allclose(made, react(model, Request(leader, music, 2)))
    assert np.array_equal(made, react(model, Request(leader, music, 1)))
    assert not np.allclose(made, react(model, Request(leader, None, 1))), "silence is not music"
    assert not np.allclose(made, react(model, Request(leader, music, 1, role=1.0))), "the role is heard"
