"""The training programs, for a few steps on made duets: running, resuming, strict loading, no use of held-out duets."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from tests.python.support.duets import made_duet
from tests.python.support.small_training import DENOISER, HFSQ, stage1, stage2, write_duets
from training import generate, train_denoiser, train_hfsq
from training.checkpoint import (
    MEASURED,
    load_denoiser,
    load_hfsq,
    load_model,
    read_card,
    read_config,
    solos_seen,
)
from training.checkpoints import average
from training.config import (
    STREAMS,
    DenoiserConfig,
    DenoiserLossConfig,
    DiffusionConfig,
    HfsqConfig,
    from_json,
    to_json,
    write_json,
)
from training.data.made import made_dancer
from training.data.sources import read_split
from training.denoiser.clips import Augmentation
from training.diffusion.react import Request, at_height, react
from training.evaluation import no_latent_baseline
from training.hfsq.reconstruct import reconstruct
from training.loop.run import fast_precision
from training.motion.floor import put_on_floor
from training.motion.other_body import in_body
from training.motion.skeleton import body_height
from training.stage2 import solo_clips


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_duets(tmp_path_factory.mktemp("data"))


@pytest.fixture(scope="module")
def trained(data: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("run")
    train_hfsq.main(stage1(data, out))
    train_denoiser.main(stage2(data, out))
    return out


def test_both_stages_leave_a_checkpoint_a_log_and_curves(trained: Path) -> None:
    hfsq, frame = load_hfsq(trained)
    denoiser, diffusion = load_denoiser(trained, hfsq)
    assert diffusion.steps == 2
    assert frame.sigma == 15
    assert not any(p.requires_grad for p in hfsq.parameters())
    assert (hfsq.latent_std != 1).all(), "the latents' statistics are measured and stored"
    assert all(stream.std != 1 for stream in hfsq.each), "and those of the streams"
    assert (denoiser.condition.leader.std != 1).any()
    for stage in ("hfsq", "denoiser"):
        assert (trained / stage / "curves.png").stat().st_size > 1000
        rows = [json.loads(line) for line in (trained / stage / "log.jsonl").read_text().splitlines()]
        assert any("val/mpjpe_mm" in row or "val/all/mpjpe_mm" in row for row in rows)
        assert list((trained / stage).glob("events.out.tfevents*")), "TensorBoard"


def test_a_checkpoint_says_how_it_reconstructs_the_validation_duets(data: Path, trained: Path) -> None:
    hfsq, frame = load_hfsq(trained)
    duets = read_split(data, ("made_1",), ("made_2",))
    stated = read_config(trained, "hfsq")["provenance"]["validation"]
    rows = [json.loads(line) for line in (trained / "hfsq" / "log.jsonl").read_text().splitlines()]
    logged = [row for row in rows if "val/all/mpjpe_mm" in row]
    assert len(logged) == 1, "once at its end, where an evaluation is due too"
    for name, value in train_hfsq.evaluate(hfsq, duets.val, frame).items():
        assert stated[name] == pytest.approx(value, rel=1e-2)  # weights are kept in half precision
        assert logged[0][name] == stated[name]
    assert stated["val/all/mpjpe_mm"] != pytest.approx(
        train_hfsq.evaluate(hfsq, duets.test, frame)["val/all/mpjpe_mm"], rel=1e-2
    )


def test_a_dance_is_generated_as_asked(data: Path, trained: Path, tmp_path: Path) -> None:
    given = generate.Options(
        checkpoint=trained, leader=data, duet="made_2", out=tmp_path, seeds=(1, 2), coarse=0.5, variety=0.0
    )
    generate.main(given)
    leader = np.load(tmp_path / "leader.npy")
    for seed in given.seeds:
        request = Request(
            leader,
            None,
            seed,
            guidance=(0.5, load_model(trained).diffusion.guidance[1]),
            variety=0.0,
            condition_leader=in_body(leader, read_card(trained)["training_bodies"]["leader"]),
        )
        reactor = np.load(tmp_path / f"reactor_{seed}.npy")
        assert reactor == pytest.approx(react(load_model(trained), request), abs=1e-6)
        assert (tmp_path / f"reactor_{seed}.png").stat().st_size > 1000


def test_the_leader_of_an_earlier_dance_is_read(tmp_path: Path) -> None:
    motion = put_on_floor(made_dancer(40, 1))
    np.save(tmp_path / "leader.npy", motion)
    options = generate.Options(checkpoint=tmp_path, leader=tmp_path / "leader.npy", out=tmp_path)
    np.testing.assert_allclose(generate.read_leader(options), motion, atol=1e-6)


def test_precision_follows_the_machine(data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    train_hfsq.main(stage1(data, tmp_path, steps=1, precision=None))
    options = json.loads((tmp_path / "hfsq.json").read_text())["provenance"]["options"]
    assert options["precision"] == fast_precision(), "the checkpoint says what was used"
    monkeypatch.setattr(torch.accelerator, "is_available", lambda: False)
    for tiles, precision in ((True, "bf16-mixed"), (False, "32-true")):
        monkeypatch.setattr(torch.cpu, "_is_amx_tile_supported", lambda tiles=tiles: tiles)
        assert fast_precision() == precision


def test_a_denoiser_does_not_go_with_a_stage_1_that_was_trained_again(
    data: Path, trained: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "run"
    shutil.copytree(trained, folder)
    train_hfsq.main(stage1(data, folder, seed=1))
    with pytest.raises(ValueError, match=r"denoiser\.safetensors was trained on another stage 1"):
        load_model(folder)
    with pytest.raises(ValueError, match=r"state\.ckpt: it is of another stage 1"):
        train_denoiser.main(stage2(data, folder, resume=True, steps=4))
    for name in ("hfsq.json", "hfsq.safetensors"):
        shutil.copy(trained / name, folder)
    train_hfsq.main(stage1(data, folder, init=folder, decoders=STREAMS, seed=1))
    load_model(folder)


def test_another_number_of_layers_than_that_of_stage_1_is_refused_before_data_are_read(trained: Path) -> None:
    loss = DenoiserLossConfig(windows=2, layers=(1.0, 0.5, 0.25))
    with pytest.raises(ValueError, match="the 2 residual layers of stage 1 need 2 depths"):
        train_denoiser.main(
            stage2(Path("nowhere"), trained, denoiser=replace(DENOISER, depths=(1, 1, 1)), loss=loss)
        )


def test_a_training_with_all_duets_held_out_says_so(data: Path, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"nothing is left of .* add --learn-all"):
        train_hfsq.main(stage1(data, tmp_path, val=("made_0", "made_1")))


def test_weights_that_do_not_fit_are_refused(trained: Path, tmp_path: Path) -> None:
    for name in ("hfsq.json", "hfsq.safetensors"):
        (tmp_path / name).write_bytes((trained / name).read_bytes())
    config = json.loads((tmp_path / "hfsq.json").read_text())
    config["hfsq"]["depth"] = 2
    (tmp_path / "hfsq.json").write_text(json.dumps(config))
    with pytest.raises(
        ValueError,
        match=r"another network than was asked for: .* tensors differ, of which .* is missing there",
    ):
        load_hfsq(tmp_path)
    with pytest.raises(FileNotFoundError, match="train it first"):
        load_hfsq(tmp_path / "nowhere")


def test_training_starts_from_another_checkpoint(data: Path, trained: Path, tmp_path: Path) -> None:
    """The decoders asked for learn and latents stay, so that the first checkpoint's denoiser fits and learns too."""
    # On another duet, whose statistics are others.
    train_hfsq.main(stage1(data, tmp_path, init=trained, decoders=("upper", "lower"), val=("made_0",)))
    before, after = load_hfsq(trained)[0].state_dict(), load_hfsq(tmp_path)[0].state_dict()
    changed = {name for name in before if not torch.equal(before[name], after[name])}
    learnt = {str(STREAMS.index(name)) for name in ("upper", "lower")}
    assert {tuple(name.split(".")[:3]) for name in changed} == {("streams", i, "decoder") for i in learnt}
    train_denoiser.main(stage2(data, tmp_path, init=trained, learning_rate=0.0))
    same, _ = load_denoiser(tmp_path, load_hfsq(tmp_path)[0])
    first, _ = load_denoiser(trained, load_hfsq(trained)[0])
    for (name, a), b in zip(first.state_dict().items(), same.state_dict().values(), strict=True):
        assert torch.allclose(a, b, atol=2e-3), name
    with pytest.raises(ValueError, match="safetensors"):
        train_hfsq.main(stage1(data, tmp_path / "x", init=trained, hfsq=replace(HFSQ, depth=2)))


