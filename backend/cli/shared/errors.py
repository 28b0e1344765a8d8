"""Errors of the command line: one sentence for each problem, and never a traceback."""

from __future__ import annotations

import sys
from typing import NoReturn

WORK_FAILED = 1
BAD_ARGUMENTS = 2


class CliError(Exception):
    """A command failed; `lines` are printed on stderr, one for each problem."""

    def __init__(self, *lines: str, status: int = WORK_FAILED) -> None:
        super().__init__("\n".join(lines))
        self.lines = lines
        self.status = status


def exit_with(error: CliError) -> NoReturn:
    """Prints the problems on stderr and ends the program with the error's status."""
    for line in error.lines:
        print(line, file=sys.stderr)
    sys.exit(error.status)
