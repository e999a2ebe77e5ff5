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
from training.diffusion.schedule import Step


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
            alternating_phase=diffusion["alternating_phase"],
            stitching=False,
            steps=diffusion["steps"]["default"],
            guidance=(guidance["coarse"]["default"], guidance["fine"]["default"]),
            music_guidance=guidance["music"]["default"],
            reference_height=self.manifest["skeleton"]["reference_height"],
        )

    def condition(self, leader: Tensor, music: Tensor, music_valid: Tensor, role: Tensor) -> Tensor:
        (memory,) = self._run("condition", leader=leader, music=music, music_valid=music_valid, role=role)
        return memory

    def step(self, x: Tensor, memory: Tensor, valid: Tensor, keep: float, step: Step) -> Tensor:
        (following,) = self._run(
            "step",
            x=x,
            memory=memory,
            valid=valid,
            keep=torch.tensor([keep]),
            time=torch.tensor([step.time]),
            coefficients=torch.tensor([step.a, step.b]),
        )
        return following

    def decode(self, latents: Tensor, leader: Tensor, gains: Tensor, bones: Tensor) -> tuple[Tensor, Tensor]:
        reactor, lengths = self._run("decode", latents=latents, leader=leader, gains=gains, bones=bones)
        return reactor, lengths

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
