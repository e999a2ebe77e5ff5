"""A second opinion from the mirror: the same question in other words, whose answer errs in other ways.

Every dance was learnt beside its mirror image, so the network can be asked with the leader seen in a mirror and its
answer mirrored back. Not in the paper; what it brings and costs is in training/LOG.md.
"""

from __future__ import annotations

from torch import Tensor

from training.config import DiffusionConfig
from training.denoiser.denoiser import Denoiser
from training.diffusion import signal
from training.hfsq.mirror import LatentMirror

# Standard deviations, root mean square over a latent frame's channels: opinions that lie further apart are of a leader
# unlike those of the training, and count less.
TRUSTED = 0.15


def trusted(change: Tensor) -> Tensor:
    """(N, block, C) as it is where it is small, and by the cube less where it is larger than `TRUSTED`."""
    size = (change.square().mean(-1, keepdim=True) + 1e-8).sqrt()
    return change * (TRUSTED / size).clamp_max(1) ** 3


def second_opinion(
    denoiser: Denoiser,
    mirror: LatentMirror,
    config: DiffusionConfig,
    coarse: Tensor,
    time: Tensor,
    memory: Tensor,
    valid: Tensor,
) -> Tensor:
    """What is to be added to the coarse x0 (N, block, C) that the network believes in under all conditions.

    T mirrors latents, G is asked with `memory` (N, block, 2 D), which knows the mirrored leader and the song:
    weight sqrt(alpha bar) (T(G(sqrt(alpha bar) T(x0))) - T(T(x0))), as far as it is `trusted`. T(T(x0)) in place of x0
    takes off what T loses. The mirrored dance gets no noise of its own, and counts the more the more of a dance there
    is. time (1,), valid (N, block).
    """
    kept = signal(time, config)
    seen = mirror(coarse * valid[..., None])
    answer = denoiser.coarse(kept * seen, time, memory, valid)
    answer, seen = (mirror(each * valid[..., None]) for each in (answer, seen))
    return config.mirror * kept * trusted(answer - seen)
