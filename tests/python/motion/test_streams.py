"""The frame of reference and the three streams."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from tests.python.support.duets import made_duet
from training.config import FrameConfig
from training.motion.heading import into_frame, out_of_frame
from training.motion.leader_frame import arctangent, cosine_sine, smoothed_heading, smoothed_root
from training.motion.rigid_body import bone_lengths, constant_bones, rigid_body, steady_bones
from training.motion.skeleton import PARENTS, TOES
from training.motion.streams import (
    LEADER_FEATURES,
    STREAM_WIDTHS,
    from_streams,
    leader_features,
    to_streams,
)

FRAME = FrameConfig()


def pair(frames: int = 120) -> tuple[torch.Tensor, torch.Tensor]:
    duet = made_duet(frames, 3)
    return torch.from_numpy(duet.leader), torch.from_numpy(duet.reactor)


def moved(motion: torch.Tensor, angle: float, shift: tuple[float, float]) -> torch.Tensor:
    """Turned about the vertical by `angle` radians and moved over the floor by `shift` metres."""
    c, s = np.cos(angle), np.sin(angle)
    turn = torch.tensor([[c, 0, s], [0, 1, 0], [-s, 0, c]], dtype=torch.float32)
    return motion @ turn.T + torch.tensor([shift[0], 0, shift[1]])


def test_from_streams_inverts_to_streams() -> None:
    leader, reactor = pair()
    heading = smoothed_heading(leader, FRAME)
    streams = to_streams(leader, reactor, heading)
    assert tuple(s.shape[1] for s in streams) == STREAM_WIDTHS
    assert torch.allclose(from_streams(*streams, leader, heading), reactor, atol=1e-5)


@pytest.mark.parametrize("angle", [0.4, 2.0, -3.0])
def test_streams_do_not_depend_on_the_couples_place_and_facing(angle: float) -> None:
    leader, reactor = pair()
    before = (*to_streams(leader, reactor, smoothed_heading(leader, FRAME)),)
    led, reacted = moved(leader, angle, (3, -2)), moved(reactor, angle, (3, -2))
    after = to_streams(led, reacted, smoothed_heading(led, FRAME))
    for a, b in zip(before, after, strict=True):
        assert torch.allclose(a, b, atol=1e-4)
    features = leader_features(leader, smoothed_heading(leader, FRAME))
    assert torch.allclose(features, leader_features(led, smoothed_heading(led, FRAME)), atol=2e-3)


def test_heading_is_the_direction_the_hips_face() -> None:
    leader = torch.zeros(200, 22, 3)
    leader[:, 1, 0], leader[:, 2, 0] = 0.1, -0.1  # left hip at +x: the dancer faces +z
    assert torch.allclose(smoothed_heading(leader, FRAME), torch.tensor([0.0, 1.0]).expand(200, 2), atol=1e-5)
    turned = moved(leader, np.pi / 2, (0, 0))  # +z turns to +x
    assert torch.allclose(smoothed_heading(turned, FRAME), torch.tensor([1.0, 0.0]).expand(200, 2), atol=1e-5)
    vector = torch.tensor([1.0, 2.0, 3.0]).expand(200, 1, 3)
    heading = smoothed_heading(turned, FRAME)
    assert torch.allclose(out_of_frame(into_frame(vector, heading), heading), vector, atol=1e-5)


def test_leader_features_hold_height_velocity_and_turn_rate() -> None:
    """Without them placement would be a mean distance."""
    leader, _ = pair(200)
    walking = leader + torch.arange(200)[:, None, None] * torch.tensor([0.02, 0.0, 0.0])
    lifted = leader + torch.tensor([0.0, 0.3, 0.0])
    features = {
        name: leader_features(motion, smoothed_heading(motion, FRAME))
        for name, motion in (("still", leader), ("walking", walking), ("lifted", lifted))
    }
    assert features["still"].shape == (200, LEADER_FEATURES)
    velocity, height = slice(64, 67), 63
    speed = (features["walking"] - features["still"])[:, velocity].norm(dim=-1)
    assert torch.allclose(speed, torch.full_like(speed, 0.6), atol=1e-3)
    assert torch.allclose((features["lifted"] - features["still"])[:, height], torch.tensor(0.3), atol=1e-5)
    spin = torch.arange(200) * 0.05
    turning = torch.stack([moved(leader[:1], float(a), (0, 0))[0] for a in spin])
    rate = leader_features(turning, smoothed_heading(turning, FRAME))[60:140, 67]
    assert torch.allclose(rate, torch.full_like(rate, np.sin(0.05) * 30), atol=0.02)


def test_velocity_and_turn_rate_of_a_frame_are_those_since_the_one_before() -> None:
    time = torch.arange(40.0)
    leader = torch.zeros(40, 22, 3)
    leader[..., 0] = 0.001 * (time**2)[:, None]
    angle = 0.001 * time**2
    features = leader_features(leader, torch.tensor([0.0, 1.0]).expand(40, 2))
    speed = leader[:, 0, 0].diff() * 30
    assert torch.allclose(features[1:, 64], speed, atol=1e-5)
    assert features[0, 64] == features[1, 64], "the first frame has none before"
    turning = leader_features(leader, torch.stack([angle.sin(), angle.cos()], dim=-1))[:, 67]
    assert torch.allclose(turning[1:], angle.diff().sin() * 30, atol=1e-4)
    assert turning[0] == turning[1]


def test_the_leaders_place_is_smoothed_and_the_height_kept() -> None:
    time = torch.arange(60.0)
    leader = torch.zeros(60, 22, 3)
    jerk = 0.02 * (-1) ** time
    leader[:, 0] = torch.stack([0.02 * time + jerk, 1 + jerk, -0.01 * time + jerk], dim=-1)
    root = smoothed_root(leader)
    assert root.shape == (60, 1, 3)
    middle = slice(10, -10)
    assert torch.allclose(root[middle, 0, 0], 0.02 * time[middle], atol=1e-3)
    assert torch.allclose(root[middle, 0, 2], -0.01 * time[middle], atol=1e-3)
    assert torch.equal(root[:, 0, 1], leader[:, 0, 1])


def test_placement_holds_the_reactors_own_height() -> None:
    leader, reactor = pair()
    heading = smoothed_heading(leader, FRAME)
    jump = leader + torch.tensor([0.0, 0.5, 0.0])
    assert torch.equal(to_streams(leader, reactor, heading)[2], to_streams(jump, reactor, heading)[2])


def test_the_frame_turns_evenly_with_a_leader_who_spins() -> None:
    """Two turns a second are more than the Gaussian sees of one direction: their average has none."""
    pace = 2 * np.pi * 2 / 30
    still = torch.zeros(1, 22, 3)
    still[:, 1, 0], still[:, 2, 0] = 0.1, -0.1
    spinning = torch.cat([moved(still, pace * frame, (0, 0)) for frame in range(150)])
    heading = smoothed_heading(spinning, FRAME)[45:-45]
    assert torch.allclose(heading.norm(dim=-1), torch.ones(60), atol=1e-5)
    cross = heading[:-1, 1] * heading[1:, 0] - heading[:-1, 0] * heading[1:, 1]
    assert torch.allclose(cross, torch.full_like(cross, np.sin(pace)), atol=1e-4)
    angles = pace * torch.arange(45, 105)
    assert torch.allclose(heading, torch.stack([angles.sin(), angles.cos()], dim=-1), atol=1e-3)


def test_the_frame_does_not_follow_the_swing_of_the_hips() -> None:
    swing = 0.5 * torch.sin(2 * np.pi * 1.5 * torch.arange(240) / 30)
    still = torch.zeros(1, 22, 3)
    still[:, 1, 0], still[:, 2, 0] = 0.1, -0.1
    swinging = torch.cat([moved(still, float(angle), (0, 0)) for angle in swing])
    heading = smoothed_heading(swinging, FRAME)[45:-45]
    assert torch.allclose(heading, torch.tensor([0.0, 1.0]).expand_as(heading), atol=0.02)


def test_the_frame_turns_slowly_when_a_lying_leaders_hips_face_the_other_way_within_a_frame() -> None:
    """The hips of a leader who lies on one side are one above the other, and rolling over turns where they face."""
    still = torch.zeros(1, 22, 3)
    still[:, 1, 0], still[:, 2, 0] = 0.1, -0.1
    rolled = moved(still, 2.9, (0, 0))
    heading = smoothed_heading(torch.cat([still] * 75 + [rolled] * 75), FRAME)
    cross = heading[:-1, 1] * heading[1:, 0] - heading[:-1, 0] * heading[1:, 1]
    assert cross.abs().max() < 0.1, "the reactor turns with the frame, and would jump"
    assert torch.allclose(heading[-1], smoothed_heading(rolled, FRAME)[0], atol=1e-3)


def test_bones_keep_their_length_and_direction() -> None:
    _, reactor = pair(60)
    stretched = reactor * (1 + 0.2 * torch.sin(torch.arange(60.0) / 5))[:, None, None]
    made = constant_bones(stretched, bone_lengths(stretched).mean(-2))
    parents = list(PARENTS[1:])

    def bones(motion: torch.Tensor) -> torch.Tensor:
        return motion[:, 1:] - motion[:, parents]

    lengths = bones(made).norm(dim=-1)
    assert torch.allclose(lengths, lengths[:1].expand_as(lengths), atol=1e-5)
    assert torch.allclose(lengths[0], bones(stretched).norm(dim=-1).mean(0), atol=1e-4)
    cosine = torch.cosine_similarity(bones(made), bones(stretched), dim=-1)
    assert torch.allclose(cosine, torch.ones_like(cosine), atol=1e-4)
    assert torch.equal(made[:, 0], stretched[:, 0])
    assert torch.allclose(constant_bones(made, bone_lengths(made).mean(-2)), made, atol=1e-5)


def test_a_bone_that_shrinks_and_grows_again_the_other_way_turns_there() -> None:
    """An arm that is decoded half up and half down would flip within a frame at constant length."""
    _, reactor = pair(60)
    still = reactor[:1].expand(60, -1, -1).clone()
    elbow, wrist = 19, 21
    lengths = bone_lengths(still).mean(-2)
    up = torch.tensor([0.2, 1.0, 0.1]) / torch.tensor([0.2, 1.0, 0.1]).norm()
    share = (1 - 2 * torch.arange(60.0) / 59).mul(4).clamp(-1, 1)
    arm = share[:, None] * up + (1 - share.abs())[:, None] * torch.tensor([0.0, 0.0, 0.02])
    hand = still[:, wrist] - still[:, elbow]
    decoded = still.clone()
    decoded[:, elbow] = still[:, PARENTS[elbow]] + arm * lengths[elbow]
    decoded[:, wrist] = decoded[:, elbow] + hand

    def degrees_a_frame(motion: torch.Tensor) -> torch.Tensor:
        bone = motion[:, elbow] - motion[:, PARENTS[elbow]]
        return torch.cosine_similarity(bone[1:], bone[:-1]).clamp(-1, 1).acos().rad2deg()

    assert degrees_a_frame(constant_bones(decoded, lengths)).max() > 90
    steady = steady_bones(decoded[None], lengths)[0]
    turning = degrees_a_frame(steady)
    assert turning.max() < 45
    assert turning[:15].max() < 0.1, "long bones stay as they are"
    others = [joint for joint in range(22) if joint not in (elbow, wrist)]
    assert torch.allclose(steady[:, others], decoded[:, others], atol=1e-5)
    assert torch.allclose(steady[:, wrist] - steady[:, elbow], hand, atol=1e-5), (
        "the forearm keeps its direction"
    )
    assert torch.allclose(bone_lengths(steady), bone_lengths(decoded), atol=1e-5)


def test_bones_that_are_decoded_nearly_as_long_as_they_should_be_move_as_decoded() -> None:
    _, reactor = pair(60)
    lengths = bone_lengths(reactor).mean(-2)
    certain, unsure = (constant_bones(reactor, share * lengths)[None] for share in (0.81, 0.7))
    assert torch.allclose(steady_bones(certain, lengths), certain, atol=1e-5)
    assert (steady_bones(unsure, lengths) - unsure).abs().max() > 1e-3


def test_the_lower_toe_keeps_its_height_when_legs_are_lengthened() -> None:
    """Feet that bones of their mean length would push through the floor stay where they were."""
    reactor = pair(120)[1] + torch.tensor([0.0, 0.1, 0.0])
    shrunk = reactor.clone()
    shrink = 0.1 * torch.exp(-(((torch.arange(120.0) - 60) / 20) ** 2))
    shrunk[:, :, 1] = reactor[:, :, 1] * (1 - shrink)[:, None] + reactor[:, :1, 1] * shrink[:, None]

    def lower(motion: torch.Tensor) -> torch.Tensor:
        return motion[:, list(TOES), 1].amin(1)

    sunk = (lower(constant_bones(shrunk, bone_lengths(shrunk).mean(-2))) - lower(shrunk)).abs()
    kept = (lower(rigid_body(shrunk[None], floor=False)[0]) - lower(shrunk)).abs()
    assert sunk.max() > 0.02
    assert kept.max() < 0.25 * sunk.max()
    sunk_body = rigid_body(shrunk[None] - torch.tensor([0.0, 0.3, 0.0]))[0]
    assert lower(sunk_body).min() > 0.015, "nobody stands in the floor"
    body = rigid_body(shrunk[None])[0]
    moved = body - constant_bones(shrunk, bone_lengths(shrunk).mean(-2))
    assert moved[..., [0, 2]].abs().max() == 0, "it only rises and sinks"
    assert (moved[..., 1] - moved[:, :1, 1]).abs().max() < 1e-6, "as a whole"


def test_arctangent_cosine_and_sine_are_exact_where_they_are_used() -> None:
    x = torch.cat([torch.linspace(-3, 3, 2001), torch.tensor([-1e6, 1e6])])
    assert torch.allclose(arctangent(x), x.atan(), atol=5e-7)
    angle = torch.linspace(-4 * np.pi, 4 * np.pi, 5001)
    cosine, sine = cosine_sine(angle)
    assert torch.allclose(cosine, angle.cos(), atol=5e-6)
    assert torch.allclose(sine, angle.sin(), atol=5e-6)
