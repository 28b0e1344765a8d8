"""Runs a command and measures all its processes: `meter.py FILE FOLDER COMMAND…`.

It adopts every process that its parent left, so that the processor time of all is counted and none is left
behind. It ends with the process that started it.
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, Final, NoReturn

import psutil

from tests.benchmarks.timing import pss_mb

PR_SET_PDEATHSIG: Final = 1
PR_SET_CHILD_SUBREAPER: Final = 36
LOOK_S: Final = 0.25
BUSY: Final = 0.03
"""The most of its time that it spends on looking at memory."""
GRACE_S: Final = 15.0
ENDING_S: Final = 2.0


class Interrupted(Exception):  # noqa: N818 - it is a request, not an error
    """The one who started it wants it to end."""


def main(arguments: list[str]) -> None:
    """Writes wall time, processor time, peak of memory and what was left, as JSON."""
    path, folder, *command = arguments
    adopt_orphans()
    try:
        result = metered(command, folder)
        Path(path).write_text(json.dumps(result), encoding="utf-8")
    finally:
        end_all()


def adopt_orphans() -> None:
    """Becomes the parent of its descendants' orphans, and gets SIGTERM when its own parent ends."""
    library = ctypes.CDLL(None, use_errno=True)
    for option, value in ((PR_SET_CHILD_SUBREAPER, 1), (PR_SET_PDEATHSIG, signal.SIGTERM)):
        if library.prctl(option, value, 0, 0, 0):
            raise OSError(ctypes.get_errno(), "prctl")
    signal.signal(signal.SIGTERM, _interrupt)
    # What it starts would inherit that SIGINT is ignored, and servers are ended by it.
    signal.signal(signal.SIGINT, signal.default_int_handler)


def _interrupt(*_: Any) -> NoReturn:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    raise Interrupted


def metered(command: list[str], folder: str) -> dict[str, Any]:
    """Runs a command in a folder to its end and measures it with all its descendants."""
    began_s = time.monotonic()
    program = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL)
    peak_mb = 0.0
    try:
        while True:
            looked_s = time.monotonic()
            peak_mb = max(peak_mb, pss_mb(program.pid))
            pause_s = max(LOOK_S, (time.monotonic() - looked_s) / BUSY)
            with contextlib.suppress(subprocess.TimeoutExpired):
                program.wait(pause_s)
                break
    except Interrupted:
        program.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            program.wait(GRACE_S)
    wall_s = time.monotonic() - began_s
    left = end_all()
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return {
        "code": program.returncode,
        "wall_s": wall_s,
        "processor_s": used.ru_utime + used.ru_stime,
        "peak_mb": peak_mb,
        "left": left,
    }


def end_all() -> list[str]:
    """Ends and reaps every descendant that does not end by itself; returns their names."""
    left = []
    _, alive = psutil.wait_procs(psutil.Process().children(recursive=True), timeout=ENDING_S)
    while alive:
        for child in alive:
            with contextlib.suppress(psutil.NoSuchProcess):
                left.append(child.name())
                child.kill()
        psutil.wait_procs(alive, timeout=ENDING_S)
        alive = psutil.Process().children(recursive=True)
    return left


if __name__ == "__main__":
    main(sys.argv[1:])
