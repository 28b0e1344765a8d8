"""A lane of the suite: a command whose lines are shown as they come, with the lane's name.

The lines that name failures, and the beginnings of their errors, are kept for the end.
"""

from __future__ import annotations

import os
import re
import subprocess
import threading
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from pathlib import Path

# Results of pytest; all others mean that its run did not come to its end.
PASSED: Final = 0
TESTS_FAILED: Final = 1
NOT_COMPLETE: Final = 2
# The lines of an error that are shown again at the end, and of a command without failures that failed.
ERROR_LINES: Final = 6
LAST_LINES: Final = 30
_FAILURE: Final = re.compile(r"(?:FAILED|ERROR) (?:tests/|src/)")
_PAGE_FAILURE: Final = re.compile(r"\s*FAIL\s+")
_TITLE: Final = re.compile(r"_{3,} .+ _{3,}$")
_COLOURS: Final = re.compile(r"\x1b\[[0-9;]*m")


class Lane(threading.Thread):
    """A command of the suite."""

    def __init__(
        self, name: str, command: list[str], folder: Path, environment: dict[str, str] | None = None
    ) -> None:
        super().__init__(name=name)
        self.result = PASSED
        self.processor_s = 0.0
        """The processor time of the command with its children, in seconds."""
        self.failures: list[str] = []
        self._errors: list[list[str]] = []
        self._last: list[str] = []
        self._command = command
        self._folder = folder
        self._environment = environment or {}

    @property
    def summary(self) -> list[str]:
        """The failures, and under them the beginnings of their errors."""
        if self.result == PASSED:
            return []
        found = [*self.failures, *(line for error in self._errors for line in error[:ERROR_LINES])]
        return found or self._last

    def run(self) -> None:
        """Runs the command to its end."""
        with subprocess.Popen(
            self._command,
            cwd=self._folder,
            env=os.environ | self._environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
        ) as process:
            for line in process.stdout or ():
                print(f"{self.name:7}| {line}", end="", flush=True)
                self.read(line)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        self.processor_s = usage.ru_utime + usage.ru_stime
        self.result = abs(process.returncode)
        if self.result == TESTS_FAILED and not self.failures and "pytest" in self._command:
            self.result = NOT_COMPLETE  # it ended before its summary

    def read(self, line: str) -> None:
        """Keeps a line if it names a failure or says what failed."""
        line = _COLOURS.sub("", line)
        self._last = [*self._last[1 - LAST_LINES :], line]
        if _FAILURE.match(line) or _PAGE_FAILURE.match(line):
            self.failures.append(line)
        elif _TITLE.match(line.rstrip()):
            self._errors.append([])
        elif line.startswith("E  ") and self._errors:
            self._errors[-1].append(line)

    def __str__(self) -> str:
        result = "passed" if self.result == PASSED else f"FAILED ({self.result})"
        return f"{self.name} {result} ({self.processor_s / 60:.1f})"
