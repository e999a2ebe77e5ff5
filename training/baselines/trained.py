"""A trained baseline: by name, from its folder, and the reactor that it makes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch

from training.baselines.duolando import Duolando
from training.baselines.edge import Edge
from training.baselines.gesturelsm import GestureLsm
from training.baselines.intergen import InterGen
from training.baselines.method import BaselineConfig, Known, Method
from training.baselines.tcdiff import TcDiff
from training.checkpoint import load_hfsq, read_config, start_from, weights_digest
from training.config import STREAMS, DiffusionConfig, FrameConfig, from_json
from training.diffusion.decode import decode, decoded_joints
from training.diffusion.react import at_height, music_of_length, scale_to
from training.hfsq.autoencoder import Autoencoder
from training.motion.leader_frame import smoothed_heading
from training.motion.rigid_body import bone_lengths
from training.motion.streams import leader_features

METHODS: Mapping[str, type[Method]] = {
    "edge": Edge,
    "intergen": InterGen,
    "tcdiff": TcDiff,
    "duolando": Duolando,
    "gesturelsm": GestureLsm,
}


@dataclass(frozen=True)
class Baseline:
    """A trained method with its autoencoder."""

    method: Method
    hfsq: Autoencoder
    frame: FrameConfig
    reference_height: float

    @torch.no_grad()
    def react(self, leader: np.ndarray, music: np.ndarray | None, seed: int) -> np.ndarray:
        """The reactor (T, 22, 3) metres to a leader (T, 22, 3) metres and music (T', 54) features."""
        sized = at_height(leader, self.reference_height)
        features = leader_features(sized, smoothed_heading(sized, self.frame))[None]
        heard, valid = music_of_length(music, len(sized))
        memory = self.method.condition(features, heard[None], valid[None], torch.zeros(1))
        known = Known(memory, self.method.leader_tokens(features), torch.ones(memory.shape[:2]))
        latents = self.method.sample(known, torch.Generator().manual_seed(seed))
        gains = torch.ones(len(STREAMS), self.hfsq.layers)
        joints = decoded_joints(self.hfsq, self.frame, latents, sized, gains)
        bones = bone_lengths(joints[None])[0].mean(0)
        reactor = decode(self.hfsq, self.frame, DiffusionConfig(), latents, sized, gains, bones)
        return reactor[: len(leader)].numpy() / scale_to(leader, self.reference_height)


def make_method(config: BaselineConfig, hfsq: Autoencoder) -> Method:
    """A method with random weights."""
    return METHODS[config.method](config, hfsq)


def load_baseline(folder: Path) -> Baseline:
    """A trained baseline of a folder that `training.baselines` has written.

    Raises ValueError where stage 1 of the folder is not the one that it was trained on.
    """
    hfsq, frame = load_hfsq(folder)
    values = read_config(folder, "baseline")
    if values["stage_1"] != weights_digest(hfsq):
        raise ValueError(f"{folder / 'baseline.safetensors'} was trained on another stage 1: train it again")
    config = from_json(BaselineConfig, values["baseline"])
    method = make_method(config, hfsq)
    start_from(method, folder, "baseline")
    return Baseline(method.eval().requires_grad_(False), hfsq, frame, values["reference_height"])
