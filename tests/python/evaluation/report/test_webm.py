"""The WebM that is written, read back by walking its EBML and by decoding its frames."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from PIL import Image

from tests.python.support.read_webm import (
    CLUSTER_ID,
    CUE_CLUSTER,
    CUES,
    ENTRY,
    INFO,
    POINT,
    POSITIONS,
    SEGMENT,
    TRACKS,
    VIDEO,
    elements,
    frames,
    inside,
)
from training.evaluation.report.webm import CLUSTER_FRAMES, key_frame, webm


def plain(tone: int, size: tuple[int, int] = (48, 32)) -> Image.Image:
    return Image.new("RGB", size, (tone, 40, 200))


def test_every_frame_is_there_at_its_time():
    data = webm(plain(tone * 3) for tone in range(70))
    assert data[:4] == bytes.fromhex("1a45dfa3")
    read = frames(data)
    assert [time for time, _ in read] == [round(i * 1000 / 30) for i in range(70)]
    tones = [np.asarray(picture)[..., 0].mean() for _, picture in read]
    assert tones == pytest.approx([tone * 3 for tone in range(70)], abs=8)
    (info,) = inside(data, SEGMENT, INFO)
    assert struct.unpack(">d", inside(info, 0x4489)[0])[0] == pytest.approx(70 / 30 * 1000)
    (video,) = inside(data, SEGMENT, TRACKS, ENTRY, VIDEO)
    assert [int.from_bytes(inside(video, name)[0], "big") for name in (0xB0, 0xBA)] == [48, 32]


def test_the_seek_table_points_at_the_clusters():
    (segment,) = inside(webm(plain(tone) for tone in range(CLUSTER_FRAMES * 2 + 1)), SEGMENT)
    begins = [begin for name, begin, _ in elements(segment) if name == CLUSTER_ID]
    cues = [int.from_bytes(p, "big") for p in inside(segment, CUES, POINT, POSITIONS, CUE_CLUSTER)]
    assert cues == begins
    assert len(begins) == 3
    times = [int.from_bytes(t, "big") for t in inside(segment, CUES, POINT, 0xB3)]
    assert times == [0, 1000, 2000]


def test_bad_pictures_are_refused():
    with pytest.raises(ValueError, match="none"):
        webm([])
    with pytest.raises(ValueError, match="one size"):
        webm([plain(1), plain(1, (32, 32))])
    with pytest.raises(ValueError, match="RGB"):
        key_frame(Image.new("RGBA", (8, 8)))
