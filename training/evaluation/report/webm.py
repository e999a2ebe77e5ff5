"""A WebM file of VP8 key frames, written without a video encoder.

A lossy WebP picture is one VP8 key frame in another box, so Pillow makes the frames and this puts them into
Matroska's EBML: every frame can be sought, any browser plays it, and nothing has to be installed.
"""

from __future__ import annotations

import io
import struct
from collections.abc import Iterable, Sequence

from PIL import Image

from training.config import FPS

CLUSTER_FRAMES = 30  # of a Matroska cluster, which has one time stamp and one entry of the seek table
_MILLISECOND_NS = 1_000_000  # the unit of all times in the file


def key_frame(picture: Image.Image) -> bytes:
    """The VP8 key frame of an RGB picture."""
    if picture.mode != "RGB":  # an alpha channel would be kept beside the VP8 data, not in it
        raise ValueError(f"a video frame has to be RGB, got {picture.mode}")
    box = io.BytesIO()
    picture.save(box, "WEBP", quality=70, method=2)
    data = box.getvalue()
    if data[12:16] != b"VP8 ":
        raise ValueError(f"expected a lossy WebP picture, got chunk {data[12:16]!r}")
    (size,) = struct.unpack("<I", data[16:20])
    return data[20 : 20 + size]


def _element(name: int, content: bytes) -> bytes:
    """EBML: an id, the size in eight bytes, the content."""
    return (
        name.to_bytes((name.bit_length() + 7) // 8, "big")
        + struct.pack(">Q", 1 << 56 | len(content))
        + content
    )


def _unsigned(name: int, value: int) -> bytes:
    return _element(name, struct.pack(">Q", value))


def _milliseconds(frame: int) -> int:
    return round(frame * 1000 / FPS)


def _cluster(frames: Sequence[bytes], first: int) -> bytes:
    """Frames from number `first` on; each says how many ms after the cluster's time it is shown."""
    start = _milliseconds(first)
    blocks = [_unsigned(0xE7, start)]
    for number, frame in enumerate(frames, first):
        head = struct.pack(">BhB", 0x81, _milliseconds(number) - start, 0x80)  # track 1, time, key frame
        blocks.append(_element(0xA3, head + frame))
    return _element(0x1F43B675, b"".join(blocks))


def _cues(positions: Sequence[int]) -> bytes:
    """Where in the segment each cluster begins, bytes."""
    points = [
        _element(
            0xBB,
            _unsigned(0xB3, _milliseconds(index * CLUSTER_FRAMES))
            + _element(0xB7, _unsigned(0xF7, 1) + _unsigned(0xF1, position)),
        )
        for index, position in enumerate(positions)
    ]
    return _element(0x1C53BB6B, b"".join(points))


def webm(pictures: Iterable[Image.Image]) -> bytes:
    """The file's bytes for RGB pictures of one size. Raises ValueError without pictures or with another size."""
    frames: list[bytes] = []
    sizes: set[tuple[int, int]] = set()
    for picture in pictures:
        sizes.add(picture.size)
        frames.append(key_frame(picture))
    if len(sizes) != 1:
        raise ValueError(f"a video needs pictures of one size, got {sorted(sizes) or 'none'}")
    ((width, height),) = sizes
    header = _element(
        0x1A45DFA3,
        _unsigned(0x4286, 1) + _unsigned(0x42F7, 1) + _unsigned(0x42F2, 4) + _unsigned(0x42F3, 8)
        + _element(0x4282, b"webm") + _unsigned(0x4287, 2) + _unsigned(0x4285, 2),
    )  # fmt: skip
    info = _element(
        0x1549A966,
        _unsigned(0x2AD7B1, _MILLISECOND_NS) + _element(0x4D80, b"reactdance") + _element(0x5741, b"reactdance")
        + _element(0x4489, struct.pack(">d", len(frames) * 1000 / FPS)),
    )  # fmt: skip
    track = _element(
        0xAE,
        _unsigned(0xD7, 1) + _unsigned(0x73C5, 1) + _unsigned(0x83, 1) + _unsigned(0x9C, 0) + _element(0x86, b"V_VP8")
        + _unsigned(0x23E383, round(1e9 / FPS)) + _element(0xE0, _unsigned(0xB0, width) + _unsigned(0xBA, height)),
    )  # fmt: skip
    head = info + _element(0x1654AE6B, track)
    clusters = [_cluster(frames[i : i + CLUSTER_FRAMES], i) for i in range(0, len(frames), CLUSTER_FRAMES)]
    # The seek table stands before the clusters; numbers have a fixed width, so its own length is known.
    begin = len(head) + len(_cues([0] * len(clusters)))
    positions = [begin + sum(map(len, clusters[:i])) for i in range(len(clusters))]
    return header + _element(0x18538067, head + _cues(positions) + b"".join(clusters))
