"""An exported model under onnxruntime: the same path as the browser's, in Python."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import onnxruntime as ort
import torch

from training.diffusion.noise import noise
from training.diffusion.sampler import gather, pad_to_stride, partition, scatter
from training.diffusion.schedule import Step, ddim_steps

OnStep = Callable[[int, np.ndarray, np.ndarray], None]


@dataclass(frozen=True)
class Exported:
    """A model folder opened for inference."""

    manifest: dict[str, Any]
    sessions: dict[str, ort.InferenceSession]

    def run(self, graph: str, **inputs: np.ndarray) -> list[np.ndarray]:
        feed = {name: np.ascontiguousarray(value, dtype=np.float32) for name, value in inputs.items()}
        return [np.asarray(out) for out in self.sessions[graph].run(None, feed)]


def open_model(folder: Path, threads: int = 0) -> Exported:
    """Load manifest.json and its graphs (the wasm files) from a folder; threads 0 is onnxruntime's default."""
    manifest = json.loads((folder / "manifest.json").read_text())
    options = ort.SessionOptions()
    options.intra_op_num_threads = threads
    sessions = {
        name: ort.InferenceSession(
            str(folder / graph["files"]["wasm"]["path"]), options, providers=["CPUExecutionProvider"]
        )
        for name, graph in manifest["graphs"].items()
    }
    return Exported(manifest, sessions)


def plan(manifest: dict[str, Any], steps: int | None) -> list[Step]:
    diffusion = manifest["diffusion"]
    return ddim_steps(np.array(diffusion["alphas_cumprod"]), steps or diffusion["steps"]["default"])


def sample(
    model: Exported,
    memory: np.ndarray,
    seed: int,
    steps: list[Step],
    guidance: np.ndarray,
    music_guidance: float,
    on_step: OnStep | None = None,
) -> np.ndarray:
    """Normalised latents (L, R, C) for memory (L, M), in blocks; guidance and music_guidance as in
    `classifier_free_guidance`."""
    latent = model.manifest["latent"]
    size, frames, layers, channels = latent["block"], len(memory), len(latent["layers"]), latent["channels"]
    x = torch.from_numpy(noise(seed, frames, layers * channels)).reshape(frames, layers, channels)
    for k, step in enumerate(steps):
        shifted = model.manifest["diffusion"]["alternating_phase"] and k % 2 == 1
        blocks = partition(frames, size, shifted)
        parts = {
            "x": gather(x, blocks, size),
            "memory": gather(torch.from_numpy(memory), blocks, size),
            "valid": gather(torch.ones(frames), blocks, size),
        }
        x_next, x0_next = model.run(
            "step",
            **{name: value.numpy() for name, value in parts.items()},
            time=np.array([step.time]),
            guidance=guidance,
            music_guidance=np.array([music_guidance]),
            coefficients=np.array([step.a, step.b]),
        )
        x = scatter(torch.from_numpy(x_next), blocks, frames)
        if on_step is not None:
            on_step(k, x.numpy(), scatter(torch.from_numpy(x0_next), blocks, frames).numpy())
    return x.numpy()


def default_guidance(manifest: dict[str, Any]) -> np.ndarray:
    """(S, R) of the manifest's default, the same for all streams."""
    row = [manifest["guidance"]["default"][name] for name in manifest["latent"]["layers"]]
    return np.tile(np.array(row, dtype=np.float32), (len(manifest["latent"]["streams"]), 1))


def react(
    model: Exported,
    leader: np.ndarray,
    music: np.ndarray | None,
    seed: int,
    steps: int | None = None,
    guidance: np.ndarray | None = None,
    role: float = 0.0,
    layers: np.ndarray | None = None,
) -> np.ndarray:
    """The reactor (T, 22, 3) for a leader (T, 22, 3) at the reference height and raw music features or None.

    layers: (R,) multiplier per residual layer when decoding; [1, 0] shows the coarse layer alone.
    """
    frames = len(leader)
    padded = pad_to_stride(leader)
    heard, valid = np.zeros((len(padded), model.manifest["audio"]["features"])), np.zeros(len(padded))
    if music is not None:
        n = min(len(music), len(padded))
        heard[:n], valid[:n] = music[:n], 1
    (memory,) = model.run("condition", leader=padded, music=heard, music_valid=valid, role=np.array([role]))
    weights = default_guidance(model.manifest) if guidance is None else guidance
    louder = model.manifest["guidance"]["music"]["default"]
    latents = sample(model, memory, seed, plan(model.manifest, steps), weights, louder)
    names = model.manifest["latent"]["layers"]
    (reactor,) = model.run(
        "decode", latents=latents, leader=padded, layers=np.ones(len(names)) if layers is None else layers
    )
    return reactor[:frames]
