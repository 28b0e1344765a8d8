"""One run of a benchmark in one tree, in its own processes and temporary folder."""

from __future__ import annotations

import contextlib
import dataclasses
import json
import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tests.benchmarks.beside.trees import CannotCompareError, Tree
from tests.benchmarks.figures import Figure

if TYPE_CHECKING:
    from collections.abc import Sequence

OWN: Final = "own"
WHOLE: Final = "whole"
LEFT_OUT: Final = {"PYTHONPATH", "VIRTUAL_ENV"}
PROCESSOR: Final = "all its processes: processor time"
# A tree's own benchmarks may be older than the worker.
MAIN: Final = "import sys, importlib; importlib.import_module('tests.benchmarks.' + sys.argv[1]).main()"


class FailedError(CannotCompareError):
    """A benchmark that did not reach its end."""


@dataclasses.dataclass(frozen=True)
class Task:
    """A benchmark with its options."""

    name: str
    options: Sequence[str]
    kind: str = OWN


def run(root: Path, tree: Tree, task: Task, log: Path) -> list[Figure]:
    """Runs a benchmark in a tree and returns its figures; the meter is that of `root`, for both trees."""
    with tempfile.TemporaryDirectory(prefix="beside-", ignore_cleanup_errors=True) as name:
        folder = Path(name)
        figures, result = folder / "figures.jsonl", folder / "result.json"
        figures.touch()
        (folder / "tmp").mkdir()
        python = str(tree.python)
        work = [python, "-m", "tests.benchmarks.beside.worker", task.kind, str(figures), task.name]
        if task.kind == WHOLE:
            work = [python, "-c", MAIN, task.name]
        # The meter finds its own modules in this tree; the work begins in the folder of its tree.
        meter = [sys.executable, "-m", "tests.benchmarks.beside.meter", str(result), str(tree.folder)]
        environment = {name: value for name, value in os.environ.items() if name not in LEFT_OUT}
        _metered([*meter, *work, *task.options], root, environment | {"TMPDIR": str(folder / "tmp")}, log)
        found = json.loads(result.read_text()) if result.exists() else {"code": "no result"}
        if found["code"] != 0:
            raise FailedError(
                f"{task.name} failed ({found['code']}) in {tree.folder}: {last_line(log)} (see {log})"
            )
        return [*_read(figures), *_around(found)]


def _metered(command: list[str], root: Path, environment: dict[str, str], log: Path) -> None:
    """Runs the meter in its own session, so that Ctrl+C reaches it in one way only."""
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("wb") as output:
        meter = subprocess.Popen(
            command, cwd=root, env=environment, stdout=output, stderr=output, start_new_session=True
        )
        try:
            meter.wait()
        except BaseException:
            # A second Ctrl+C must not leave what the meter is about to end.
            with contextlib.suppress(ValueError):
                signal.signal(signal.SIGINT, signal.SIG_IGN)
            meter.terminate()
            meter.wait()
            raise


def _read(path: Path) -> list[Figure]:
    return [Figure(**json.loads(line)) for line in path.read_text(encoding="utf-8").splitlines()]


def _around(found: dict[str, Any]) -> list[Figure]:
    return [
        Figure(PROCESSOR, found["processor_s"], "s"),
        Figure("all its processes: peak of memory (PSS)", found["peak_mb"], "MB"),
        Figure("the whole run by the clock", found["wall_s"], "s"),
    ]


def last_line(log: Path) -> str:
    """Returns the last line that a run printed."""
    lines = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()
    return lines[-1] if lines else "it printed nothing"