def test_pairs_made_from_solo_dances_join_stage_2(data: Path, trained: Path, tmp_path: Path) -> None:
    for run in ("solos", "without", "next"):
        (tmp_path / run).mkdir()
        for name in ("hfsq.json", "hfsq.safetensors"):
            (tmp_path / run / name).write_bytes((trained / name).read_bytes())
    np.savez(tmp_path / "solo.npz", indian_1=made_dancer(300, 1), martial_1=made_dancer(300, 2))
    options = stage2(
        data, tmp_path / "solos", init=trained, solo=tmp_path / "solo.npz", solo_prefixes=("indian",)
    )
    clips = solo_clips(options, DENOISER.condition, *load_hfsq(trained))
    assert len(clips) == 2, "one dancer and its mirror image: those of other names are left out"
    train_denoiser.main(options)
    train_denoiser.main(stage2(data, tmp_path / "without", init=trained))
    train_denoiser.main(stage2(data, tmp_path / "next", init=tmp_path / "solos"))
    assert solos_seen(tmp_path / "next") == ("indian",), "by the training that this one goes on from"
    assert solos_seen(tmp_path / "without") == ()
    hfsq, _ = load_hfsq(trained)
    with_solos, without = (load_denoiser(tmp_path / run, hfsq)[0] for run in ("solos", "without"))
    # Statistics stay those of the duets; weights learn from other windows.
    assert torch.equal(with_solos.condition.leader.mean, without.condition.leader.mean)
    assert any(
        not torch.equal(a, b) for a, b in zip(with_solos.parameters(), without.parameters(), strict=True)
    )


