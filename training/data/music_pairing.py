"""Music for duets: their own song, or, where they were captured without one, music whose beats fall on their
steps."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Literal

import numpy as np

from training.data.augment import warp_factor, warped_length
from training.data.duet import Duet
from training.data.splits import Split
from training.data.step_tempo import duet_tempo
from training.music import features as features_module
from training.music import stretch, synth
from training.music.features import features, load_audio
from training.music.recipe import AudioRecipe
from training.music.tempo import Tempo

SONG_SUFFIXES = (".flac", ".mp3", ".ogg", ".opus", ".wav")


Source = Literal["synth", "song"]


@dataclass(frozen=True)
class Variant:
    """One way to pair music with a dance: how fast the dance runs, where the music comes from, and a seed."""

    warp: float
    source: Source
    seed: int


MusicBank = dict[str, dict[Variant, np.ndarray]]
"""By name of the duet and variant: (warped_length(T, variant.warp), F) float32 music features."""


def variants(
    warps: Iterable[float] = (0.9, 1.0, 1.1), synths: int = 3, songs: int = 2
) -> tuple[Variant, ...]:
    """At every tempo warp so many synthesised pieces and so many songs, each with a seed of its own."""
    counts: tuple[tuple[Source, int], ...] = (("synth", synths), ("song", songs))
    return tuple(
        Variant(warp, source, seed) for warp in warps for source, count in counts for seed in range(count)
    )


class SongShelf:
    """The songs of a folder, each decoded and searched for beats once."""

    def __init__(self, paths: Sequence[Path], recipe: AudioRecipe) -> None:
        self.paths = tuple(paths)
        self._recipe = recipe
        self._loaded: dict[Path, tuple[np.ndarray, np.ndarray]] = {}

    def load(self, path: Path) -> tuple[np.ndarray, np.ndarray]:
        """Samples (N,) and beats (K,) in seconds."""
        if path not in self._loaded:
            audio = load_audio(path, self._recipe)
            self._loaded[path] = (audio, stretch.find_beats(audio, self._recipe))
        return self._loaded[path]

    def choose(self, bpm: float, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray] | None:
        """A random song that can be stretched to the tempo: its samples (N,) and the beats (K,) that are to
        fall on those of the dance, in seconds. None when there is no such song."""
        fitting = []
        for path in self.paths:
            audio, beats = self.load(path)
            chosen = stretch.beats_at_tempo(beats, bpm)
            if chosen is not None:
                fitting.append((audio, chosen))
        return fitting[rng.integers(len(fitting))] if fitting else None


def paired_music(
    frames: int, tempo: Tempo, warp: float, source: SongShelf | None, seed: Sequence[int], recipe: AudioRecipe
) -> np.ndarray:
    """Music for a dance of `frames` frames danced `warp` times as fast, its beats on the dance's.

    tempo: of the dance before warping. source: songs to choose from, None for the synthesiser; where no song
    can be stretched to the tempo the synthesiser plays too. Returns (warped_length(frames, warp) *
    recipe.hop,) float32 mono.
    """
    rng = np.random.default_rng(list(seed))
    samples = warped_length(frames, warp) * recipe.hop
    warped = tempo.warped(warp_factor(frames, warp))
    song = source.choose(warped.bpm, rng) if source else None
    if song is None:
        return synth.percussion(warped, samples, recipe.sample_rate, synth.Kit.random(rng), rng)
    audio, beats = song
    return stretch.stretch_to_tempo(
        audio, beats, warped, samples, recipe, start=int(rng.integers(len(beats)))
    )


def own_music(duet: Duet, warp: float, recipe: AudioRecipe) -> np.ndarray:
    """The duet's own song with the dance warped: (warped_length * hop,) float32, silent after the song's
    end."""
    if duet.song is None:
        raise ValueError(f"{duet.name} has no song")
    audio = load_audio(duet.song, recipe)
    factor = warp_factor(len(duet), warp)
    if factor != 1.0:
        audio = stretch.stretch_by(audio, factor)
    samples = warped_length(len(duet), warp) * recipe.hop
    return np.pad(audio[:samples], (0, max(0, samples - len(audio))))


def list_songs(folder: Path | str) -> tuple[list[Path], list[Path]]:
    """Songs of a folder to train with and to hold out: every fourth by name, so that a test never hears a
    known song.

    Raises FileNotFoundError when the folder holds no songs.
    """
    paths = sorted(path for path in Path(folder).iterdir() if path.suffix.lower() in SONG_SUFFIXES)
    if not paths:
        raise FileNotFoundError(f"no songs ({', '.join(SONG_SUFFIXES)}) in {folder}")
    return [p for i, p in enumerate(paths) if i % 4 != 3], [p for i, p in enumerate(paths) if i % 4 == 3]


def _digest(*parts: bytes) -> str:
    total = hashlib.sha256()
    for part in parts:
        total.update(hashlib.sha256(part).digest())
    return total.hexdigest()[:32]


def _code() -> bytes:
    """Source text of the code that makes the music, so that a change to it empties the cache."""
    modules = (features_module, stretch, synth)
    return "\n".join(Path(str(module.__file__)).read_text() for module in modules).encode()


def _cached(path: Path | None, make: Callable[[], np.ndarray]) -> np.ndarray:
    if path is None:
        return make()
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished = path.with_suffix(".tmp.npy")
        np.save(unfinished, make())
        unfinished.replace(path)
    return np.load(path)


def _features(
    duet: Duet,
    tempo: Tempo | None,
    variant: Variant,
    shelf: SongShelf,
    seed: Sequence[int],
    recipe: AudioRecipe,
) -> np.ndarray:
    """(warped_length, F) features of a duet's music; tempo None: of its own song."""
    if tempo is None:
        audio = own_music(duet, variant.warp, recipe)
    else:
        source = shelf if variant.source == "song" and shelf.paths else None
        own_seed = (*seed, variant.seed, int(variant.source == "song"), round(variant.warp * 1000))
        audio = paired_music(len(duet), tempo, variant.warp, source, own_seed, recipe)
    # The signal is a whole number of hops long, so that centring adds one frame that the dance does not have.
    return features(audio, recipe)[: warped_length(len(duet), variant.warp)]


