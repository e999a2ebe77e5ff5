"""The bodies of a model: measured on its own dances, one for each role."""

from __future__ import annotations

import numpy as np
import torch

from export.tiny import tiny_model
from training.data.made import made_dancer
from training.diffusion.body import measure_body, set_bodies
from training.diffusion.react import Request, react
from training.motion.rigid_body import bone_lengths


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


def test_a_dance_has_the_measured_bones() -> None:
    model = tiny_model()
    leader = made_dancer(100, 1)
    set_bodies(model, [leader], [leader])
    for role, body in enumerate(model.denoiser.bodies):
        made = torch.from_numpy(react(model, Request(leader, role=float(role))))
        shares = (bone_lengths(made[None])[0] / body.norm(dim=-1))[:, 1:]
        assert np.ptp(shares.numpy()) < 1e-3, "one scale for all bones and frames"