def test_tuned_models_are_averaged(data: Path, trained: Path, tmp_path: Path) -> None:
    for name in ("hfsq.json", "hfsq.safetensors"):
        for run in ("other", "stranger"):
            (tmp_path / run).mkdir(exist_ok=True)
            (tmp_path / run / name).write_bytes((trained / name).read_bytes())
    train_denoiser.main(stage2(data, tmp_path / "other", init=trained, learning_rate=0.1, seed=1))
    (tmp_path / "mean").mkdir()
    (tmp_path / "mean" / "card.json").write_text('{"name": "filled in"}')
    average.main(average.Options((trained, tmp_path / "other"), tmp_path / "mean"))
    measured = {name: read_card(trained)[name] for name in MEASURED}
    assert read_card(tmp_path / "mean") == {"name": "filled in"} | measured
    hfsq, _ = load_hfsq(tmp_path / "mean")
    a, b, mean = (
        load_denoiser(run, hfsq)[0].state_dict() for run in (trained, tmp_path / "other", tmp_path / "mean")
    )
    assert any(not torch.equal(a[name], b[name]) for name in a)
    for name in a:
        assert torch.allclose(mean[name], (a[name] + b[name]) / 2, atol=1e-3), name
    provenance = json.loads((tmp_path / "mean" / "denoiser.json").read_text())["provenance"]
    assert [c["options"]["seed"] for c in provenance["checkpoints"]] == ["0", "1"]
    with pytest.raises(ValueError, match="two checkpoints"):
        average.main(average.Options((trained,), tmp_path / "x"))
    config = read_config(trained, "denoiser")
    write_json(
        tmp_path / "stranger" / "denoiser.json", config | {"denoiser": config["denoiser"] | {"block": 5}}
    )
    with pytest.raises(ValueError, match="another model"):
        average.main(average.Options((trained, tmp_path / "stranger"), tmp_path / "x"))
    (tmp_path / "stranger" / "denoiser.json").write_bytes((trained / "denoiser.json").read_bytes())
    with (tmp_path / "stranger" / "hfsq.safetensors").open("ab") as file:
        file.write(b" ")
    with pytest.raises(ValueError, match="another stage 1"):
        average.main(average.Options((trained, tmp_path / "stranger"), tmp_path / "x"))


