"""Counter-based noise: a latent frame gets the same numbers whichever block, order or length it is computed in.

The generator is Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011).
Nothing is carried from one number to the next, so the browser and Python agree from a seed alone, a longer
song keeps the noise of its beginning, and one block alone gets what it would have got inside the whole
song.
"""

import numpy as np

_MULTIPLIERS = (np.uint64(0xD2511F53), np.uint64(0xCD9E8D57))
_WEYL = (0x9E3779B9, 0xBB67AE85)
_ROUNDS = 10
_LOW = np.uint64(0xFFFFFFFF)
_HALF = np.uint64(32)


def philox(counter: np.ndarray, key: tuple[int, int]) -> np.ndarray:
    """Philox4x32-10: the counter (..., 4) uint32 under a key of two uint32 -> (..., 4) uint32 random bits."""
    c0, c1, c2, c3 = (np.asarray(counter[..., i], dtype=np.uint64) for i in range(4))
    for turn in range(_ROUNDS):
        k0, k1 = (np.uint64((key[i] + turn * _WEYL[i]) & 0xFFFFFFFF) for i in range(2))
        p0, p1 = c0 * _MULTIPLIERS[0], c2 * _MULTIPLIERS[1]
        c0, c1, c2, c3 = (p1 >> _HALF) ^ c1 ^ k0, p1 & _LOW, (p0 >> _HALF) ^ c3 ^ k1, p0 & _LOW
    return np.stack([c0, c1, c2, c3], axis=-1).astype(np.uint32)


def noise(seed: int, frames: int, channels: int, start: int = 0) -> np.ndarray:
    """Standard normal noise for latent frames start .. start + frames - 1.

    seed: its lowest 32 bits count.  channels: layers x channels of a layer, flattened layer first.
    Returns (frames, channels) float32. Every value depends on (seed, frame, channel) alone.
    """
    quads = -(-channels // 4)
    counter = np.zeros((frames, quads, 4), dtype=np.uint32)
    counter[..., 0] = np.arange(start, start + frames, dtype=np.uint32)[:, None]
    counter[..., 1] = np.arange(quads, dtype=np.uint32)
    bits = philox(counter, (seed & 0xFFFFFFFF, 0))
    # Half a step above the grid: never 0, so the logarithm is finite.
    uniform = (bits.astype(np.float64) + 0.5) / 2.0**32
    radius = np.sqrt(-2.0 * np.log(uniform[..., 0::2]))
    angle = 2.0 * np.pi * uniform[..., 1::2]
    normal = np.stack(
        [radius * np.cos(angle), radius * np.sin(angle)], axis=-1
    )  # (frames, quads, pair, cos | sin)
    return normal.reshape(frames, quads * 4)[:, :channels].astype(np.float32)
