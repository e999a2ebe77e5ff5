"""Music features of duets with and without a song, and of held-out duets."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import soundfile

from tests.python.support.real_data import real_duets, real_file
from tests.python.support.salsa import salsa_duet, salsa_steps
from training.config import FPS
from training.data.augment import tempo_warp, warp_factor
from training.data.duet import Duet
from training.data.music_pairing import (
    SongLibrary,
    Variant,
    build_music_bank,
    list_songs,
    paired_music,
    variants,
)
from training.data.splits import Split
from training.data.step_tempo import duet_tempo
from training.music.features import features
from training.music.recipe import AudioRecipe
from training.music.tempo import Tempo

RECIPE = AudioRecipe()
PLAIN = Variant(1.0, "synth", 0)


def beat_phase(rows: np.ndarray, tempo: Tempo) -> complex:
    """Mean position of the beat column's ones on the circle of one beat."""
    found = np.flatnonzero(rows[:, 53]) / FPS
    return complex(np.exp(2j * np.pi * tempo.counts(found)).mean())


def write_song(path: Path, bpm: float, seconds: float = 12.0) -> Path:
    """A made song in a file."""
    frames = int(seconds * 30)
    soundfile.write(path, paired_music(frames, Tempo(bpm, 0.2), 1.0, None, [7], RECIPE), RECIPE.sample_rate)
    return path


@pytest.fixture
def duet() -> Duet:
    return salsa_duet(360, Tempo(165.0, 0.5), name="a")


@pytest.mark.parametrize("warp", [0.9, 1.0])
def test_bank_is_as_long_as_the_warped_dance_and_on_its_beat(duet: Duet, warp: float) -> None:
    variant = Variant(warp, "synth", 1)
    rows = build_music_bank(Split((duet,), (), ()), None, [variant])["a"][variant]
    assert rows.shape == (len(tempo_warp(duet, warp)), 54)
    assert rows.dtype == np.float32
    tempo = duet_tempo(duet, leader_only=False).warped(warp_factor(len(duet), warp))
    phase = beat_phase(rows, tempo)
    assert abs(phase) > 0.85
    assert abs(np.angle(phase)) < 0.2 * 2 * np.pi


def test_held_out_music_does_not_depend_on_the_reactor() -> None:
    duet = salsa_duet(240, Tempo(165.0, 0.5), name="a")
    other = replace(duet, reactor=salsa_steps(240, Tempo(190.0, 1.3), begins=1))
    held_out = [build_music_bank(Split((), (), (d,)), None, [PLAIN])["a"][PLAIN] for d in (duet, other)]
    np.testing.assert_array_equal(held_out[0], held_out[1])
    trained = [build_music_bank(Split((d,), (), ()), None, [PLAIN])["a"][PLAIN] for d in (duet, other)]
    assert not np.array_equal(trained[0], trained[1])


def test_held_out_duets_get_unwarped_music_only(duet: Duet) -> None:
    wanted = variants(warps=(0.95, 1.0), synths=1, songs=0)
    bank = build_music_bank(Split((duet,), (replace(duet, name="b"),), ()), None, wanted)
    assert set(bank["a"]) == {Variant(0.95, "synth", 0), PLAIN}
    assert set(bank["b"]) == {PLAIN}


def test_the_cache_returns_the_same_array_unless_an_input_changes(duet: Duet, tmp_path: Path) -> None:
    split = Split((duet,), (), ())
    first = build_music_bank(split, None, [PLAIN], cache_dir=tmp_path)["a"][PLAIN]
    assert len(list(tmp_path.iterdir())) == 1
    np.testing.assert_array_equal(
        build_music_bank(split, None, [PLAIN], cache_dir=tmp_path)["a"][PLAIN], first
    )
    assert len(list(tmp_path.iterdir())) == 1
    build_music_bank(split, None, [PLAIN], seed=1, cache_dir=tmp_path)
    assert len(list(tmp_path.iterdir())) == 2
    slower = Split((salsa_duet(360, Tempo(150.0, 0.5), name="a"),), (), ())
    again = build_music_bank(slower, None, [PLAIN], cache_dir=tmp_path)["a"][PLAIN]
    assert not np.array_equal(again, first), "at another tempo"
    looser = replace(RECIPE, tightness=50.0)
    build_music_bank(split, None, [PLAIN], cache_dir=tmp_path, recipe=looser)
    assert len(list(tmp_path.iterdir())) == 4


def test_songs_are_put_on_the_beat_and_some_are_held_out(duet: Duet, tmp_path: Path) -> None:
    for name, bpm in (("a", 150.0), ("b", 168.0), ("c", 90.0), ("d", 140.0)):
        write_song(tmp_path / f"{name}.wav", bpm)
    known, held_out = list_songs(tmp_path)
    assert [path.stem for path in known] == ["a", "b", "c"]
    assert [path.stem for path in held_out] == ["d"]
    tempo = Tempo(165.0, 0.5)
    library = SongLibrary(known[:1], RECIPE)
    from_song = paired_music(360, tempo, 1.0, library, [0], RECIPE)
    assert from_song.shape == (360 * 512,)
    assert not np.array_equal(from_song, paired_music(360, tempo, 1.0, None, [0], RECIPE))


def test_held_out_duets_get_songs_that_no_training_duet_has(tmp_path: Path) -> None:
    duet = salsa_duet(180, Tempo(165.0, 0.5), name="a")
    split, variant = (
        Split((duet,), (replace(duet, name="b"),), (replace(duet, name="c"),)),
        Variant(1.0, "song", 0),
    )
    write_song(tmp_path / "4.wav", 150.0, seconds=8.0)
    banks = []
    for slower in (0.0, 8.0):
        for name in ("1", "2", "3"):
            write_song(tmp_path / f"{name}.wav", 168.0 - slower, seconds=8.0)
        banks.append(build_music_bank(split, tmp_path, [variant]))
    before, after = banks
    assert not np.array_equal(before["a"][variant], after["a"][variant])
    for held_out in ("b", "c"):
        assert np.array_equal(before[held_out][variant], after[held_out][variant])


def test_song_of_the_duet_itself_is_used_and_warped(duet: Duet, tmp_path: Path) -> None:
    own = replace(duet, song=write_song(tmp_path / "own.wav", 165.0, seconds=6.0))
    fast = Variant(1.1, "synth", 0)
    bank = build_music_bank(Split((own,), (), ()), None, [PLAIN, fast])["a"]
    assert len(bank[PLAIN]) == 360
    assert len(bank[fast]) == len(tempo_warp(own, 1.1))
    # The dance goes on for six seconds after the song; the features of silence carry no onsets.
    assert bank[PLAIN][:170, 52].max() > 0
    assert bank[PLAIN][190:, 52].max() == 0
    assert bank[fast][180:, 52].max() == 0


def test_a_folder_without_songs_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="no songs"):
        list_songs(tmp_path)


def test_real_song_falls_on_a_real_dance() -> None:
    duet = real_duets()[0]
    songs = sorted(real_file("music").glob("Kevin*.ogg"))
    tempo = duet_tempo(duet, leader_only=True)
    audio = paired_music(600, tempo, 1.0, SongLibrary(songs, RECIPE), [0], RECIPE)
    phase = beat_phase(features(audio, RECIPE), tempo)
    assert abs(phase) > 0.8
    assert abs(np.angle(phase)) < 0.15 * 2 * np.pi