def test_a_training_at_other_tempos_alone_is_validated_at_its_own(
    data: Path, trained: Path, tmp_path: Path
) -> None:
    for name in ("hfsq.json", "hfsq.safetensors"):
        (tmp_path / name).write_bytes((trained / name).read_bytes())
    train_denoiser.main(stage2(data, tmp_path, augmentation=Augmentation(tempos=(0.9,), copies=1)))
    validation = json.loads((tmp_path / "denoiser.json").read_text())["provenance"]["validation"]
    assert validation["val/mpjpe_mm"] > 0


def test_the_no_latent_baseline_is_lossless_and_trains(data: Path, tmp_path: Path) -> None:
    no_latent_baseline.main(
        no_latent_baseline.Options(data=data, out=tmp_path, val=("made_1",), test=("made_2",))
    )
    hfsq, frame = load_hfsq(tmp_path)
    duet = made_duet(200, 1)
    made = reconstruct(hfsq, duet, frame)
    lost = made - duet.reactor
    assert np.abs(lost[..., [0, 2]]).max() < 2e-3, "bones of the made dancers are constant but for rounding"
    assert np.abs(lost - lost[:, :1]).max() < 2e-3, "as a whole they may be lifted out of the floor"
    one_layer = replace(DENOISER, depths=(1,))
    loss = DenoiserLossConfig(layers=(1.0,), windows=2)
    train_denoiser.main(
        stage2(data, tmp_path, denoiser=one_layer, loss=loss, diffusion=DiffusionConfig(steps=2))
    )
    assert load_model(tmp_path).denoiser.layers == 1


def test_the_stride_of_training_windows_is_handed_on(data: Path, trained: Path) -> None:
    with pytest.raises(ValueError, match="stride of 6 frames"):
        train_denoiser.main(stage2(data, trained, stride=6))


def test_stage_1_is_frozen_in_stage_2(data: Path, trained: Path) -> None:
    hfsq, _ = load_hfsq(trained)
    denoiser, diffusion = load_denoiser(trained, hfsq)
    stage = train_denoiser.Stage2(
        denoiser, hfsq.requires_grad_(True).train(), diffusion, DenoiserLossConfig()
    )
    assert not any(p.requires_grad for p in stage.hfsq.parameters())
    assert not stage.hfsq.training
    trainable = {id(p) for p in stage.parameters() if p.requires_grad}
    assert trainable == {id(p) for p in denoiser.parameters() if p.requires_grad}


def test_statistics_and_weights_come_from_training_duets_alone(
    data: Path, trained: Path, tmp_path: Path
) -> None:
    """Changing the test and validation dances must not change a single weight."""
    with np.load(data) as archive:
        arrays = {name: archive[name].copy() for name in archive.files}
    for name in ("made_1", "made_2"):
        duet = made_duet(300, 99)
        arrays |= {f"{name}/leader": duet.leader, f"{name}/follower": duet.reactor}
    other = tmp_path / "other.npz"
    np.savez(other, **arrays)
    train_hfsq.main(stage1(other, tmp_path))
    train_denoiser.main(stage2(other, tmp_path))
    for name in ("hfsq", "denoiser"):
        assert (tmp_path / f"{name}.safetensors").read_bytes() == (
            trained / f"{name}.safetensors"
        ).read_bytes()


