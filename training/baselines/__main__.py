"""Train a baseline of the paper's Table 1 on the latents of a stage 1, in its own folder.

    python -m training.evaluation.no_latent_baseline --data my-duets --val duo_3 --test duo_5 --out runs/edge
    python -m training.baselines --method edge       --data my-duets --val duo_3 --test duo_5 --out runs/edge

edge, intergen and tcdiff work on joint positions, which `no_latent_baseline` prepares; duolando and gesturelsm on the
codes of `training.train_hfsq --hfsq.quantiser rvq`, duolando with one layer and one group.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np
import torch
from torch import Tensor, nn

from training.baselines.method import BaselineConfig, Known, Method, Name, Window
from training.baselines.trained import make_method
from training.checkpoint import load_hfsq, save_weights, weights_digest
from training.command_line import run_program
from training.config import STRIDE, ConditionConfig
from training.data.music_pairing import build_music_bank, variants
from training.denoiser.clips import augmented_clips, feature_values
from training.denoiser.losses import decoded_windows
from training.denoiser.windows import Batch, Windows
from training.hfsq.autoencoder import Autoencoder
from training.loop.options import WindowOptions, read_duets_to_train
from training.loop.run import Run, launch
from training.motion.skeleton import body_height


@dataclass(frozen=True, kw_only=True)
class Options(WindowOptions):
    """out: with stage 1's checkpoint in it."""

    method: Name
    width: int = 128
    depth: int = 4
    """Transformer layers of all networks of the method together."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.solo or self.init:
            raise ValueError(
                "baselines learn from duets alone and from the start: leave --solo and --init out"
            )
        BaselineConfig(self.method, self.width, self.depth)


class Training(nn.Module):
    """A method's loss as a module, so that distributed training sees one forward pass. The HFSQ inside is frozen."""

    def __init__(self, method: Method, hfsq: Autoencoder) -> None:
        super().__init__()
        self.method, self.hfsq = method, hfsq.requires_grad_(False).eval()

    def forward(self, batch: Batch) -> tuple[Tensor, dict[str, Tensor]]:
        block = batch.latents.shape[1]
        memory = self.method.condition(
            batch.features, batch.music, batch.music_valid, batch.role, batch.inside
        )
        margin = (memory.shape[1] - block) // 2
        rows = slice(margin, margin + block)
        known = Known(
            memory[:, rows],
            self.method.leader_tokens(batch.features)[:, rows],
            batch.valid,
        )

        def motion(latents: Tensor, windows: list[int]) -> Tensor:
            return decoded_windows(self.hfsq, latents, batch, windows)

        terms = self.method.loss(known, Window(batch.latents, motion, batch.leader, batch.reactor))
        return torch.stack(list(terms.values())).sum(), {k: v.detach() for k, v in terms.items()}


def main(options: Options) -> None:
    fabric = launch(options)
    fabric.seed_everything(options.seed, verbose=False)
    config = BaselineConfig(options.method, options.width, options.depth)
    duets = read_duets_to_train(options, fabric, STRIDE * config.block)
    hfsq, frame = load_hfsq(options.out)
    wanted = variants(options.augmentation.tempos, options.synths, 0)
    bank = build_music_bank(duets, None, wanted, cache_dir=options.music_cache)
    condition = ConditionConfig()
    clips = augmented_clips(duets.train, bank, hfsq, frame, options.augmentation, condition, options.seed)
    torch.manual_seed(options.seed)
    method = make_method(config, hfsq)
    method.condition.set_statistics(*feature_values(clips))
    margin = method.condition.receptive_field
    windows = Windows(clips, config.block, margin, options.stride, condition)
    optimizer = torch.optim.AdamW(
        method.parameters(), lr=options.learning_rate, weight_decay=options.weight_decay
    )
    stage = Training(method, hfsq)
    begins_with = {"stage 1": weights_digest(hfsq)}
    run = Run(fabric, stage, method, optimizer, options, options.out / "baseline", 200, begins_with)
    height = float(np.mean([body_height(duet.leader) for duet in duets.train]))

    def finish() -> None:
        with run.averaged() as averaged:
            provenance = run.provenance("training.baselines", leave_out=())
            values = {
                "baseline": asdict(config),
                "stage_1": begins_with["stage 1"],
                "reference_height": height,
                "provenance": provenance,
            }
            save_weights(options.out, "baseline", averaged, values)

    run.train(lambda random: windows.batch(options.batch, random), finish, finish)


if __name__ == "__main__":
    run_program(main, Options)
