"""Errors of readers name the file."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Turns every error of a damaged file into a ValueError whose message begins with the file's name.

    Errors of a file that is missing, a folder or not to be read stay what they are. All others are taken, since numpy,
    zipfile, tokenize and safetensors raise over a dozen kinds for wrong content; the first one stays as the cause.
    """
    try:
        yield
    except (FileNotFoundError, IsADirectoryError, PermissionError):
        raise
    except ValueError as error:
        raise ValueError(f"{path}: {str(error).removeprefix(f'{path}: ')}") from error
    except Exception as error:
        raise ValueError(f"{path}: the file is damaged ({type(error).__name__}: {error})") from error
