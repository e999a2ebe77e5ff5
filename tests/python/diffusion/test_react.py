"""A reaction to a leader and a song: what each weight of a request changes, and what none does."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from export.runtime import open_model
from export.tiny import tiny_model
from training.config import CONTROLS
from training.data.made import made_dancer
from training.diffusion.model import Model
from training.diffusion.react import Request, pad_to_stride, react
from training.motion.rigid_body import bone_lengths

EXPORTED = Path(__file__).parents[2] / "fixtures" / "tiny-model"
FRAMES = 100


@pytest.fixture(scope="module")
def model() -> Model:
    return tiny_model()


def request(**changes) -> Request:
    music = np.random.default_rng(0).normal(size=(FRAMES, 54)).astype(np.float32)
    return replace(Request(made_dancer(FRAMES, 1), music, seed=1), **changes)


def bones(motion: np.ndarray) -> np.ndarray:
    """(T, 21) metres."""
    return bone_lengths(torch.from_numpy(motion)[None])[0, :, 1:].numpy()


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


def weights_of(control: str, value: float) -> dict:
    """The part of a request that sets one control, coarse and fine beside each other's 0."""
    return {
        "coarse": {"guidance": (value, 0.0)},
        "fine": {"guidance": (0.0, value)},
        "music": {"music_guidance": value},
        "variety": {"variety": value},
    }[control]


ENDS = [(control, end) for control, limits in CONTROLS.items() for end in (limits.low, limits.high)]


def test_the_body_is_the_same_for_all_weights_and_seeds(model: Model) -> None:
    """Every control and seed moves the dance, and none the lengths of the bones."""
    usual = react(model, request(guidance=(0.0, 0.0), music_guidance=0.0, variety=1.0))
    # Single precision, and the joints pass the leader's scale.
    assert np.abs(bones(usual) - bones(usual)[0]).max() < 1e-5
    for control, end in ENDS:
        neutral = {"guidance": (0.0, 0.0), "music_guidance": 0.0, "variety": 1.0}
        made = react(model, request(**neutral | weights_of(control, end)))
        assert np.abs(bones(made) - bones(usual)[0]).max() < 1e-5, f"{control} at {end}"
        if (control, end) != ("music", 0.0):
            assert np.abs(made - usual).max() > 1e-3, f"{control} at {end} is a no-op"
    other = react(model, request(seed=2))
    assert np.abs(bones(other) - bones(usual)[0]).max() < 1e-5
    assert np.abs(other - usual).max() > 1e-3


def test_a_weight_that_is_not_given_is_the_models_default(model: Model) -> None:
    chosen = replace(
        model,
        diffusion=replace(model.diffusion, guidance=(0.5, -0.5), music_guidance=2.0, variety=0.5, steps=3),
    )
    made = react(chosen, request())
    given = request(guidance=(0.5, -0.5), music_guidance=2.0, variety=0.5, steps=3)
    assert np.array_equal(made, react(chosen, given))
    assert np.array_equal(made, react(model, given))
    for changes in (
        {"guidance": (0.0, -0.5)},
        {"guidance": (0.5, 0.0)},
        {"music_guidance": 0.0},
        {"variety": 1.0},
    ):
        assert not np.allclose(made, react(chosen, replace(given, **changes)), atol=1e-3), changes


def test_without_a_song_music_guidance_changes_nothing(model: Model) -> None:
    def apart(at_every_step: bool, **changes) -> float:
        weak, strong = (
            react(model, request(music_guidance=weight, at_every_step=at_every_step, **changes))
            for weight in (0.0, 3.0)
        )
        return float(np.abs(strong - weak).max())

    assert apart(False, music=None) == 0
    assert apart(True, music=None, variety=1.0) < 1e-4
    assert apart(False) > 1e-3
    assert apart(True, variety=1.0) > 1e-3


def test_a_model_that_was_told_one_leader_still_dances_beside_the_other(model: Model) -> None:
    other = made_dancer(FRAMES, 2)
    beside = react(model, request(condition_leader=other))
    assert np.abs(beside - react(model, request())).max() > 5e-4
    aside = np.array([3, 0, 0], np.float32)
    moved = react(model, request(leader=request().leader + aside, condition_leader=other))
    assert np.abs(moved - beside - aside).max() < 5e-5


def test_both_forms_of_guidance_are_the_same_dance_without_weights_and_others_with(model: Model) -> None:
    for guidance, same in (((0.0, 0.0), True), ((0.7, 0.0), False), ((0.0, 1.0), False)):
        each = [
            react(
                model,
                request(guidance=guidance, music_guidance=0.0, variety=1.0, at_every_step=at_every_step),
            )
            for at_every_step in (False, True)
        ]
        assert np.allclose(*each, atol=1e-3) is same, guidance


def test_an_exported_model_refuses_guidance_at_every_step() -> None:
    exported = open_model(EXPORTED, threads=1)
    with pytest.raises(ValueError, match="checkpoint"):
        react(exported, request(at_every_step=True))


def test_guidance_at_every_step_is_in_the_latents_and_not_in_the_gains_of_the_decoder(model: Model) -> None:
    decoded_with: list[torch.Tensor] = []

    class Recorded(Model):
        def decode(self, latents, leader, gains, role):
            decoded_with.append(gains)
            return super().decode(latents, leader, gains, role)

    recorded = Recorded(model.hfsq, model.frame, model.denoiser, model.diffusion, model.reference_height)
    react(recorded, request(guidance=(0.4, 0.7), at_every_step=True))
    assert all((gains == 1).all() for gains in decoded_with)
    react(recorded, request(guidance=(0.4, 0.7)))
    assert decoded_with[-1][:, 1].tolist() == pytest.approx([1.7] * 3)


def test_a_leader_stands_still_after_the_end_up_to_a_whole_latent_frame() -> None:
    leader = np.arange(6.0)[:, None]
    assert pad_to_stride(leader)[:, 0].tolist() == [0, 1, 2, 3, 4, 5, 5, 5]
    assert len(pad_to_stride(leader[:4])) == 4
