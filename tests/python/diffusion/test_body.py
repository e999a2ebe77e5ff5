"""The bodies of a model: measured on its own dances, one for each role."""

from __future__ import annotations

import numpy as np
import torch

from export.tiny import tiny_model
from training.data.made import made_dancer
from training.diffusion.body import decoded_dance, measure_body, set_bodies
from training.diffusion.react import Request, react
from training.motion.rigid_body import bone_lengths
from training.motion.skeleton import JOINTS


def test_both_bodies_are_measured_on_dances_beside_the_other_dancer() -> None:
    model = tiny_model()
    before = model.denoiser.bodies.clone()
    leaders, reactors = ([made_dancer(120, seed) for seed in seeds] for seeds in ((1, 2), (3, 4)))
    set_bodies(model, leaders, reactors)
    reactor, leader = model.denoiser.bodies
    assert torch.equal(reactor, measure_body(model, leaders, 0))
    assert torch.equal(leader, measure_body(model, reactors, 1))
    assert not torch.equal(reactor, leader)
    assert not torch.allclose(reactor, before[0], atol=1e-3)


def test_a_body_has_the_mean_lengths_of_the_decoded_bones_left_and_right_of_their_own() -> None:
    model, partners = tiny_model(), [made_dancer(120, 1), made_dancer(60, 2)]
    decoded = torch.cat([decoded_dance(model, partner, 0) for partner in partners])
    changing = bone_lengths(decoded[None])[0]
    lengths = measure_body(model, partners, 0).norm(dim=-1)
    assert torch.allclose(lengths[1:], changing.mean(0)[1:], atol=1e-6)
    assert (changing.std(0)[1:] > 1e-3).all(), "else no mean would be told from a median"
    left, right = (lengths[JOINTS.index(f"{side}_wrist")] for side in ("left", "right"))
    assert abs(left - right) > 0.05 * left


def test_a_dance_has_the_measured_bones() -> None:
    model = tiny_model()
    leader = made_dancer(100, 1)
    set_bodies(model, [leader], [leader])
    for role, body in enumerate(model.denoiser.bodies):
        made = torch.from_numpy(react(model, Request(leader, role=float(role))))
        shares = (bone_lengths(made[None])[0] / body.norm(dim=-1))[:, 1:]
        assert np.ptp(shares.numpy()) < 1e-3, "one scale for all bones and frames"
