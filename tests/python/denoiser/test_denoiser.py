"""The denoiser: causal attention, independent layers, conditions and how they are dropped."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
import torch
import torch.nn.functional as F

from export.tiny import tiny_model
from training.config import ConditionConfig, DenoiserConfig
from training.denoiser.condition import ConditionEncoder, condition_dropout
from training.denoiser.denoiser import Conditioning, Denoiser
from training.denoiser.transformer import Attention, ChannelDropout, alibi_bias, phase, sinusoidal
from training.diffusion.model import Model

BLOCK = 60


@pytest.fixture(scope="module")
def model() -> Model:
    return tiny_model()


def given(model: Model, n: int = 2) -> dict[str, torch.Tensor]:
    torch.manual_seed(1)
    d = model.denoiser
    return {
        "x": torch.randn(n, BLOCK, d.layers, d.latent_width),
        "time": torch.full((n,), 0.5),
        "memory": torch.randn(n, BLOCK, 2 * d.config.width),
        "valid": torch.ones(n, BLOCK),
        "keep_leader": torch.ones(n, d.layers),
        "keep_music": torch.ones(n, d.layers),
    }


def test_attention_is_causal_inside_a_block(model: Model) -> None:
    """The output at token i does not depend on x at j > i, and does on x at j <= i."""
    inputs = given(model, 1)
    inputs["x"].requires_grad_(True)
    at = 30
    out = model.denoiser(**inputs)[0, at].square().sum()
    (gradient,) = torch.autograd.grad(out, inputs["x"])
    by_token = gradient[0].abs().sum((1, 2))
    assert torch.equal(by_token[at + 1 :], torch.zeros(BLOCK - at - 1))
    assert (by_token[: at + 1] > 0).all()


def test_cross_attention_reaches_later_leader_tokens_but_no_padding(model: Model) -> None:
    inputs = given(model, 1)
    inputs["valid"][0, 50:] = 0
    inputs["memory"].requires_grad_(True)
    out = model.denoiser(**inputs)[0, 10].square().sum()
    (gradient,) = torch.autograd.grad(out, inputs["memory"])
    width = model.denoiser.config.width
    leader = gradient[0, :, :width].abs().sum(1)
    assert (leader[:50] > 0).all()
    assert torch.equal(leader[50:], torch.zeros(10))
    music = gradient[0, :, width:].abs().sum(1)
    assert (music[:11] > 0).all(), "music reaches a token through itself and the tokens before it"
    assert torch.equal(music[11:], torch.zeros(BLOCK - 11))


def test_without_the_causal_mask_a_token_sees_all_that_are_valid(model: Model) -> None:
    config = replace(model.denoiser.config, mask="bidirectional", positions="sinusoidal")
    both = Denoiser(model.denoiser.latent_width, 2, config).eval()
    for parameter in both.parameters():
        torch.nn.init.normal_(parameter, std=0.1)
    inputs = given(model)
    inputs["valid"][:, 50:] = 0
    inputs["x"].requires_grad_()
    (gradient,) = torch.autograd.grad(both(**inputs)[0, 10].sum(), inputs["x"])
    seen = gradient[0].abs().sum((1, 2))
    assert (seen[:50] > 0).all(), "also tokens that come later"
    assert torch.equal(seen[50:], torch.zeros(10)), "but no padding"


def test_attention_is_scaled_by_the_root_of_a_heads_width() -> None:
    torch.manual_seed(0)
    attention = Attention(24, 4)
    x, memory, bias = 3 * torch.randn(2, 7, 24), 3 * torch.randn(2, 7, 24), torch.randn(4, 7, 7)
    key, value = attention.key_value(memory).chunk(2, dim=-1)
    heads = (part.unflatten(-1, (4, 6)).transpose(1, 2) for part in (attention.query(x), key, value))
    mixed = F.scaled_dot_product_attention(*heads, attn_mask=bias)
    assert torch.allclose(
        attention(x, memory, bias), attention.out(mixed.transpose(1, 2).flatten(2)), atol=1e-5
    )


def test_a_head_with_a_slope_looks_less_at_tokens_that_are_farther_away() -> None:
    flat, steep = alibi_bias(6, (0.0, 0.5))
    assert torch.equal(flat, torch.zeros(6, 6))
    assert steep[2].tolist() == [-1.0, -0.5, 0.0, -0.5, -1.0, -1.5]


def test_every_place_in_a_block_has_its_own_sinusoidal_position() -> None:
    table = sinusoidal(BLOCK)
    assert table.shape == (BLOCK, 32)
    assert torch.cdist(table, table).fill_diagonal_(9).min() > 0.1
    assert table[5, 0] == pytest.approx(math.sin(5.0), abs=1e-6), "the shortest wavelength is 2 pi tokens"
    assert table[5, 31] == pytest.approx(math.cos(0.005), abs=1e-6)


def test_coarse_never_depends_on_fine(model: Model) -> None:
    inputs = given(model)
    before = model.denoiser(**inputs)
    inputs["x"][:, :, 1] += 1
    inputs["keep_leader"][:, 1] = 0
    inputs["keep_music"][:, 1] = 0
    after = model.denoiser(**inputs)
    assert torch.equal(before[:, :, 0], after[:, :, 0])
    assert not torch.allclose(before[:, :, 1], after[:, :, 1])
    inputs = given(model)
    inputs["x"][:, :, 0] += 1
    assert not torch.allclose(before[:, :, 1], model.denoiser(**inputs)[:, :, 1]), "fine follows coarse"


def test_each_layer_has_its_own_null_embedding_of_each_condition(model: Model) -> None:
    base = model.denoiser(**given(model))
    for condition in ("keep_leader", "keep_music"):
        for layer in range(2):
            inputs = given(model)
            inputs[condition][:, layer] = 0
            changed = (model.denoiser(**inputs) - base).abs().amax((0, 1, 3))
            assert changed[layer] > 1e-4, f"{condition} of layer {layer} does nothing"
            assert layer == 0 or changed[0] == 0
    inputs = given(model)
    inputs["keep_leader"][:] = inputs["keep_music"][:] = 0
    without = model.denoiser(**inputs)
    inputs["memory"] = torch.randn_like(inputs["memory"])
    assert torch.equal(without, model.denoiser(**inputs)), "a dropped condition leaks"
    own = model.denoiser.transformers[0].conditioning
    assert isinstance(own, Conditioning)
    leader, music = own(inputs["memory"], inputs["keep_leader"][:, 0], inputs["keep_music"][:, 0])
    assert torch.equal(leader, own.no_leader.expand_as(leader))
    assert torch.equal(music, own.no_music.expand_as(music))
    kept = torch.ones(len(leader))
    lead, song = inputs["memory"].chunk(2, dim=-1)
    leader, music = own(inputs["memory"], kept, kept)
    assert torch.equal(leader, own.leader(lead))
    assert torch.equal(music, own.music(song))


def test_music_is_a_condition_per_token(model: Model) -> None:
    """Music moved by one token changes the output; the mean over the block would not change."""
    inputs = given(model)
    before = model.denoiser(**inputs)
    width = model.denoiser.config.width
    rolled = inputs["memory"].clone()
    rolled[..., width:] = rolled[..., width:].roll(1, dims=1)
    inputs["memory"] = rolled
    change = (model.denoiser(**inputs) - before).norm() / before.norm()
    assert change > 0.01


def test_conditions_are_dropped_independently_per_layer() -> None:
    """Shares of all combinations are those of `ConditionConfig`."""
    torch.manual_seed(0)
    n = 20000
    rates = ConditionConfig()
    keep_leader, keep_music = condition_dropout(n, 2, rates)
    kept = keep_music.bool()
    expected = (1 - rates.drop_layer) * (1 - rates.drop_all)
    for layer in range(2):
        assert float(kept[:, layer].float().mean()) == pytest.approx(expected, abs=0.01)
    only_fine_dropped = (kept[:, 0] & ~kept[:, 1]).float().mean()
    only_coarse_dropped = (~kept[:, 0] & kept[:, 1]).float().mean()
    alone = rates.drop_layer * (1 - rates.drop_layer) * (1 - rates.drop_all)
    assert float(only_fine_dropped) == pytest.approx(alone, abs=0.01)
    assert float(only_coarse_dropped) == pytest.approx(alone, abs=0.01)
    none = (~kept).all(1).float().mean()
    assert float(none) == pytest.approx(rates.drop_all + (1 - rates.drop_all) * rates.drop_layer**2, abs=0.01)
    leader_alone = (kept & ~keep_leader.bool()).any(1).float().mean()
    assert float(leader_alone) == pytest.approx(
        rates.drop_leader * float(kept.any(1).float().mean()), abs=0.01
    )
    assert not (keep_leader.bool() & ~kept).any()


def test_position_encoding_is_equation_8() -> None:
    table = phase(BLOCK)
    for i in (0, 1, 30, 59):
        assert table[i, 0] == pytest.approx(math.sin(math.pi * i / BLOCK), abs=1e-6)
        assert table[i, 1] == pytest.approx(math.cos(math.pi * i / BLOCK), abs=1e-6)


def encoder(config: ConditionConfig) -> ConditionEncoder:
    torch.manual_seed(0)
    made = ConditionEncoder(16, config).eval()
    for parameter in made.parameters():
        if parameter.abs().max() == 0:
            torch.nn.init.normal_(parameter, std=0.3)
    return made


def test_memory_of_a_window_equals_that_of_the_clip() -> None:
    made = encoder(ConditionConfig())
    latents, field = 40, made.receptive_field
    leader, music = torch.randn(1, 4 * latents, 68), torch.randn(1, 4 * latents, 54)
    role, valid = torch.zeros(1), torch.ones(1, 4 * latents)
    whole = made(leader, music, valid, role)
    start, stop = 10, 22
    rows = slice(4 * (start - field), 4 * (stop + field))
    inside = torch.ones(1, stop - start + 2 * field)
    window = made(leader[:, rows], music[:, rows], valid[:, rows], role, inside)
    assert torch.allclose(window[:, field:-field], whole[:, start:stop], atol=1e-5)
    # At the clip's beginning the margin lies outside and must count as the zero padding of the whole clip.
    padded = torch.nn.functional.pad
    rows = slice(0, 4 * (12 + field))
    inside = padded(torch.ones(1, 12 + field), (field, 0))
    first = made(
        padded(leader[:, rows], (0, 0, 4 * field, 0)), padded(music[:, rows], (0, 0, 4 * field, 0)),
        padded(valid[:, rows], (4 * field, 0)), role, inside,
    )  # fmt: skip
    assert torch.allclose(first[:, field : field + 12], whole[:, :12], atol=1e-5)


def test_features_count_in_standard_deviations_from_their_mean_in_training() -> None:
    made = encoder(ConditionConfig())
    leader, music, role, valid = (
        torch.randn(1, 80, 68),
        torch.randn(1, 80, 54),
        torch.zeros(1),
        torch.ones(1, 80),
    )
    leader[..., 5] = 2.0

    @torch.no_grad()
    def memory(scale: float, shift: float) -> torch.Tensor:
        features, song = (scale * values + shift for values in (leader, music))
        made.set_statistics(features[0], song[0])
        return made(features, song, valid, role)

    plain = memory(1, 0)
    assert plain.isfinite().all(), "a feature that never changes has no deviation"
    assert torch.allclose(memory(5, 3), plain, atol=1e-3)


def test_unfamiliarity_is_in_standard_deviations_of_the_features_of_training() -> None:
    made = encoder(ConditionConfig())
    features = 5 * torch.randn(800, 68) + 3
    made.set_statistics(features, torch.randn(80, 54))
    assert made.unfamiliarity(features[None]).mean() == pytest.approx(1, abs=0.01)
    away = features.mean(0) + features.std(0) * torch.linspace(0, 3, 20).repeat_interleave(4)[:, None]
    assert torch.allclose(made.unfamiliarity(away[None])[0], torch.linspace(0, 3, 20), atol=1e-4)


def test_features_of_invalid_music_frames_have_no_effect() -> None:
    made = encoder(ConditionConfig())
    leader, role = torch.randn(1, 80, 68), torch.zeros(1)
    valid = torch.ones(1, 80)
    valid[:, 40:] = 0
    music = torch.randn(1, 80, 54)
    other = music.clone()
    for anything in (1e6, torch.nan):
        other[:, 40:] = anything
        assert torch.equal(made(leader, music, valid, role), made(leader, other, valid, role))
    assert not torch.allclose(made(leader, music, valid, role), made(leader, music, torch.ones(1, 80), role))


def test_silence_is_the_learned_vector_where_there_is_no_song_and_nowhere_else() -> None:
    made = encoder(ConditionConfig(depth=0))
    leader, music, role = torch.randn(1, 80, 68), torch.randn(1, 80, 54), torch.zeros(1)
    valid = (torch.arange(80) < 40).float()[None]
    heard = made(leader, music, valid, role).chunk(2, dim=-1)[1][0]
    assert torch.equal(heard[10:], made.silence.expand(10, -1))
    with torch.no_grad():
        made.silence.add_(1)
    assert torch.equal(made(leader, music, valid, role).chunk(2, dim=-1)[1][0, :10], heard[:10])


def test_the_first_half_of_the_memory_is_the_leaders_and_the_second_the_musics() -> None:
    made = encoder(ConditionConfig())
    features, music = torch.randn(1, 80, 68), torch.randn(1, 80, 54)
    role, valid = torch.ones(1), torch.ones(1, 80)
    with torch.no_grad():
        memory = made(features, music, valid, role)
        assert memory.shape == (1, 20, made.memory_width)
        leader, heard = memory.chunk(2, dim=-1)
        for other, same, changed in (
            (made(features, music, torch.zeros_like(valid), role), 0, 1),
            (made(features, torch.randn_like(music), valid, role), 0, 1),
            (made(torch.randn_like(features), music, valid, role), 1, 0),
            (made(features, music, valid, 1 - role), 1, 0),
        ):
            parts = other.chunk(2, dim=-1)
            assert torch.equal(parts[same], (leader, heard)[same])
            assert not torch.allclose(parts[changed], (leader, heard)[changed], atol=0.1)


@pytest.mark.parametrize(("leader", "music"), [(False, True), (True, False)])
def test_a_condition_that_is_switched_off_has_no_effect(leader: bool, music: bool) -> None:
    made = encoder(ConditionConfig(leader=leader, music=music))
    led, heard = torch.randn(1, 40, 68), torch.randn(1, 40, 54)
    role, valid = torch.zeros(1), torch.ones(1, 40)
    before = made(led, heard, valid, role)
    assert torch.equal(before, made(torch.randn_like(led), heard, valid, role)) is not leader
    assert torch.equal(before, made(led, torch.randn_like(heard), valid, role)) is not music


def test_three_layers_need_three_depths() -> None:
    config = DenoiserConfig(width=16, depths=(1, 1, 1))
    made = Denoiser(12, 3, config).eval()
    out = made(
        torch.randn(1, BLOCK, 3, 12), torch.zeros(1), torch.randn(1, BLOCK, 32), torch.ones(1, BLOCK),
        torch.ones(1, 3), torch.ones(1, 3),
    )  # fmt: skip
    assert out.shape == (1, BLOCK, 3, 12)
    with pytest.raises(
        ValueError, match=r"3 residual layers of stage 1 need 3 depths \(--denoiser\.depths\)"
    ):
        Denoiser(12, 3, DenoiserConfig(width=16))


def test_dropout_drops_channels_for_a_whole_window() -> None:
    torch.manual_seed(0)
    dropout = ChannelDropout(0.25)
    x = torch.ones(40, 10, 64)
    dropped = dropout.train()(x)
    assert (dropped == dropped[:, :1]).all(), "the same channels at every moment"
    assert (dropped[0] != dropped[1]).any(), "others in another window"
    assert dropped.unique().tolist() == pytest.approx([0, 1 / 0.75])
    assert float(dropped.mean()) == pytest.approx(1, abs=0.05)
    assert torch.equal(dropout.eval()(x), x)
