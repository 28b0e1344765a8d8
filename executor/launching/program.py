"""Becomes a program of a launch file, which then cannot outlive the manager.

`python -m executor.launching.program FOLDER PROGRAM ARGUMENTS…` goes into the folder, asks for a signal at
the death of the manager, and replaces itself by the program.
"""

from __future__ import annotations

import os
import sys

from executor.supervision.confine import die_with_parent


def main() -> None:
    """Does so; what cannot be started is said on stderr, and the exit code is 127 as a shell's."""
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
