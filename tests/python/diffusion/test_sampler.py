"""Blockwise sampling: arithmetic with a known predictor, and whole samplings of a tiny model."""

from __future__ import annotations

from dataclasses import replace

import pytest
import torch
from torch import Tensor

from export.tiny import tiny_model
from training.diffusion.guidance import Branches, blend, per_channel
from training.diffusion.model import Model, Sampling
from training.diffusion.noise import noise
from training.diffusion.sampler import (
    Predict,
    initial_noise,
    sample,
    sample_branch,
    sample_branches,
    sample_guided_at_every_step,
    sample_mean,
)
from training.diffusion.schedule import Step

SEED = 5
LENGTH = 150  # latent frames: two full blocks and a half


@pytest.fixture(scope="module")
def model() -> Model:
    return tiny_model()


def steps_of(sampling: Sampling, count: int = 4) -> list[Step]:
    return sampling.ddim(count)


def memories(model: Model, start: int = 0, length: int = LENGTH) -> tuple[Tensor, Tensor]:
    """Memory with and without a song of latent frames [start, start + length) of one dance."""
    torch.manual_seed(3)
    with_song, without = torch.randn(2, 200, model.denoiser.condition.memory_width)
    return with_song[start : start + length], without[start : start + length]


def noise_of(model: Model, seed: int = SEED, start: int = 0, length: int = LENGTH) -> Tensor:
    s = model.sampling
    values = noise(seed, length, s.layers * s.channels, start=start)
    return torch.from_numpy(values).view(length, s.layers, s.channels)


def branches_of(model: Model, seed: int = SEED, start: int = 0, length: int = LENGTH) -> Branches:
    memory, silent = memories(model, start, length)
    steps = steps_of(model.sampling)
    mean = sample_mean(model, memory, steps)
    return sample_branches(model, memory, silent, noise_of(model, seed, start, length), steps, mean)


def halving(x: Tensor, memory: Tensor, valid: Tensor, time: Tensor) -> Tensor:
    """A predictor without context: x0 = x / 2 + time."""
    return x / 2 + time


def run(
    sampling: Sampling, predict: Predict, count: int = 4, length: int = 70
) -> tuple[Tensor, list[Tensor]]:
    """Latents of a predictor, and the x that it was asked about at each step."""
    seen: list[Tensor] = []

    def recorded(x: Tensor, memory: Tensor, valid: Tensor, time: Tensor) -> Tensor:
        seen.append(x.clone())
        return predict(x, memory, valid, time)

    initial = initial_noise(sampling, SEED, length)
    return sample(sampling, recorded, torch.zeros(length, 1), initial, steps_of(sampling, count)), seen


def test_sampling_is_ddim_with_the_last_prediction_extrapolated_in_each_stream(model: Model) -> None:
    weights = (0.8, 0.25, 0.0)
    plain = replace(model.sampling, extrapolation=(0.0, 0.0, 0.0))
    made, seen = run(replace(plain, extrapolation=weights), halving)
    x, before = initial_noise(plain, SEED, 70), torch.zeros(())
    for step in steps_of(plain)[:-1]:
        before = x / 2 + step.time
        x = step.a * x + step.b * before
    last = x / 2 + steps_of(plain)[-1].time
    for stream, (c, of_made, of_last, of_before) in enumerate(
        zip(weights, *(values.chunk(3, dim=-1) for values in (made, last, before)), strict=True)
    ):
        assert torch.allclose(of_made, (1 + c) * of_last - c * of_before, atol=1e-5), f"stream {stream}"
    base, seen_before = run(plain, halving)
    assert torch.allclose(base, last, atol=1e-5)
    assert all(torch.equal(a, b) for a, b in zip(seen, seen_before, strict=True)), (
        "earlier steps are as they were"
    )


def test_a_single_step_has_nothing_to_extrapolate_from(model: Model) -> None:
    plain, extrapolated = (replace(model.sampling, extrapolation=(weight,) * 3) for weight in (0.0, 0.8))
    assert torch.equal(run(plain, halving, count=1)[0], run(extrapolated, halving, count=1)[0])


def test_noise_of_a_seed_is_standard_and_its_own(model: Model) -> None:
    s = model.sampling
    made = initial_noise(s, SEED, LENGTH)
    assert torch.equal(made, noise_of(model))
    assert not torch.allclose(made, initial_noise(s, SEED + 1, LENGTH))
    assert float(made.std()) == pytest.approx(1, abs=0.02)


def test_one_block_alone_equals_the_same_block_of_the_whole_song(model: Model) -> None:
    whole, steps = branches_of(model), steps_of(model.sampling)
    memory, silent = memories(model, start=60, length=60)
    mean = whole.mean[60:120]
    alone = sample_branches(model, memory, silent, noise_of(model, start=60, length=60), steps, mean)
    weights = per_channel(torch.tensor([0.5, -0.5, 1.0]), model.sampling.channels)
    assert torch.allclose(blend(whole, weights, 2.0, 1.5)[60:120], blend(alone, weights, 2.0, 1.5), atol=1e-4)


def test_a_longer_song_keeps_the_blocks_before(model: Model) -> None:
    weights = per_channel(torch.tensor([0.5, -0.5, 1.0]), model.sampling.channels)
    long, short = (blend(branches_of(model, length=length), weights, 2.0, 1.5) for length in (LENGTH, 120))
    assert torch.allclose(long[:120], short, atol=1e-4)


