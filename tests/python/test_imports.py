"""Which folder may import which."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROGRAMS = {"training.train_hfsq", "training.train_denoiser", "training.distill", "training.generate"}
# What each folder of training/ may import beside itself, `training.config` and `training.command_line`.
ALLOWED = {
    "motion": set(),
    "music": set(),
    "data": {"motion", "music"},
    "hfsq": {"motion", "data"},
    "denoiser": {"motion", "music", "data", "hfsq"},
    "diffusion": {"motion", "music", "hfsq", "denoiser"},
    "evaluation": {"motion", "music", "data", "hfsq", "checkpoint"},
    "checkpoints": {"checkpoint"},
    "loop": {"data", "denoiser"},
    "baselines": {"motion", "music", "data", "hfsq", "denoiser", "diffusion", "checkpoint", "loop"},
    "experiments": {"data", "hfsq", "diffusion", "evaluation", "baselines", "checkpoint"},
}


def imports(path: Path) -> Iterator[str]:
    """Modules of the project that a file imports, with the names taken from them."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield from (f"{node.module}.{name.name}" for name in node.names)


@pytest.mark.parametrize(
    "folder", sorted(path.name for path in (ROOT / "training").iterdir() if path.is_dir())
)
def test_a_folder_imports_only_what_lies_below_it(folder: str) -> None:
    if folder == "__pycache__":
        return
    found = {
        (str(path.relative_to(ROOT)), name)
        for path in (ROOT / "training" / folder).rglob("*.py")
        for name in imports(path)
        if name.startswith(("training.", "export."))
    }
    allowed = ALLOWED[folder] | {folder, "config", "command_line"}
    assert sorted((path, name) for path, name in found if name.split(".")[1] not in allowed) == []


def test_nothing_imports_a_program_that_trains_distils_or_generates() -> None:
    files = [*(ROOT / "training").rglob("*.py"), *(ROOT / "export").glob("*.py")]
    found = [
        (path.name, name)
        for path in files
        for name in imports(path)
        if ".".join(name.split(".")[:2]) in PROGRAMS
    ]
    assert found == []


def test_imports_have_no_cycles() -> None:
    files = [*(ROOT / "training").rglob("*.py"), *(ROOT / "export").glob("*.py")]
    modules = {".".join(path.relative_to(ROOT).with_suffix("").parts): path for path in files}
    graph = {
        module: {name if name in modules else name.rpartition(".")[0] for name in imports(path)}
        & set(modules)
        for module, path in modules.items()
    }
    done: set[str] = set()

    def visit(module: str, chain: tuple[str, ...]) -> None:
        assert module not in chain, " imports ".join((*chain, module))
        if module not in done:
            for name in sorted(graph[module]):
                visit(name, (*chain, module))
            done.add(module)

    for module in sorted(graph):
        visit(module, ())
