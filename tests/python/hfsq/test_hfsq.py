"""HFSQ: the grid, the residual cascade, masking, and decoding in chunks."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal, cast

import pytest
import torch

from training.config import STREAMS, HfsqConfig, MaskingConfig
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.losses import energy_loss, kinematic, stage1_loss
from training.hfsq.masking import progressive_masking, slow_motion
from training.hfsq.quantisers import Hfsq, KlBottleneck, fsq, fsq_range, make_quantiser
from training.motion.streams import STREAM_WIDTHS

SMALL = HfsqConfig(groups=2, widths=(16, 16, 8), depth=2, refine_width=8)


def motions(n: int = 2, frames: int = 48) -> tuple[torch.Tensor, ...]:
    return tuple(torch.randn(n, frames, width) for width in STREAM_WIDTHS)


@pytest.mark.parametrize("levels", [(8, 6, 5), (8, 5, 5, 5), (7, 5, 5, 5, 5)])
def test_fsq_uses_exactly_the_bins_of_each_dimension(levels: tuple[int, ...]) -> None:
    torch.manual_seed(0)
    z = fsq(torch.randn(20000, len(levels)) * 4, torch.tensor(levels, dtype=torch.float32))
    for dimension, count in enumerate(levels):
        values = (z[:, dimension] * (count // 2)).round(decimals=4).unique()
        assert len(values) == count
        assert torch.equal(values, values.round())
        assert values.diff().eq(1).all()
    assert z.abs().max() <= 1


@pytest.mark.parametrize("levels", [(8, 5, 5, 5), (4, 3)])
def test_extreme_features_give_the_ends_of_the_range(levels: tuple[int, ...]) -> None:
    low, high = fsq_range(torch.tensor(levels, dtype=torch.float32))
    extreme = torch.full((len(levels),), 50.0)
    assert torch.allclose(fsq(-extreme, torch.tensor(levels, dtype=torch.float32)), low)
    assert torch.allclose(fsq(extreme, torch.tensor(levels, dtype=torch.float32)), high)


def test_no_code_lies_outside_the_latent_range() -> None:
    model = Autoencoder(HfsqConfig(groups=2, widths=(16, 16, 8), depth=1, refine_width=8))
    model.latent_mean.normal_()
    model.latent_std.uniform_(0.5, 2)
    latents = model.normalise(model.encode([100 * torch.randn(2, 64, c) for c in STREAM_WIDTHS]))
    low, high = model.latent_range()
    assert low.shape == high.shape == latents.shape[2:]
    assert (latents >= low - 1e-5).all()
    assert (latents <= high + 1e-5).all()
    assert torch.isclose(latents.amin((0, 1)), low, atol=1e-5).any()


def test_energy_loss_by_hand() -> None:
    """A joint that moves half as far has half the speed, acceleration and jerk: three times log(1/2) squared."""
    time = torch.arange(40.0)
    path = torch.stack([torch.sin(time / 3), torch.cos(time / 3), 0 * time], dim=-1)[None, :, None]
    assert energy_loss(path, path).item() == pytest.approx(0, abs=1e-9)
    assert energy_loss(path, 0.5 * path).item() == pytest.approx(3 * 0.4805, rel=1e-2)


def test_fsq_passes_the_gradient_of_its_bound_straight_through() -> None:
    e = torch.tensor([[0.3, -0.2]], requires_grad=True)
    fsq(e, torch.tensor([5.0, 5.0])).sum().backward()
    half = 2 * (1 + 1e-3)
    expected = half * (1 - torch.tanh(e.detach()) ** 2) / 2
    assert torch.allclose(e.grad, expected, atol=1e-6)  # pyright: ignore[reportArgumentType]


def test_each_layer_codes_the_residual_of_the_earlier_ones() -> None:
    """Eq. 1: v minus the sum of the layers is the residual, and it shrinks with every layer."""
    torch.manual_seed(0)
    quantiser = Hfsq(SMALL)
    v = 0.4 * torch.randn(4, 10, quantiser.width)
    codes = quantiser(v)
    both = (v - quantiser.combine(codes)).square().mean()
    coarse_codes = codes.clone()
    coarse_codes[:, :, 1:] = 0
    coarse = (v - quantiser.combine(coarse_codes)).square().mean()
    assert both < coarse < v.square().mean()


def test_dividing_the_residual_lets_the_second_layer_use_its_bins() -> None:
    """Undivided residuals mostly round to zero: with the same projection, a scale of 1 leaves bins unused."""

    def used(scale: float) -> float:
        torch.manual_seed(0)
        quantiser = Hfsq(HfsqConfig(groups=2, scales=(1.0, scale)))
        quantiser.down.data[1] = quantiser.down.data[0]
        z = quantiser(torch.randn(8, 200, quantiser.width))[:, :, 1]
        return float((z != 0).float().mean())

    assert used(0.25) > 0.7
    assert used(1.0) < used(0.25) - 0.2


def test_residual_masking_hides_upper_layers_and_perturbs_the_base() -> None:
    torch.manual_seed(0)
    codes = torch.ones(200, 6, 3, 8)
    config = MaskingConfig(residual=1.0, base_noise=0.1, code=0.0)
    masked, hidden = progressive_masking(codes, config)
    assert hidden.all()
    kept = (masked[:, 0, :, 0] != 0).sum(1)
    assert set(kept.tolist()) == {1, 2}, "one or two of three layers survive"
    assert (masked[:, :, 0] - 1).std() == pytest.approx(0.1, rel=0.05)
    assert (masked[:, 1:, 0] != masked[:, :-1, 0]).all(), "every frame has noise of its own"
    assert torch.equal(masked[kept == 2][:, :, 1], codes[kept == 2][:, :, 1])
    untouched, hidden = progressive_masking(codes, MaskingConfig(residual=0.0, code=0.0))
    assert not hidden.any()
    assert torch.equal(untouched, codes)


def test_a_single_layer_is_perturbed_but_never_hidden() -> None:
    torch.manual_seed(0)
    masked, hidden = progressive_masking(
        torch.ones(200, 6, 1, 8), MaskingConfig(residual=1.0, base_noise=0.1, code=0.0)
    )
    assert not hidden.any()
    assert (masked - 1).std() == pytest.approx(0.1, rel=0.05)


def test_code_masking_zeroes_the_asked_share_of_dimensions() -> None:
    torch.manual_seed(0)
    config = MaskingConfig(residual=0.0, code=0.5, code_rate=0.2)
    masked, _ = progressive_masking(torch.ones(400, 10, 2, 8), config)
    share = (masked == 0).float().mean((1, 2, 3))
    touched = share > 0
    assert touched.float().mean() == pytest.approx(0.5, abs=0.08)
    assert share[touched].mean() == pytest.approx(0.2, abs=0.01)


def test_normalised_latents_have_unit_variance_and_are_denormalised_exactly() -> None:
    torch.manual_seed(0)
    model = Autoencoder(SMALL).eval()
    latents = model.encode(motions(4, 240))
    model.latent_mean.copy_(latents.mean((0, 1)))
    model.latent_std.copy_(latents.std((0, 1)))
    normal = model.normalise(latents)
    assert normal.mean((0, 1)).abs().max() < 1e-4
    assert (normal.std((0, 1)) - 1).abs().max() < 1e-4
    assert torch.allclose(model.denormalise(normal), latents, atol=1e-6)


@pytest.mark.parametrize(
    "config",
    [
        SMALL,
        HfsqConfig(groups=2, layers=1, scales=(1.0,), widths=(16, 16, 8), depth=1, refine_width=8),
        HfsqConfig(groups=1, layers=3, scales=(1.0, 0.25, 0.06), widths=(8, 8, 8), depth=1, refine_width=8),
        HfsqConfig(groups=2, masking=None, widths=(16, 16, 8), depth=1, refine_width=8),
        HfsqConfig(quantiser="rvq", groups=2, codebook=32, widths=(16, 16, 8), depth=1, refine_width=8),
        HfsqConfig(
            quantiser="kl", groups=2, layers=1, scales=(1.0,), masking=None, widths=(16, 16, 8), depth=1, refine_width=8
        ),
    ],
    ids=["hfsq", "one-layer", "three-layers", "no-masking", "rvq", "kl"],
)  # fmt: skip
def test_every_quantiser_of_the_papers_table_2_learns(config: HfsqConfig) -> None:
    """On one batch the loss falls, and every parameter of the encoder has a gradient."""
    torch.manual_seed(0)
    model = Autoencoder(config).train()
    batch = tuple(m.cumsum(1) * 0.02 for m in motions(4, 32))
    optimizer = torch.optim.Adam(model.parameters(), lr=3e-3)
    losses = []
    for _ in range(30):
        loss, _ = stage1_loss(model, batch, batch, config)
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
        losses.append(float(loss))
    assert sum(losses[-5:]) < 0.9 * sum(losses[:5])
    assert all(p.grad is not None and p.grad.isfinite().all() for p in model.each[0].encoder.parameters())
    latents = model.encode(batch)
    assert latents.shape == (4, 8, config.layers, model.latent_width)


def test_kinematic_loss_by_hand() -> None:
    """A constant offset of 1 cm costs position alone; a constant drift of 1 cm a frame costs velocity too."""
    still = torch.zeros(1, 5, 3)
    offset = still + 0.01
    drift = torch.arange(5.0)[None, :, None] * 0.01 * torch.ones(1, 5, 3)
    assert kinematic(still, offset, (1.0, 5.0, 5.0)) == pytest.approx(1.0)
    assert kinematic(still, drift, (0.0, 5.0, 5.0)) == pytest.approx(5.0, rel=1e-5)


@pytest.mark.parametrize(
    "changes",
    [
        {"quantiser": "rvq", "levels": (8, 8)},
        {"quantiser": "kl", "layers": 1, "codebook": 9},
        {"codebook": 9},
        {"weight_kl": 0.1},
        {"quantiser": "rvq", "scales": (1.0, 0.5)},
    ],
)
def test_options_of_another_quantiser_are_refused(changes: dict) -> None:
    with pytest.raises(ValueError, match="does not read it"):
        make_quantiser(HfsqConfig(**changes))


def test_kl_penalty_by_hand() -> None:
    """0 for a standard normal; of N(1, 4) 0.5 (1 + 4 - 1 - log 4)."""
    config = HfsqConfig(quantiser="kl", groups=1, layers=1, scales=(1.0,), weight_kl=0.1)
    bottleneck = KlBottleneck(config)
    torch.nn.init.zeros_(bottleneck.to_moments.weight)
    for mean, variance in ((0.0, 1.0), (1.0, 4.0)):
        moments = torch.tensor([mean, math.log(variance)])
        bottleneck.to_moments.bias.data.copy_(moments.repeat_interleave(bottleneck.width))
        bottleneck(torch.randn(2, 3, bottleneck.width))
        expected = 0.05 * (mean**2 + variance - 1 - math.log(variance))
        assert float(torch.as_tensor(bottleneck.penalty()).detach()) == pytest.approx(expected, abs=1e-6)
    v = torch.randn(64, 3, bottleneck.width)
    assert bottleneck.train()(v).detach().std() == pytest.approx(2, abs=0.1)  # of the last N(1, 4)
    assert torch.equal(bottleneck.eval()(v), torch.ones(64, 3, 1, bottleneck.width)), (
        "its mean after training"
    )


@pytest.mark.parametrize("beta", [0.0, 0.5])
def test_the_latent_loss_pulls_the_encoder_and_with_beta_the_codes(beta: float) -> None:
    """Eq. 5 alone: all other weights are zero."""
    torch.manual_seed(0)
    config = replace(
        SMALL, masking=None, weight_position=0.0, weight_velocity=0.0, weight_acceleration=0.0,
        weight_energy=0.0, weight_latent=2.0, beta=beta,
    )  # fmt: skip
    model, batch = Autoencoder(config), motions()
    loss, parts = stage1_loss(model, batch, batch, config)
    assert float(loss.detach()) == pytest.approx(2 * sum(float(parts[f"latent/{name}"]) for name in STREAMS))
    loss.backward()
    for name, stream, motion in zip(STREAMS, model.each, batch, strict=True):
        v = stream.features(motion)
        error = float((v - stream.quantiser.combine(stream.quantiser(v))).square().mean().detach())
        assert float(parts[f"latent/{name}"]) == pytest.approx((1 + beta) * error, rel=1e-4)
        assert any(p.grad is not None and p.grad.any() for p in stream.encoder.parameters())
        up = cast(Hfsq, stream.quantiser).up.grad
        assert (up is not None and bool(up.any())) is (beta > 0)


@pytest.mark.parametrize("quantiser", ["hfsq", "rvq"])
def test_what_is_decoded_has_a_gradient_for_the_features(quantiser: Literal["hfsq", "rvq"]) -> None:
    """Straight through the rounding."""
    torch.manual_seed(0)
    made = make_quantiser(HfsqConfig(quantiser=quantiser, groups=2)).train()
    v = (0.4 * torch.randn(2, 8, made.width)).requires_grad_()
    made.combine(made(v)).square().sum().backward()
    assert v.grad is not None
    assert (v.grad != 0).float().mean() > 0.9


def test_the_residual_cascade_is_equation_1() -> None:
    torch.manual_seed(0)
    q = Hfsq(HfsqConfig(groups=2, layers=3, scales=(0.5, 0.25, 0.1)))
    v = 0.4 * torch.randn(4, 10, q.width)
    codes, residual = q(v), v.unflatten(-1, (2, -1))
    for r, s in enumerate(q.scales):
        z = fsq(torch.einsum("nlgw,gwd->nlgd", residual / s, q.down[r]), q.levels)
        assert torch.allclose(codes[:, :, r], z.flatten(-2))
        residual = residual - s * torch.einsum("nlgd,gdw->nlgw", z, q.up[r])
    assert torch.allclose(residual.flatten(-2), v - q.combine(codes), atol=1e-5)


def test_scales_must_match_layers() -> None:
    with pytest.raises(ValueError, match=r"3 residual layers need 3 scales \(--hfsq\.scales\)"):
        Hfsq(HfsqConfig(layers=3))


def test_slow_motion_keeps_what_is_below_the_cutoff() -> None:
    seconds = torch.arange(600) / 30
    slow, quick = torch.sin(2 * torch.pi * 0.8 * seconds), torch.sin(2 * torch.pi * 5 * seconds)
    filtered = slow_motion((slow + quick)[:, None], 2.25)[60:-60, 0]
    assert torch.allclose(filtered, slow[60:-60], atol=0.02)
    assert torch.equal(slow_motion(quick[:, None], None), quick[:, None])


def test_the_target_of_a_window_with_hidden_layers_is_the_slow_motion() -> None:
    torch.manual_seed(0)
    config = HfsqConfig(
        groups=2, widths=(16, 16, 8), depth=1, refine_width=8,
        masking=MaskingConfig(residual=1.0, base_noise=0.0, code=0.0),
    )  # fmt: skip
    model = Autoencoder(config).train()
    batch = motions(2, 32)
    near, _ = stage1_loss(model, batch, batch, config)
    far, _ = stage1_loss(model, batch, tuple(m + 10 for m in batch), config)
    assert float(far) > float(near) + 1000
    model.eval()
    assert torch.equal(
        *(stage1_loss(model, batch, slow, config)[0] for slow in (batch, tuple(m + 10 for m in batch)))
    )