@pytest.fixture(scope="module")
def everything(data: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Trained on all three duets."""
    out = tmp_path_factory.mktemp("everything")
    train_hfsq.main(stage1(data, out, learn_all=True))
    train_denoiser.main(stage2(data, out, learn_all=True))
    return out


def test_a_card_has_the_mean_heights_and_the_farthest_leader_of_the_training(
    data: Path, everything: Path
) -> None:
    model, card = load_model(everything), read_card(everything)
    split = read_split(data, ("made_1",), ("made_2",))
    duets = split.train + split.val + split.test
    for name, role in (("reference_height", "leader"), ("reactor_height", "reactor")):
        heights = [body_height(getattr(duet, role)) for duet in duets]
        assert card[name] == pytest.approx(np.mean(heights), abs=1e-4)
    leaders = [at_height(duet.leader, card["reference_height"]) for duet in duets]
    known = [float(model.unfamiliarity(leader).mean()) for leader in leaders]
    assert card["unfamiliar_from"] == pytest.approx(1.15 * max(known), abs=0.01)
    assert max(known) > 1.02 * min(known)


def test_all_duets_are_learnt_where_asked(data: Path, everything: Path, tmp_path: Path) -> None:
    """The same weights as of a training in which no duet but the held-out ones' copies is held out."""
    with np.load(data) as archive:
        arrays = {name: archive[name] for name in archive.files}
    for role in ("leader", "follower"):
        arrays |= {f"held_{i}/{role}": arrays[f"made_{i}/{role}"] for i in (1, 2)}
    copied = tmp_path / "copied.npz"
    np.savez(copied, **arrays)
    copies = tmp_path / "copies"
    train_hfsq.main(stage1(copied, copies, val=("held_1",), test=("held_2",)))
    train_denoiser.main(stage2(copied, copies, val=("held_1",), test=("held_2",)))
    for name in ("hfsq", "denoiser"):
        learnt, expected = ((out / f"{name}.safetensors").read_bytes() for out in (everything, copies))
        assert learnt == expected
        provenance = json.loads((everything / f"{name}.json").read_text())["provenance"]
        assert provenance["options"]["learn_all"] == "True"
        assert not any("mpjpe" in key for key in provenance["validation"]), "nothing is left to measure"


def test_processes_that_would_not_know_of_each_other_are_refused(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("WORLD_SIZE", "2")  # as torchrun sets it
    with pytest.raises(ValueError, match="give --devices 2"):
        train_hfsq.main(stage1(data, tmp_path))


def test_a_denoiser_goes_on_without_any_music(data: Path, trained: Path, tmp_path: Path) -> None:
    for name in ("hfsq.json", "hfsq.safetensors"):
        (tmp_path / name).write_bytes((trained / name).read_bytes())
    train_denoiser.main(stage2(data, tmp_path, init=trained, synths=0))
    validation = json.loads((tmp_path / "denoiser.json").read_text())["provenance"]["validation"]
    assert validation["val/mpjpe_mm"] > 0


def test_two_processes_train_together(data: Path, tmp_path: Path) -> None:
    """The same program under torchrun: two CPU processes, two steps, one checkpoint."""
    script = tmp_path / "two.py"
    script.write_text(
        "from pathlib import Path\n"
        "from tests.python.support.small_training import stage1, stage2\n"
        "from training import train_denoiser, train_hfsq\n"
        f"data, out = Path({str(data)!r}), Path({str(tmp_path)!r})\n"
        "train_hfsq.main(stage1(data, out, devices=2))\n"
        "train_denoiser.main(stage2(data, out, devices=2))\n"
    )
    root = Path(__file__).parents[2]
    command = [
        sys.executable,
        "-m",
        "torch.distributed.run",
        "--standalone",
        "--nproc-per-node=2",
        str(script),
    ]
    done = subprocess.run(
        command, cwd=root, env={**os.environ, "PYTHONPATH": str(root), "OMP_NUM_THREADS": "1"},
        capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    hfsq, _ = load_hfsq(tmp_path)
    load_denoiser(tmp_path, hfsq)
    rows = (tmp_path / "denoiser" / "log.jsonl").read_text().splitlines()
    assert [json.loads(r)["step"] for r in rows].count(1) == 1, "one process writes the log"


def test_configs_survive_json_and_refuse_unknown_keys() -> None:
    for config in (HfsqConfig(), replace(HfsqConfig(), masking=None), DenoiserConfig(), DiffusionConfig()):
        assert from_json(type(config), json.loads(json.dumps(to_json(config)))) == config
    with pytest.raises(ValueError, match=r"unknown keys \['widht'\]"):
        from_json(DiffusionConfig, to_json(DiffusionConfig()) | {"widht": 3})
    with pytest.raises(ValueError, match=r"missing keys \['steps'\]"):
        values = to_json(DiffusionConfig())
        del values["steps"]
        from_json(DiffusionConfig, values)
