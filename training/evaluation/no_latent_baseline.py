"""The no-latent baseline: diffusion on joint positions, four frames to a token, without HFSQ.

What a hierarchy of latents is worth is measured against it. There is nothing to learn in its first stage; this
writes the stage-1 checkpoint that `training.train_denoiser` asks for, with the statistics of the training duets.

python -m training.evaluation.no_latent_baseline --data my-duets --val duo_3 --test duo_5 --out runs/plain
python -m training.train_denoiser --data my-duets --val duo_3 --test duo_5 --out runs/plain \\
    --denoiser.depths 6 --loss.layers 1.0
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from training.checkpoint import save_hfsq
from training.command_line import run_program
from training.config import FrameConfig, HfsqConfig
from training.data.sources import read_split
from training.hfsq.autoencoder import Autoencoder
from training.hfsq.statistics import set_input_statistics, set_latent_statistics
from training.hfsq.windows import training_clips

NO_LATENTS = HfsqConfig(quantiser="none", layers=1, scales=(1.0,), masking=None)
# As in stage 1 (`training.train_hfsq`).
TEMPOS = (0.9, 1.0, 1.1)
MIN_FRAMES = 240


@dataclass(frozen=True)
class Options:
    data: Path
    out: Path
    val: tuple[str, ...]
    test: tuple[str, ...] = ()
    """Names of duets that choose a model, and of those that are kept for the end: no statistics are taken of either."""


def main(options: Options) -> None:
    duets = read_split(options.data, options.val, options.test).train
    clips = training_clips(duets, [], TEMPOS, FrameConfig(), cutoff=None, shortest=MIN_FRAMES)
    model = Autoencoder(NO_LATENTS)
    set_input_statistics(model, clips)
    set_latent_statistics(model, clips)
    save_hfsq(options.out, model, FrameConfig(), {"program": "training.evaluation.no_latent_baseline"})


if __name__ == "__main__":
    run_program(main, Options)
