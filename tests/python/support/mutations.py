"""Damaged copies of a file for tests of its reader, and the check of how the reader takes them."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

# Cases per reader: 1,000, or what the environment variable FUZZ_CASES says.
FUZZ_CASES = int(os.environ.get("FUZZ_CASES", "1000"))
MAX_SECONDS = 2.0

_TOKENS = (
    "NaN",
    "inf",
    "-1",
    "0",
    "2.5",
    "1e9",
    "1e999",
    "-1e6",
    "99999",
    "1,5",
    "",
    "{",
    "}",
    "<img src=x>",
    "\0",
)


def damaged_text(text: str, random: Random) -> str:
    """One to three damages: cut, a changed character, token or line, lines removed or repeated."""
    for _ in range(random.randint(1, 3)):
        parts = re.split(r"(\s+)", text)
        lines = text.split("\n")
        kind = random.randrange(6)
        if kind == 0:
            text = text[: random.randint(0, len(text))]
        elif kind == 1 and text:
            at = random.randrange(len(text))
            text = text[:at] + chr(random.randrange(256)) + text[at + 1 :]
        elif kind == 2:
            parts[random.randrange(0, len(parts), 2)] = random.choice(_TOKENS)
            text = "".join(parts)
        elif kind == 3:
            a, b = (random.randrange(0, len(parts), 2) for _ in range(2))
            parts[a], parts[b] = parts[b], parts[a]
            text = "".join(parts)
        elif kind == 4:
            at = random.randrange(len(lines))
            text = "\n".join(lines[:at] + lines[at + random.randint(1, 3) :])
        else:
            at = random.randrange(len(lines))
            text = "\n".join(lines[:at] + lines[at : at + 3] + lines[at:])
    return text


def damaged_bytes(content: bytes, random: Random) -> bytes:
    """Bits flipped, bytes overwritten by a run of one value, the end cut off, or a part left out."""
    out = bytearray(content)
    kind = random.randrange(4)
    if kind == 0:
        return content[: random.randrange(len(content))]
    if kind == 1:
        return content[: random.randrange(len(content))] + content[random.randrange(len(content)) :]
    if kind == 2:
        at = random.randrange(len(out) - 4)
        out[at : at + 4] = bytes([random.choice((0, 0x7F, 0x80, 0xFF))]) * 4
        return bytes(out)
    for _ in range(random.randint(1, 8)):
        out[random.randrange(len(out))] ^= 1 << random.randrange(8)
    return bytes(out)


def fuzz(
    write: Callable[[Random], object],
    read: Callable[[], Any],
    path: Path,
    meaningful: Callable[[Any], bool],
) -> int:
    """Has a reader read damaged files; returns how many it refused.

    Every case must end in time, in a value that is `meaningful` or in a ValueError or FileNotFoundError that names
    the file `path`.
    """
    refused = 0
    for seed in range(FUZZ_CASES):
        write(Random(seed))
        began = time.perf_counter()
        try:
            assert meaningful(read()), f"case {seed} was read as something without meaning"
        except (ValueError, FileNotFoundError) as error:
            assert path.name in str(error), f"case {seed} does not name the file: {error}"
            refused += 1
        assert time.perf_counter() - began < MAX_SECONDS, f"case {seed} took too long"
    return refused
