"""Runs a program of a launch file so that it cannot outlive the manager.

`python -m executor.launching.program FOLDER PROGRAM ARGUMENTS…` changes to the folder, asks the kernel
for a signal at the death of the manager, and replaces itself by the program (`exec`).
"""

from __future__ import annotations

import os
import sys

from executor.supervision.confine import die_with_parent


def main() -> None:
    """Executes the program; reports a failure on stderr with the exit code 127, as a shell does."""
    folder, *command = sys.argv[1:]
    die_with_parent()
    try:
        os.chdir(folder)
        os.execv(command[0], command)  # noqa: S606 - what the launch file asks for, without a shell
    except OSError as error:
        sys.stderr.write(f"{command[0]}: {error.strerror}\n")
        sys.exit(127)


if __name__ == "__main__":
    main()
