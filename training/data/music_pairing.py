"""Music features of duets: of their own song, or, without one, of music whose beats fall on their steps."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Literal

import numpy as np

from training.data import augment
from training.data.augment import warp_factor, warped_length
from training.data.duet import Duet
from training.data.splits import Split
from training.data.step_tempo import duet_tempo
from training.music import features as features_module
from training.music import stretch, synth
from training.music import tempo as tempo_module
from training.music.features import SONG_SUFFIXES, features, load_audio
from training.music.recipe import AudioRecipe
from training.music.tempo import Tempo

Source = Literal["synth", "song"]


@dataclass(frozen=True)
class Variant:
    """One way to pair music with a dance.

    warp: factor on the speed of the dance. source: synthesised percussion or a recorded song. seed: of either.
    """

    warp: float
    source: Source
    seed: int


MusicBank = dict[str, dict[Variant, np.ndarray]]
"""By name of the duet and variant: (warped_length(T, variant.warp), F) float32 music features."""


def variants(
    warps: Iterable[float] = (0.9, 1.0, 1.1), synths: int = 3, songs: int = 2
) -> tuple[Variant, ...]:
    """At every warp `synths` synthesised pieces and `songs` recorded songs, with seeds from 0."""
    counts: tuple[tuple[Source, int], ...] = (("synth", synths), ("song", songs))
    return tuple(
        Variant(warp, source, seed) for warp in warps for source, count in counts for seed in range(count)
    )


class SongLibrary:
    """Songs, each decoded and searched for beats once, when it is first needed."""

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
        """A random song that can be stretched to the tempo: samples (N,) and the beats (K,), seconds, to align with
        those of the dance. None when no song can.
        """
        fitting = []
        for path in self.paths:
            audio, beats = self.load(path)
            chosen = stretch.beats_at_tempo(beats, bpm)
            if chosen is not None:
                fitting.append((audio, chosen))
        return fitting[rng.integers(len(fitting))] if fitting else None


def paired_music(
    frames: int,
    tempo: Tempo,
    warp: float,
    source: SongLibrary | None,
    seed: Sequence[int],
    recipe: AudioRecipe,
) -> np.ndarray:
    """Music (warped_length(frames, warp) * recipe.hop,) float32 mono, with its beats on those of the dance.

    frames, tempo: of the dance before it is danced `warp` times as fast. source: songs to choose from; None, or a
    library without a song that can be stretched to the tempo, gives synthesised percussion.
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
    """The duet's own song (warped_length * hop,) float32, stretched like the dance, zero after its end.

    Raises ValueError for a duet without a song.
    """
    if duet.song is None:
        raise ValueError(f"{duet.name} has no song")
    audio = load_audio(duet.song, recipe)
    factor = warp_factor(len(duet), warp)
    if factor != 1.0:
        audio = stretch.stretch_by(audio, factor)
    samples = warped_length(len(duet), warp) * recipe.hop
    return np.pad(audio[:samples], (0, max(0, samples - len(audio))))


def list_songs(folder: Path | str) -> tuple[list[Path], list[Path]]:
    """Songs of a folder for training and for held-out duets: every fourth by name is held out.

    Raises FileNotFoundError when the folder has no songs.
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


def _source_code() -> bytes:
    """Source text of the modules that make the music: part of a cache key, so that a change renews the cache."""
    modules = (augment, features_module, stretch, synth, tempo_module)
    files = (__file__, *(str(module.__file__) for module in modules))
    return "\n".join(Path(file).read_text() for file in files).encode()


def _cached(path: Path | None, make: Callable[[], np.ndarray]) -> np.ndarray:
    """The array in a file, which is made and written first where it is missing; without a path just made."""
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
    library: SongLibrary,
    seed: Sequence[int],
    recipe: AudioRecipe,
) -> np.ndarray:
    """Music features (warped_length, F) of a duet. tempo: None for its own song."""
    if tempo is None:
        audio = own_music(duet, variant.warp, recipe)
    else:
        source = library if variant.source == "song" and library.paths else None
        own_seed = (*seed, variant.seed, int(variant.source == "song"), round(variant.warp * 1000))
        audio = paired_music(len(duet), tempo, variant.warp, source, own_seed, recipe)
    # Centred frames of a signal of n hops are n + 1, one more than the dance has.
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

    Training duets get all variants, with the tempo of both dancers. Held-out duets get those without a warp, with the
    tempo of the leader alone and songs that no training duet has. A duet with a song of its own gets it in every
    variant. songs_dir: None for synthesised music alone. cache_dir: keeps features between runs, by a hash of all that
    they depend on.
    """
    recipe = recipe or AudioRecipe()
    training_songs, held_out = list_songs(songs_dir) if songs_dir else ([], [])
    code = _source_code()
    bank: MusicBank = {}
    for duets, songs, leader_only in (
        (split.train, training_songs, False),
        (split.val + split.test, held_out, True),
    ):
        library = SongLibrary(songs, recipe)
        library_bytes = _digest(*(path.read_bytes() for path in songs)).encode()
        for number, duet in enumerate(duets):
            tempo = None if duet.song else duet_tempo(duet, leader_only)
            material = duet.song.read_bytes() if duet.song else library_bytes
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
                    partial(_features, duet, tempo, variant, library, inputs["seed"], recipe),
                )
    return bank
