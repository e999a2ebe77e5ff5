"""A model that is asked for the same predictions again and again, as when a control moves over its travel."""

from __future__ import annotations

from hashlib import blake2b

from torch import Tensor

from training.diffusion.model import ReactionModel, Sampling

MAX_PREDICTIONS = 4096  # about 0.4 MB each for a dance of a minute


class CachedModel:
    """A `ReactionModel` that answers predictions it has made before from memory, the oldest ones forgotten first.

    Controls blend latents after sampling, so all settings of a control share their predictions.
    """

    def __init__(self, model: ReactionModel) -> None:
        self.model = model
        self._predictions: dict[bytes, Tensor] = {}

    @property
    def sampling(self) -> Sampling:
        return self.model.sampling

    def condition(self, leader: Tensor, music: Tensor, music_valid: Tensor, role: Tensor) -> Tensor:
        return self.model.condition(leader, music, music_valid, role)

    def unfamiliarity(self, leader: Tensor) -> Tensor:
        return self.model.unfamiliarity(leader)

    def predict(self, x: Tensor, memory: Tensor, valid: Tensor, keep: Tensor, time: Tensor) -> Tensor:
        inputs = (x, memory, valid, keep, time)
        key = blake2b(b"".join(value.contiguous().numpy().tobytes() for value in inputs)).digest()
        if key not in self._predictions:
            if len(self._predictions) == MAX_PREDICTIONS:
                del self._predictions[next(iter(self._predictions))]
            self._predictions[key] = self.model.predict(*inputs)
        return self._predictions[key]

    def decode(self, latents: Tensor, leader: Tensor, gains: Tensor, role: Tensor) -> Tensor:
        return self.model.decode(latents, leader, gains, role)
