"""What was measured where: the head of a report, without which its numbers cannot be repeated."""

from __future__ import annotations

import os
import platform
import subprocess
from pathlib import Path
from typing import Any


def commit() -> str | None:
    """The commit the program runs from, None outside a repository."""
    try:
        out = subprocess.run(["git", "rev-parse", "HEAD"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return out.stdout.strip()


def machine() -> str:
    """The processor as the system names it, the number of its cores, and the system."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    name = names[0] if names else platform.processor() or platform.machine()
    return f"{name}, {os.cpu_count()} cores, {platform.system()}"


def seen_sentences(facts: dict[str, Any]) -> list[str]:
    """A sentence where some of the measured duets were not held out by every training of the checkpoint."""
    if not facts.get("seen"):
        return []
    return [
        f"Not held out: {', '.join(facts['seen'])}. A training of this checkpoint had them, or does not name them with "
        "--val or --test, so what is measured on them says nothing of dances that the model has not seen."
    ]


def conditions(facts: dict[str, Any]) -> list[str]:
    """What was measured where, of a report that knows it."""
    if "split" not in facts:
        return []
    parts = {"train": "training", "val": "validation", "test": "test"}
    split = "; ".join(
        f"{parts[name]}: {', '.join(names) or 'none'}" for name, names in facts["split"].items()
    )
    return [
        f"Data {facts['data']}, {split}. Model {facts['model']} under {facts['runtime']}, commit {facts['commit']}. "
        f"Machine: {facts['machine']}.",
        *(f"**{sentence}**" for sentence in seen_sentences(facts)),
    ]
