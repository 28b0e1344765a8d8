"""Keeps the recording of a run in real time: segments beside the file while it lasts, one file at its end."""

from __future__ import annotations

import contextlib
import shutil
import sys
from typing import TYPE_CHECKING, Final

from executor.headless.errors import HeadlessError
from executor.headless.recording import check_name
from executor.recorder.joining import join_newest
from executor.recorder.reader import RecordingError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["PARTS", "recorded_segments"]

PARTS: Final = ".parts"


@contextlib.contextmanager
def recorded_segments(path: Path) -> Iterator[Path]:
    """Gives the folder for the segments of a run; after it ended, writes them into one file.

    A run that was killed leaves the folder `<file>.parts`, from which `bt-studio convert` makes the file.

    Raises:
        HeadlessError: the file cannot be written, its name is not one of a recording, or the folder has what
            a killed run left.
    """
    check_name(path)
    folder = path.with_name(path.name + PARTS)
    try:
        folder.mkdir()
    except FileExistsError as error:
        hint = f"Complete it by `bt-studio convert {folder} -o OTHER.mcap`, or remove it."
        raise HeadlessError(f"{folder}: holds what a killed run recorded. {hint}") from error
    except OSError as error:
        raise HeadlessError(f"{path}: cannot be written: {error.strerror}") from error
    try:
        yield folder
    finally:
        _complete(folder, path)


def _complete(folder: Path, path: Path) -> None:
    """Joins the segments; if that fails they stay, and the run keeps its result."""
    partial = folder / path.name
    try:
        if join_newest(folder, partial):
            partial.replace(path)
        shutil.rmtree(folder)
    except (OSError, RecordingError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        sys.stderr.write(f"{path}: the recording stays in {folder}: {reason}\n")
