"""The motion beats both languages find.

`python -m tests.python.evaluation.metrics.test_motion_beats_fixture` rewrites
tests/fixtures/motion-beats.json, which the TypeScript tests read.
"""

import json
from pathlib import Path

import numpy as np

from training.evaluation.metrics.beats import beat_scores, motion_beats

GOLDEN = Path(__file__).parents[3] / "fixtures" / "motion-beats.json"
LENGTHS = (2, 12, 150)


def made_motion(frames: int) -> np.ndarray:
    """Three joints that swing at rates of their own, (T, 3, 3), rounded so that JSON holds them exactly."""
    t = np.arange(frames)[:, None, None] / 30
    rate = np.array([0.9, 1.3, 2.1])[None, :, None]
    phase = np.array([0.0, 0.7, 1.9])[None, None, :]
    swing = 0.3 * np.sin(2 * np.pi * rate * t + phase) + 0.1 * np.sin(0.8 * t**2 + phase)
    return np.round(swing * 4096).astype(np.float32) / 4096


def golden() -> list[dict]:
    cases = []
    for frames in LENGTHS:
        motion = made_motion(frames)
        beats = motion_beats(motion)
        music = np.arange(4, frames, 15)
        cases.append(
            {
                "frames": frames,
                "positions": [round(float(value) * 4096) for value in motion.ravel()],
                "beats": beats.tolist(),
                "music": music.tolist(),
                "scores": beat_scores(beats, music).tolist(),
            }
        )
    return cases


def test_golden_file_is_current():
    stored = json.loads(GOLDEN.read_text())
    for old, new in zip(stored, golden(), strict=True):
        np.testing.assert_allclose(old.pop("scores"), new.pop("scores"), rtol=1e-12)
        assert old == new
    assert len(stored[-1]["beats"]) >= 5


if __name__ == "__main__":
    GOLDEN.write_text(json.dumps(golden()) + "\n")
