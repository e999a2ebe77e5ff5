"""Reads WebM files of VP8 key frames back: walks the EBML and decodes every frame."""

from __future__ import annotations

import io
import struct

from PIL import Image

SEGMENT, INFO, TRACKS, ENTRY, VIDEO = 0x18538067, 0x1549A966, 0x1654AE6B, 0xAE, 0xE0
CUES, POINT, POSITIONS, CUE_CLUSTER, CLUSTER_ID, BLOCK = 0x1C53BB6B, 0xBB, 0xB7, 0xF1, 0x1F43B675, 0xA3


def elements(data: bytes) -> list[tuple[int, int, bytes]]:
    """(id, where it begins, content) of the elements on one level; sizes as any EBML reader takes them."""
    found, at = [], 0
    while at < len(data):
        begin = at
        length = 9 - data[at].bit_length()
        name = int.from_bytes(data[at : at + length], "big")
        at += length
        length = 9 - data[at].bit_length()
        size = int.from_bytes(data[at : at + length], "big") & ((1 << 7 * length) - 1)
        at += length
        assert at + size <= len(data)
        found.append((name, begin, data[at : at + size]))
        at += size
    return found


def inside(data: bytes, *path: int) -> list[bytes]:
    """Contents of all elements at a path of ids."""
    level = [data]
    for name in path:
        level = [content for part in level for found, _, content in elements(part) if found == name]
    return level


def frames(data: bytes) -> list[tuple[int, Image.Image]]:
    """Time in ms and picture of every frame."""
    result = []
    for cluster in inside(data, SEGMENT, CLUSTER_ID):
        start = int.from_bytes(inside(cluster, 0xE7)[0], "big")
        for block in inside(cluster, BLOCK):
            track, offset, flags = struct.unpack(">BhB", block[:4])
            assert (track, flags) == (0x81, 0x80)
            vp8 = block[4:] + b"\0" * (len(block) % 2)
            size = struct.pack("<I", 12 + len(vp8))
            box = b"RIFF" + size + b"WEBPVP8 " + struct.pack("<I", len(block) - 4) + vp8
            result.append((start + offset, Image.open(io.BytesIO(box)).convert("RGB")))
    return result