def test_blocks_next_to_each_other_do_not_see_each_other(model: Model) -> None:
    memory, _ = memories(model)
    initial, steps = noise_of(model), steps_of(model.sampling)
    changed = torch.cat([initial[:60], -initial[60:120], initial[120:]])
    made, other = (sample_branch(model, memory, 1.0, start, steps) for start in (initial, changed))
    assert torch.allclose(made[:60], other[:60], atol=1e-5)
    assert torch.allclose(made[120:], other[120:], atol=1e-5)
    assert not torch.allclose(made[60:120], other[60:120], atol=1e-2)


def test_stitching_samples_windows_that_overlap(model: Model) -> None:
    """What needs no context comes out the same; what has context differs, at the boundaries too."""
    plain = replace(model.sampling, stitching=False)
    stitching = replace(plain, stitching=True)
    assert torch.allclose(
        run(plain, halving, length=LENGTH)[0], run(stitching, halving, length=LENGTH)[0], atol=1e-5
    )
    memory, _ = memories(model)
    stitched_model = replace(model, diffusion=replace(model.diffusion, stitching=True))
    stitched, made = (
        sample_branch(m, memory, 1.0, noise_of(model), steps_of(plain)) for m in (stitched_model, model)
    )
    assert torch.allclose(stitched[:1], made[:1], atol=1e-5), "the first window alone covers the first frame"
    assert not torch.allclose(stitched[60:90], made[60:90], atol=1e-2)


def test_branches_are_sampled_with_the_song_without_it_and_without_any_condition(model: Model) -> None:
    memory, silent = memories(model)
    initial, steps = noise_of(model), steps_of(model.sampling)
    made = branches_of(model)
    assert torch.equal(made.conditional, sample_branch(model, memory, 1.0, initial, steps))
    assert torch.equal(made.silent, sample_branch(model, silent, 1.0, initial, steps))
    # The unconditional branch depends on neither memory.
    assert torch.allclose(made.unconditional, sample_branch(model, memory, 0.0, initial, steps), atol=1e-5)
    for other in (made.silent, made.unconditional):
        assert not torch.allclose(made.conditional, other, atol=1e-2)


def test_the_mean_is_of_the_first_seeds_whatever_the_dances_own_seed(model: Model) -> None:
    memory, _ = memories(model)
    steps = steps_of(model.sampling)
    two = replace(model, diffusion=replace(model.diffusion, mean_seeds=2))
    first, second = (sample_branch(model, memory, 1.0, noise_of(model, seed), steps) for seed in (0, 1))
    assert torch.allclose(sample_mean(two, memory, steps), (first + second) / 2, atol=1e-5)


def test_variety_0_gives_every_seed_the_same_coarse_latents(model: Model) -> None:
    none = torch.zeros(1)
    one, other = (branches_of(model, seed) for seed in (1, 2))
    same = [blend(branches, none, 0.0, 0.0) for branches in (one, other)]
    assert torch.allclose(same[0][:, 0], same[1][:, 0], atol=1e-5)
    assert not torch.allclose(same[0][:, 1], same[1][:, 1], atol=1e-2), "each has its own fine layer"
    apart = [
        float((blend(one, none, 0.0, v) - blend(other, none, 0.0, v))[:, 0].abs().mean())
        for v in (0.5, 1.0, 2.0)
    ]
    assert apart == pytest.approx([0.5 * apart[1], apart[1], 2 * apart[1]], rel=1e-3)
    assert apart[1] > 0.1


def test_fine_latents_never_reach_coarse_ones(model: Model) -> None:
    """Other noise in the fine layer leaves the coarse latents bit-identical over a whole sampling."""
    memory, _ = memories(model)
    initial, steps = noise_of(model), steps_of(model.sampling)
    changed = initial.clone()
    changed[:, 1] *= -1
    made, other = (sample_branch(model, memory, 1.0, start, steps) for start in (initial, changed))
    assert torch.equal(made[:, 0], other[:, 0])
    assert not torch.allclose(made[:, 1], other[:, 1], atol=1e-2)


def every_step(model: Model, guidance: Tensor, music: float = 0.0) -> Tensor:
    memory, silent = memories(model)
    steps = steps_of(model.sampling)
    return sample_guided_at_every_step(model, memory, silent, noise_of(model), steps, guidance, music)


def test_fine_guidance_at_every_step_leaves_the_coarse_latents_bit_identical(model: Model) -> None:
    low, high = torch.tensor([[0.4, 0.0]] * 3), torch.tensor([[0.4, 2.5]] * 3)
    made, other = every_step(model, low), every_step(model, high)
    assert torch.equal(made[:, 0], other[:, 0])
    assert (made[:, 1] - other[:, 1]).abs().max() > 1e-3


def test_any_weight_of_guidance_at_every_step_changes_its_own_stream_and_layer(model: Model) -> None:
    base = every_step(model, torch.zeros(3, 2))
    for stream in range(3):
        for layer in range(2):
            weights = torch.zeros(3, 2)
            weights[stream, layer] = 1.0
            change = (every_step(model, weights) - base).abs().amax(0)
            own = change[layer].view(3, -1)[stream].max()
            assert own > 1e-3, f"stream {stream}, layer {layer}: guidance is a no-op"


def test_guidance_at_every_step_without_weights_is_the_conditional_branch(model: Model) -> None:
    memory, silent = memories(model)
    initial, steps = noise_of(model), steps_of(model.sampling)
    conditional, without_song = (sample_branch(model, m, 1.0, initial, steps) for m in (memory, silent))
    assert torch.allclose(every_step(model, torch.zeros(3, 2)), conditional, atol=1e-4)
    assert not torch.allclose(every_step(model, torch.zeros(3, 2), 1.0), conditional, atol=1e-2)
    assert torch.allclose(every_step(model, torch.zeros(3, 2), -1.0), without_song, atol=1e-4)
