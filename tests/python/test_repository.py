"""What must be true of the files that are committed, whoever commits them."""

import hashlib
import json
import re
import subprocess
from collections import Counter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SHARED_DATA = ROOT.parent / "shared" / "data"
LARGEST = 20 * 2**20
"""Bytes; larger files slow every clone."""
MOST_FILES = 16


@pytest.fixture(scope="module")
def tracked() -> list[Path]:
    names = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True
    ).stdout
    return [ROOT / name for name in names.split("\0") if name and (ROOT / name).is_file()]


def digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def test_no_file_is_too_large(tracked: list[Path]) -> None:
    too_large = [str(path.relative_to(ROOT)) for path in tracked if path.stat().st_size > LARGEST]
    assert too_large == []


def test_no_file_is_a_copy_of_data_that_is_not_ours(tracked: list[Path]) -> None:
    if not SHARED_DATA.is_dir():
        pytest.skip("real data not present")
    foreign = [path for path in SHARED_DATA.rglob("*") if path.is_file() and path.stat().st_size > 0]
    sizes = {path.stat().st_size for path in foreign}
    suspects = {digest(path): path for path in tracked if path.stat().st_size in sizes}
    copies = [str(suspects[hash_]) for path in foreign if (hash_ := digest(path)) in suspects]
    assert copies == []


@pytest.mark.parametrize(
    ("document", "folders"),
    [
        ("THIRD_PARTY.md", ("web/public", "docs", "training/checkpoints")),
        ("tests/fixtures/README.md", ("tests/fixtures",)),
    ],
)
def test_origin_of_every_file_that_is_no_text_is_stated(
    tracked: list[Path], document: str, folders: tuple[str, ...]
) -> None:
    """A document names the file or a folder that it lies in, in backticks, from the root or from its own folder."""
    named = {
        base / name
        for name in re.findall(r"`([^`\s]+)`", (ROOT / document).read_text())
        for base in (ROOT, (ROOT / document).parent)
    }
    # A folder says nothing of all that could come to lie in it.
    named -= {ROOT / folder for folder in ("web/public", "docs", "training", "tests/fixtures")}
    files = [
        path
        for path in tracked
        if path.suffix != ".md" and any(path.is_relative_to(ROOT / folder) for folder in folders)
    ]
    assert len(files) > 10
    assert [str(path.relative_to(ROOT)) for path in files if named.isdisjoint((path, *path.parents))] == []


def test_lock_files_hold_no_download_addresses() -> None:
    packages = json.loads((ROOT / "package-lock.json").read_text())["packages"]
    assert len(packages) > 100
    assert [name for name, package in packages.items() if "resolved" in package] == []
    pins = [
        line for line in (ROOT / "constraints.txt").read_text().splitlines() if line and line[0] not in "# "
    ]
    assert len(pins) > 50
    assert [pin for pin in pins if "==" not in pin or "://" in pin] == []


def test_no_folder_of_sources_is_overfull(tracked: list[Path]) -> None:
    """So that the tree can be read."""
    sources = [
        path
        for path in tracked
        if path.relative_to(ROOT).parts[0] in ("web", "training", "export", "tests", "tools")
    ]
    count = Counter(path.relative_to(ROOT).parent for path in sources)
    assert {str(folder): files for folder, files in count.items() if files > MOST_FILES} == {}


def test_node_packages_are_pinned_exactly() -> None:
    package = json.loads((ROOT / "package.json").read_text())
    versions = {**package["dependencies"], **package["devDependencies"]}
    assert [name for name, version in versions.items() if not version[0].isdigit() or " " in version] == []
