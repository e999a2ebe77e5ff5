"""The Python half of the bench, on the tiny model."""

import json
from pathlib import Path

import numpy as np

from export.bench import Options, main
from export.tiny import tiny_model
from tests.python.support.bodies import TRAINING_BODIES
from training.checkpoint import save_denoiser, save_hfsq, write_card

TINY = Path(__file__).parents[2] / "fixtures" / "tiny-model"


def test_it_times_every_stage_and_leaves_the_scene(tmp_path: Path) -> None:
    model = tiny_model()
    save_hfsq(tmp_path / "checkpoint", model.hfsq, model.frame, {})
    save_denoiser(tmp_path / "checkpoint", model.hfsq, model.denoiser, model.diffusion, {})
    write_card(tmp_path / "checkpoint", model.reference_height, 1.4, TRAINING_BODIES, 1.2)
    out = tmp_path / "out"
    main(Options(tmp_path / "checkpoint", TINY, out, frames=122, threads=1, repeats=1))
    scene = np.load(out / "scene.npz")
    assert scene["leader"].shape == (122, 22, 3)
    assert scene["song"].shape == (122 * 512,)
    rows = json.loads((out / "python.json").read_text())
    assert [row["backend"] for row in rows] == ["onnxruntime native", "PyTorch eager"]
    for row in rows:
        assert set(row["seconds"]) == {"features", "condition", "steps", "branches", "decode"}
        assert all(value > 0 for value in row["seconds"].values())
