"""Classifier two-sample test (Lopez-Paz and Oquab 2017): can a small network tell generated couples from true ones?
In tables its accuracy is "told from the truth".

The accuracy on windows that it was not trained on is 0.5 where the two cannot be told apart. It sees both dancers,
so it can use poses, timing and distances. With little data even the truth does not have exactly 0.5 against itself;
that is reported beside it (`truth_against_truth`).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import torch
from torch import nn

from training.motion.heading import heading, turn_in

WINDOW_FRAMES, HOP_FRAMES = 60, 6
SEGMENT_FRAMES = 150  # windows of one segment are held out together, since neighbours are nearly the same
FOLDS = 4
STEPS, BATCH = 120, 64

Couple = tuple[np.ndarray, np.ndarray]


def couple_windows(couples: Sequence[Couple]) -> tuple[np.ndarray, np.ndarray]:
    """Windows of couples (leader, reactor), (N, 60, 264), and the segment that each lies in, (N,) int.

    Positions in metres and their change per frame of both bodies, seen from the leader's place and heading
    in the middle of the window. Raises ValueError if no couple is as long as a segment.
    """
    windows, groups, segments = [], [], 0
    for leader, reactor in couples:
        facing = heading(leader)
        for first in range(0, len(leader) - SEGMENT_FRAMES + 1, SEGMENT_FRAMES):
            for start in range(first, first + SEGMENT_FRAMES - WINDOW_FRAMES + 1, HOP_FRAMES):
                rows, middle = slice(start, start + WINDOW_FRAMES), start + WINDOW_FRAMES // 2
                origin = leader[middle, 0] * np.array([1.0, 0.0, 1.0])
                both = np.concatenate([leader[rows], reactor[rows]], axis=1) - origin
                turn = np.repeat(facing[middle : middle + 1], WINDOW_FRAMES, axis=0).astype(np.float64)
                seen = turn_in(both.astype(np.float64), turn).reshape(WINDOW_FRAMES, -1)
                windows.append(np.concatenate([seen, np.gradient(seen, axis=0)], axis=1))
                groups.append(segments)
            segments += 1
    if not windows:
        raise ValueError(f"no couple has {SEGMENT_FRAMES} frames")
    return np.array(windows, dtype=np.float32), np.array(groups)


def _network(features: int) -> nn.Module:
    return nn.Sequential(
        nn.Conv1d(features, 24, 1),
        nn.Conv1d(24, 24, 5, stride=2),
        nn.GELU(),
        nn.Conv1d(24, 24, 5, stride=2),
        nn.GELU(),
        nn.AdaptiveAvgPool1d(1),
        nn.Flatten(),
        nn.Dropout(0.3),
        nn.Linear(24, 1),
    )


def _balanced(labels: torch.Tensor, random: torch.Generator) -> torch.Tensor:
    """Indices of a batch with as many of one kind as of the other."""
    rows = [torch.nonzero(labels == kind)[:, 0] for kind in (0.0, 1.0)]
    return torch.cat([r[torch.randint(len(r), (BATCH // 2,), generator=random)] for r in rows])


def held_out_accuracy(
    first: np.ndarray, first_groups: np.ndarray, second: np.ndarray, second_groups: np.ndarray, seed: int = 0
) -> float:
    """Mean over folds of the balanced accuracy on windows (N, W, F) of groups (N,) that the network was not
    trained on. NaN if no fold has both kinds on both sides.
    """
    inputs = torch.from_numpy(np.concatenate([first, second])).transpose(1, 2)
    labels = torch.cat([torch.zeros(len(first)), torch.ones(len(second))])
    groups = np.concatenate([first_groups, second_groups])
    names = np.unique(groups)
    fold_of = dict(zip(names, np.random.default_rng(seed).permutation(len(names)) % FOLDS, strict=True))
    folds = torch.tensor([fold_of[g] for g in groups])
    scores = []
    with torch.random.fork_rng():
        torch.manual_seed(seed)
        random = torch.Generator().manual_seed(seed)
        for fold in range(FOLDS):
            known, unknown = folds != fold, folds == fold
            if any(not (labels[part] == kind).any() for part in (known, unknown) for kind in (0.0, 1.0)):
                continue
            mean = inputs[known].mean(dim=(0, 2), keepdim=True)
            std = inputs[known].std(dim=(0, 2), keepdim=True).clamp_min(1e-3)
            network = _network(inputs.shape[1])
            optimizer = torch.optim.AdamW(network.parameters(), lr=2e-3, weight_decay=0.05)
            training, targets = (inputs[known] - mean) / std, labels[known]
            for _ in range(STEPS):
                batch = _balanced(targets, random)
                loss = nn.functional.binary_cross_entropy_with_logits(
                    network(training[batch])[:, 0], targets[batch]
                )
                optimizer.zero_grad()
                loss.backward()
                optimizer.step()
            network.eval()
            with torch.no_grad():
                guess = network((inputs[unknown] - mean) / std)[:, 0] > 0
            right = guess == (labels[unknown] > 0.5)
            kinds = [right[labels[unknown] == kind].float().mean().item() for kind in (0.0, 1.0)]
            scores.append(float(np.mean(kinds)))
    return float(np.mean(scores)) if scores else float("nan")


def two_sample_accuracy(truth: Sequence[Couple], made: Sequence[Couple]) -> float:
    """Accuracy with which generated couples are told from true ones; made[i] dances to the same leader as
    truth[i].

    The same stretch of both is held out together, so the network cannot use that it knows the leader of a
    window. Raises ValueError for different lengths.
    """
    if [len(a) for a, _ in truth] != [len(a) for a, _ in made]:
        raise ValueError("true and generated couples must have the same lengths")
    real, groups = couple_windows(truth)
    fake, _ = couple_windows(made)
    return held_out_accuracy(real, groups, fake, groups)


def truth_against_truth(truth: Sequence[Couple], repeats: int = 3) -> float:
    """The same accuracy between two halves of the true segments, drawn at random and averaged: what 0.5
    looks like. NaN if there are too few segments.
    """
    windows, groups = couple_windows(truth)
    names = np.unique(groups)
    scores = []
    for repeat in range(repeats):
        chosen = np.random.default_rng([0, repeat]).permutation(names)[: len(names) // 2]
        first = np.isin(groups, chosen)
        scores.append(
            held_out_accuracy(windows[first], groups[first], windows[~first], groups[~first], repeat)
        )
    known = [score for score in scores if np.isfinite(score)]
    return float(np.mean(known)) if known else float("nan")
