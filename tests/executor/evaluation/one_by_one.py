"""One process of `cells` for many tests, which stays in step with them."""

from __future__ import annotations

import json
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from executor.evaluation.outcome import Outcome, read_outcome

if TYPE_CHECKING:
    from collections.abc import Mapping

ROOT = Path(__file__).parents[3]
END_S = 10
CELLS = (sys.executable, "-m", "tests.executor.evaluation.cells")


class Cells:
    """Asks a process for outcomes, one at a time.

    A test that was interrupted while it waited (by its time limit) has left an answer in the pipe, or a run
    that never ends; a run may also have ended the process. The next question then begins with a process of
    its own.

    Args:
        environment: of the process; this one's if it is None.
        command: what is run in place of `cells`.
    """

    def __init__(
        self, environment: Mapping[str, str] | None = None, command: tuple[str, ...] = CELLS
    ) -> None:
        self._environment = environment
        self._command = command
        self._process: subprocess.Popen[str] | None = None
        self._in_step = False

    def __call__(self, folder: Path, seed: int = 0, **options: Any) -> Outcome:
        """Returns the outcome of one seed of the project in a folder."""
        process = self._ready()
        assert process.stdin is not None
        assert process.stdout is not None
        self._in_step = False
        process.stdin.write(json.dumps({"folder": str(folder), "seed": seed, **options}) + "\n")
        process.stdin.flush()
        line = process.stdout.readline()
        assert line, "the run has ended its process"
        self._in_step = True
        return read_outcome(line)

    @property
    def pid(self) -> int:
        """The process that has answered."""
        assert self._process is not None
        return self._process.pid

    def _ready(self) -> subprocess.Popen[str]:
        if self._process is not None and (not self._in_step or self._process.poll() is not None):
            self._kill()
        if self._process is None:
            self._process = subprocess.Popen(
                self._command,
                cwd=ROOT,
                env=None if self._environment is None else dict(self._environment),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                text=True,
            )
        return self._process

    def _kill(self) -> None:
        process, self._process = self._process, None
        if process is None:
            return
        process.kill()
        process.wait()
        for pipe in (process.stdin, process.stdout):
            assert pipe is not None
            with suppress(BrokenPipeError):  # a question may not have been sent whole
                pipe.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Ends the process; one that does not end by itself is killed."""
        process = self._process
        if process is not None and self._in_step:
            assert process.stdin is not None
            process.stdin.close()
            with suppress(subprocess.TimeoutExpired):
                process.wait(END_S)
        self._kill()
