"""How large networks and trainings of the tables are: the same for all rows of a run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

# By number of residual layers R. Rows of different R have the same number of transformer layers.
SCALES: Mapping[int, str] = {1: "1", 2: "1 0.25", 3: "1 0.25 0.0625", 4: "1 0.25 0.0625 0.015625"}
DEPTHS: Mapping[int, str] = {1: "4", 2: "3 1", 3: "2 1 1", 4: "1 1 1 1"}
LAYER_WEIGHTS: Mapping[int, str] = {1: "1", 2: "1 0.5", 3: "1 0.5 0.25", 4: "1 0.5 0.25 0.125"}


@dataclass(frozen=True)
class Scale:
    """Options of both programs for all rows; a row's own come on top."""

    stage1_steps: int = 1000
    stage2_steps: int = 1000
    stage1_learning_rate: float = 1e-3
    learning_rate: float = 1.5e-3
    """Of the denoiser and of the baselines. Both rates are higher than those of a long training: after so few steps
    stage 1 reconstructs with less than half the error, and stage 2 has a lower loss."""
    batch: int = 12
    width: int = 96
    """Of the denoiser and of the baselines."""
    stage1_width: int = 64
    """Of the autoencoder's body streams; the placement stream has half."""
    copies: int = 1
    """Of every augmented clip."""
    synths: int = 2
    """Synthesised pieces of music for every duet and tempo."""

    def stage1(self) -> dict[str, str]:
        width = self.stage1_width
        return {
            "steps": str(self.stage1_steps),
            "batch": str(self.batch),
            "learning-rate": str(self.stage1_learning_rate),
            "evaluate-every": "1000",
            "hfsq.widths": f"{width} {width} {width // 2}",
            "hfsq.depth": "2",
            "hfsq.refine-width": "32",
        }

    def stage2(self) -> dict[str, str]:
        return {
            **self._both(),
            "denoiser.width": str(self.width),
            "denoiser.depths": DEPTHS[2],
            "denoiser.mlp": "2",
            "loss.layers": LAYER_WEIGHTS[2],
            "loss.windows": "4",
        }

    def baseline(self) -> dict[str, str]:
        """For `training.baselines`, as `stage2` for the denoiser."""
        return {**self._both(), "width": str(self.width)}

    def _both(self) -> dict[str, str]:
        return {
            "steps": str(self.stage2_steps),
            "batch": str(self.batch),
            "learning-rate": str(self.learning_rate),
            "evaluate-every": "1000",
            "synths": str(self.synths),
            "augmentation.copies": str(self.copies),
        }
