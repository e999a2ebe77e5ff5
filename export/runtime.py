"""An exported model under onnxruntime: the browser's graphs behind the interface of `training.diffusion.model`."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import onnxruntime as ort
import torch
from torch import Tensor

from export.onnx_files import Backend
from training.diffusion.model import Sampling
from training.music.recipe import MUSIC_FEATURES


@dataclass(frozen=True)
class Exported:
    """A model folder opened for inference, a `ReactionModel`."""

    manifest: dict[str, Any]
    sessions: dict[str, ort.InferenceSession]

    @property
    def sampling(self) -> Sampling:
        latent, diffusion = self.manifest["latent"], self.manifest["diffusion"]
        guidance = self.manifest["guidance"]
        return Sampling(
            block=latent["block"],
            layers=len(latent["layers"]),
            channels=latent["channels"],
            alpha_bar=np.array(diffusion["alphas_cumprod"]),
            last_time=diffusion["last_time"],
            extrapolation=(0.0,) * len(latent["streams"]),
            stitching=False,
            steps=diffusion["steps"],
            guidance=(guidance["coarse"]["default"], guidance["fine"]["default"]),
            music_guidance=guidance["music"]["default"],
            variety=guidance["variety"]["default"],
            mean_seeds=guidance["variety"]["seeds"],
            reference_height=self.manifest["skeleton"]["reference_height"],
        )

    def condition(self, leader: Tensor, music: Tensor, music_valid: Tensor, role: Tensor) -> Tensor:
        return self._condition(leader, music, music_valid, role)[0]

    def unfamiliarity(self, leader: Tensor) -> Tensor:
        silence = torch.zeros(len(leader), MUSIC_FEATURES)
        return self._condition(leader, silence, silence[:, 0], torch.zeros(1))[1]

    def predict(self, x: Tensor, memory: Tensor, valid: Tensor, keep: Tensor, time: Tensor) -> Tensor:
        step = {"a": torch.zeros(1), "b": torch.ones(1)}  # to the prediction itself
        return self._run("step", x=x, memory=memory, valid=valid, keep=keep, time=time, **step)[0]

    def decode(self, latents: Tensor, leader: Tensor, gains: Tensor, role: Tensor) -> Tensor:
        return self._run("decode", latents=latents, leader=leader, gains=gains, role=role)[0]

    def _condition(self, leader: Tensor, music: Tensor, music_valid: Tensor, role: Tensor) -> list[Tensor]:
        return self._run("condition", leader=leader, music=music, music_valid=music_valid, role=role)

    def _run(self, graph: str, **inputs: Tensor) -> list[Tensor]:
        feed = {name: np.ascontiguousarray(value.numpy(), dtype=np.float32) for name, value in inputs.items()}
        return [torch.from_numpy(np.asarray(out)) for out in self.sessions[graph].run(None, feed)]


def open_model(folder: Path, threads: int = 0, backend: Backend = "wasm") -> Exported:
    """Load manifest.json and the graphs that the page loads for a backend; threads 0 is onnxruntime's default."""
    manifest = json.loads((folder / "manifest.json").read_text())
    options = ort.SessionOptions()
    options.intra_op_num_threads = threads
    sessions = {
        name: ort.InferenceSession(
            str(folder / graph["files"][backend]["path"]), options, providers=["CPUExecutionProvider"]
        )
        for name, graph in manifest["graphs"].items()
    }
    return Exported(manifest, sessions)
