"""The tempo of each duet's steps is drawn beside the feet and listed."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.python.support.salsa import salsa_duet
from training.evaluation.report.beat_pictures import Options, main
from training.music.tempo import Tempo


def test_every_duet_has_a_picture_and_a_row(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    truth = {"first": Tempo(150.0, 0.3), "second": Tempo(171.5, 1.9)}
    duets = {name: salsa_duet(900, tempo) for name, tempo in truth.items()}
    data = tmp_path / "duets.npz"
    arrays = {f"{name}/leader": duet.leader for name, duet in duets.items()}
    np.savez(
        data,
        allow_pickle=False,
        **arrays,
        **{f"{name}/follower": duet.reactor for name, duet in duets.items()},
    )
    main(Options(data, val=("second",), out=tmp_path / "beats"))
    rows = [line for line in capsys.readouterr().out.splitlines() if line.startswith("│")]
    cells = [re.split(r"\s*│\s*", row.strip("│ ")) for row in rows]
    assert [row[:2] for row in cells] == [["first", "both"], ["second", "leader"]]
    for name, _, bpm, first, *fits in cells:
        assert float(bpm) == pytest.approx(truth[name].bpm, abs=0.6)
        assert float(first) == pytest.approx(truth[name].first, abs=0.2)
        # A quarter would be chance.
        assert min(int(share.split("%")[0]) for share in (fits[0], fits[2])) > 60
        picture = np.asarray(Image.open(tmp_path / "beats" / f"{name}.png").convert("RGB"))
        assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 100
