"""A reactor through the autoencoder and back."""

from __future__ import annotations

import numpy as np
import torch

from training.config import STRIDE, FrameConfig
from training.data.duet import Duet
from training.hfsq.autoencoder import Autoencoder
from training.motion.leader_frame import smoothed_heading
from training.motion.rigid_body import rigid_body
from training.motion.streams import from_streams, to_streams


@torch.no_grad()
def reconstruct(model: Autoencoder, duet: Duet, frame: FrameConfig, layers: int | None = None) -> np.ndarray:
    """The reactor (T, 22, 3) after encoding and decoding, from the first `layers` layers if given."""
    frames = len(duet) // STRIDE * STRIDE
    leader = torch.from_numpy(duet.leader[:frames])
    heading = smoothed_heading(leader, frame)
    streams = to_streams(leader, torch.from_numpy(duet.reactor[:frames]), heading)
    latents = model.encode([s[None] for s in streams])
    if layers is not None:
        latents[:, :, layers:] = 0
    upper, lower, placement = (stream[0] for stream in model.decode(latents))
    return rigid_body(from_streams(upper, lower, placement, leader, heading)[None])[0].numpy()
