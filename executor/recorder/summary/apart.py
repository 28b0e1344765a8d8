"""Reads a recording in a child with limits, so that a hostile one harms nothing but itself.

    python -m executor.recorder.summary file NAME         the recording is the standard input
    python -m executor.recorder.summary newest FOLDER OUT joins the last run of a session's folder first

The child writes one line of JSON: the `Facts`, with bytes as Base64, and `run`, the name of the joined run;
or `code`, `message` and `place` of an error.
"""

from __future__ import annotations

import base64
import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor.recorder.joining import join_run
from executor.recorder.reader import RecordingError
from executor.recorder.shelf import files_of
from executor.recorder.summary.facts import facts_of
from executor.supervision.confine import confine_reader

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["main"]

MEMORY_BYTES: Final = 256 << 20
SECONDS: Final = 60
MOST_WRITTEN_BYTES: Final = 2 << 30


def main(arguments: Sequence[str]) -> int:
    """Is the child; returns the exit status."""
    confine_reader(MEMORY_BYTES, SECONDS, MOST_WRITTEN_BYTES)
    try:
        told = _told(*arguments)
    except RecordingError as error:
        told = {"code": "damaged", "message": error.message, "place": error.offset}
    except OSError as error:
        told = {"code": "damaged", "message": error.strerror or str(error), "place": 0}
    except MemoryError:
        return 1  # the parent says why
    sys.stdout.write(json.dumps(told))
    return 0


def _told(what: str, *arguments: str) -> dict[str, Any]:
    if what == "file":
        (name,) = arguments
        with os.fdopen(os.dup(0), "rb") as file:
            return _facts(file, name)
    folder, out = Path(arguments[0]), Path(arguments[1])
    runs = [path for path in folder.iterdir() if files_of(folder, path.name)]
    for run in sorted(runs, key=lambda path: path.stat().st_mtime_ns, reverse=True):
        if not join_run(folder, run.name, out):
            continue
        with out.open("rb") as file:
            told = _facts(file, run.name)
        if told["ticks"]:  # a world that was only reset is no run
            return told | {"run": run.name}
    return {"code": "not_recorded", "message": "no run was recorded", "place": 0}


def _facts(file: Any, name: str) -> dict[str, Any]:
    found = vars(facts_of(file, name))
    coded = {key: base64.b64encode(found[key]).decode() for key in ("picture", "xml")}
    return found | coded
