"""The baselines on a made toy whose answer is known, and through their program on made duets."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch
from torch import Tensor

from tests.python.support.small_training import write_duets
from training import generate
from training.baselines import __main__ as program
from training.baselines.duolando import Duolando, normalised_codebooks
from training.baselines.gesturelsm import GestureLsm
from training.baselines.intergen import InterGen, distance_map_loss
from training.baselines.method import BaselineConfig, Known, Method, Window
from training.baselines.trained import load_baseline, make_method
from training.checkpoint import save_hfsq
from training.config import FrameConfig, HfsqConfig
from training.data.made import made_dancer
from training.denoiser.clips import Augmentation
from training.evaluation.no_latent_baseline import NO_LATENTS
from training.hfsq.autoencoder import Autoencoder

METHODS = ("edge", "intergen", "tcdiff", "duolando", "gesturelsm")
SMALL = HfsqConfig(
    quantiser="rvq", groups=1, group_width=8, codebook=16, widths=(8, 8, 8), depth=1, refine_width=8
)
BLOCK, STEPS, WINDOWS = 20, 80, 16


def autoencoder(method: str) -> Autoencoder:
    torch.manual_seed(0)
    if method == "duolando":
        return Autoencoder(replace(SMALL, layers=1, masking=None)).eval()
    return Autoencoder(SMALL if method == "gesturelsm" else NO_LATENTS).eval()


def poses_of(method: str, hfsq: Autoencoder) -> Tensor:
    """Two latents (2, R, C) that the autoencoder can give."""
    if method == "duolando":
        books = normalised_codebooks(hfsq)
        return torch.stack([torch.cat([book[code] for book in books])[None] for code in (3, 7)])
    return torch.randn(2, hfsq.layers, hfsq.latent_width, generator=torch.Generator().manual_seed(1))


def asked(method: Method, poses: Tensor, n: int, length: int, seed: int) -> tuple[Known, Tensor]:
    """The leader's first feature is 1 or -1 for five tokens at a time, and the reactor takes the pose for it."""
    random = torch.Generator().manual_seed(seed)
    choice = torch.randint(0, 2, (n, -(-length // 5)), generator=random).repeat_interleave(5, 1)[:, :length]
    features = torch.zeros(n, 4 * length, 68)
    features[..., 0] = (2.0 * choice - 1).repeat_interleave(4, 1)
    music, valid = torch.zeros(n, 4 * length, 54), torch.ones(n, 4 * length)
    memory = method.condition(features, music, valid, torch.zeros(n))
    return Known(memory, method.leader_tokens(features), torch.ones(n, length)), poses[choice]


@pytest.mark.parametrize("name", METHODS)
def test_it_learns_which_pose_belongs_to_which_leader(name: str) -> None:
    hfsq = autoencoder(name)
    poses = poses_of(name, hfsq)
    torch.manual_seed(0)
    method = make_method(BaselineConfig(name, width=32, depth=2, block=BLOCK), hfsq)  # pyright: ignore[reportArgumentType]
    optimizer = torch.optim.Adam(method.parameters(), lr=3e-3)
    nothing = torch.zeros(WINDOWS, 4 * BLOCK, 22, 3)
    for step in range(STEPS):
        known, latents = asked(method, poses, WINDOWS, BLOCK, step)
        known = known._replace(valid=torch.cat([known.valid[:, 1:], torch.zeros(WINDOWS, 1)], dim=1))
        loss = torch.stack(
            list(method.loss(known, Window(latents, lambda x, rows: x, nothing, nothing)).values())
        ).sum()
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
    method.eval()
    known, truth = asked(method, poses, 1, 2 * BLOCK + 13, seed=-1)
    made = method.sample(known, torch.Generator().manual_seed(2))
    assert made.shape == truth.shape[1:]
    right = (made.sum(1) - truth[0].sum(1)).norm(dim=-1)
    wrong = (made.sum(1) - (poses.sum(0) - truth[0]).sum(1)).norm(dim=-1)
    assert (right < wrong).float().mean() > 0.9
    assert right.mean() < 0.5 * wrong.mean()


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_duets(tmp_path_factory.mktemp("data"))


@pytest.mark.parametrize("name", METHODS)
def test_the_program_trains_it_and_it_dances(name: str, data: Path, tmp_path: Path) -> None:
    hfsq = autoencoder(name)
    hfsq.latent_std.fill_(0.5)
    save_hfsq(tmp_path, hfsq, FrameConfig(), {})
    program.main(
        program.Options(
            method=name, data=data, out=tmp_path, val=("made_1",), test=("made_2",), steps=2, batch=4, synths=1,  # pyright: ignore[reportArgumentType]
            width=16, depth=2, augmentation=Augmentation(tempos=(1.0,), copies=1), log_every=1, evaluate_every=5,
            precision="32-true",
        )
    )  # fmt: skip
    baseline = load_baseline(tmp_path)
    leader = made_dancer(333, 4)
    made, other, again = (baseline.react(leader, np.ones((200, 54)), seed) for seed in (0, 1, 0))
    assert made.shape == leader.shape
    assert np.isfinite(made).all()
    assert np.array_equal(made, again)
    assert not np.array_equal(made, other)
    given = generate.Options(
        checkpoint=tmp_path, leader=data, duet="made_2", out=tmp_path / "dance", seeds=(3,)
    )
    generate.main(given)
    [leader, reactor] = [np.load(given.out / f"{dancer}.npy") for dancer in ("leader", "reactor_3")]
    assert reactor == pytest.approx(baseline.react(leader, None, 3), abs=1e-6)
    with pytest.raises(ValueError, match="no such control: leave --steps, --variety out"):
        generate.main(replace(given, steps=2, variety=1.0))


def test_codes_come_back_from_their_latents() -> None:
    hfsq = autoencoder("duolando")
    hfsq.latent_mean.normal_()
    hfsq.latent_std.uniform_(0.5, 2)
    method = make_method(BaselineConfig("duolando", width=16, depth=2), hfsq)
    assert isinstance(method, Duolando)
    codes = torch.randint(0, 16, (2, 9, 3))
    latents = torch.cat([book[codes[..., s]] for s, book in enumerate(method.codebooks)], dim=-1)[:, :, None]
    assert torch.equal(method.indices(latents), codes)
    with torch.no_grad():
        encoded = hfsq.encode([torch.randn(1, 40, width) for width in (39, 24, 3)])
    distance = torch.cdist(hfsq.normalise(encoded)[0, :, 0, :8], method.codebooks[0]).min(-1).values
    assert distance.max() < 1e-3, "the encoder's latents are codes of the books"
    with pytest.raises(ValueError, match="one layer and one group"):
        make_method(BaselineConfig("duolando"), autoencoder("gesturelsm"))


def test_residual_codes_decode_from_their_sum_alone() -> None:
    hfsq = autoencoder("gesturelsm")
    hfsq.latent_mean.normal_()
    hfsq.latent_std.uniform_(0.5, 2)
    method = make_method(BaselineConfig("gesturelsm", width=16, depth=2), hfsq)
    assert isinstance(method, GestureLsm)
    latents = torch.randn(1, 7, 2, hfsq.latent_width)
    whole = hfsq.denormalise(latents).sum(2)
    separated = hfsq.denormalise(method.separate(method.combined(latents)[0]))
    assert torch.allclose(separated.sum(1), whole[0], atol=1e-5)
    assert float(method.combined(torch.randn(1, 4000, 2, hfsq.latent_width)).std()) == pytest.approx(
        1, abs=0.05
    )


def test_the_reactors_network_looks_at_the_leaders() -> None:
    hfsq = autoencoder("intergen")
    torch.manual_seed(0)
    method = make_method(BaselineConfig("intergen", width=16, depth=4), hfsq).eval()
    for parameter in method.parameters():
        torch.nn.init.normal_(parameter, std=0.3)
    known, _ = asked(method, poses_of("intergen", hfsq), 1, BLOCK, 0)
    made, other = (
        method.sample(known._replace(leader=leader), torch.Generator().manual_seed(2))
        for leader in (known.leader, -known.leader)
    )
    assert not torch.allclose(made, other, atol=1e-3)


def test_the_leaders_network_is_given_clean_tokens_in_sampling_and_learns_to_denoise_them() -> None:
    hfsq = autoencoder("intergen")
    method = make_method(BaselineConfig("intergen", width=16, depth=4, block=BLOCK), hfsq).eval()
    assert isinstance(method, InterGen)
    known, latents = asked(method, poses_of("intergen", hfsq), WINDOWS, BLOCK, 0)
    predict, given = method.predict, []
    method.predict = lambda *inputs: (given.append(inputs), predict(*inputs))[1]  # pyright: ignore[reportAttributeAccessIssue]
    method.sample(known._replace(memory=known.memory[:1], leader=known.leader[:1]), torch.Generator())
    for _, leader, _, _, (time, leader_time) in given:
        assert torch.equal(leader, known.leader[:1])
        assert float(time) > 0
        assert float(leader_time) == 0
    couple = [
        torch.from_numpy(made_dancer(4 * BLOCK, seed))[None].repeat(WINDOWS, 1, 1, 1) for seed in (1, 2)
    ]
    window = Window(latents, lambda x, rows: couple[1][rows] + 0.1 * x.mean() + 0.05, *couple)
    assert set(method.loss(known, window)) == {
        *("simple", "leader", "kinematic", "contact", "distances", "orientation")
    }
    *_, (time, leader_time) = given[-1]
    clean = leader_time == 0
    assert 0 < clean.sum() < WINDOWS
    assert torch.equal(given[-1][1][clean], known.leader[clean])
    assert (given[-1][1][~clean] != known.leader[~clean]).any(dim=2).all()


def test_the_map_of_distances_counts_joints_that_are_near() -> None:
    leader = torch.zeros(1, 2, 22, 3)
    truth = torch.full((1, 2, 22, 3), 5.0)
    truth[..., 3, :] = torch.tensor([0.5, 0, 0])
    wrong = truth.clone()
    wrong[..., 3, 0] = 0.8
    wrong[..., 4, 0] = 9.0
    assert float(distance_map_loss(leader, truth, wrong)) == pytest.approx(0.3)
    assert float(distance_map_loss(leader, truth, truth)) == 0
