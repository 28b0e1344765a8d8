"""Joins the segments of a run into one file: `python -m executor.recorder.joining FOLDER RUN OUT`.

`last` as RUN is the one that was recorded last.

It is a process of its own, so that a long run does not make the manager wait.
"""

from __future__ import annotations

import contextlib
import errno
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

from executor.recorder.reader import RecordingError
from executor.recorder.recover import join
from executor.recorder.shelf import files_of, parts_of
from executor.supervision.confine import die_with_parent

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["NOT_RECORDED", "NO_ROOM", "join_newest", "join_run", "main"]

NOT_RECORDED = 3
NO_ROOM = 4
LAST = "last"
ATTEMPTS = 4
PAUSE_S = 0.25


def join_run(folder: Path, run: str, out: Path) -> int:
    """Writes a run into one file; returns the number of its messages, 0 if there is no such run.

    Raises:
        RecordingError: a segment is damaged.
        OSError: the file cannot be written.
    """
    # The file of a segment that has just begun is empty until the recorder first flushes it.
    files = [path for path in files_of(folder, run) if path.is_file() and not path.is_symlink()]
    files = [path for path in files if path.stat().st_size]
    if not files:
        return 0
    with contextlib.ExitStack() as stack:
        sources = [(stack.enter_context(path.open("rb")), path.name) for path in files]
        return join(sources, stack.enter_context(out.open("wb")), parts=parts_of(folder, run))


def join_newest(folder: Path, out: Path) -> int:
    """Writes the run that was recorded last into one file; returns the number of its messages, 0 without one.

    Raises:
        RecordingError: a segment is damaged.
        OSError: the folder cannot be read, or the file cannot be written.
    """
    runs = [path for path in folder.iterdir() if files_of(folder, path.name)]
    if not runs:
        return 0
    return join_run(folder, max(runs, key=lambda path: path.stat().st_mtime_ns).name, out)


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns the exit status.

    The recorder writes, renames and removes files at the same time, so a failed attempt is repeated.
    """
    folder, run, out = arguments if arguments is not None else sys.argv[1:]
    die_with_parent()
    for left in reversed(range(ATTEMPTS)):
        try:
            return 0 if _join(Path(folder), run, Path(out)) else NOT_RECORDED
        except (OSError, RecordingError) as error:
            if isinstance(error, OSError) and error.errno == errno.ENOSPC:
                return NO_ROOM
            if not left:
                sys.stderr.write(f"{error}\n")
            else:
                time.sleep(PAUSE_S)
    return 1


def _join(folder: Path, run: str, out: Path) -> int:
    return join_newest(folder, out) if run == LAST else join_run(folder, run, out)


if __name__ == "__main__":
    sys.exit(main())