def build_music_bank(
    split: Split,
    songs_dir: Path | str | None,
    wanted: Sequence[Variant],
    seed: int = 0,
    cache_dir: Path | str | None = None,
    recipe: AudioRecipe | None = None,
) -> MusicBank:
    """Music features of every duet in every wanted variant.

    Training duets get all variants, their tempo from both dancers. Held-out duets get the unwarped variants
    only, their tempo from the leader alone, and songs that no training duet hears. A duet with a song of its
    own gets that song in every variant. Without songs_dir the synthesiser plays all of them. cache_dir: keeps
    features between runs, keyed by all that they depend on.
    """
    recipe = recipe or AudioRecipe()
    known, held_out = list_songs(songs_dir) if songs_dir else ([], [])
    code = _code()
    bank: MusicBank = {}
    for duets, songs, leader_only in ((split.train, known, False), (split.val + split.test, held_out, True)):
        shelf = SongShelf(songs, recipe)
        shelf_bytes = _digest(*(path.read_bytes() for path in songs)).encode()
        for number, duet in enumerate(duets):
            tempo = None if duet.song else duet_tempo(duet, leader_only)
            material = duet.song.read_bytes() if duet.song else shelf_bytes
            bank[duet.name] = {}
            for variant in wanted:
                if leader_only and variant.warp != 1.0:
                    continue
                inputs = {
                    "frames": len(duet),
                    "tempo": asdict(tempo) if tempo else None,
                    "variant": asdict(variant),
                    "seed": (seed, number, int(leader_only)),
                    "recipe": recipe.to_dict(),
                }
                key = _digest(json.dumps(inputs, sort_keys=True).encode(), material, code)
                bank[duet.name][variant] = _cached(
                    Path(cache_dir) / f"{key}.npy" if cache_dir else None,
                    partial(_features, duet, tempo, variant, shelf, inputs["seed"], recipe),
                )
    return bank
