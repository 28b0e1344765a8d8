"""Forks servers: all imports are done once, so that the server may be killed hundreds of times.

Each line of the standard input is a path: a server is forked, and writes there when it can be used. When it
has ended, its exit status is a line of the standard output.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

from tests.backend.serving import REPOSITORY, TIMEOUT_S, Served, await_ready


class Zygote:
    """The client of the process that forks."""

    def __init__(self, process, folder):
        self._process = process
        self._folder = folder

    @contextmanager
    def serving(self):
        """A server that the test kills, or that ends with the block."""
        ready_file = self._folder / f"ready-{time.monotonic_ns()}.json"
        self._process.stdin.write(f"{ready_file}\n")
        self._process.stdin.flush()
        served = Forked(self._process, await_ready(self._process, ready_file))
        try:
            yield served
        finally:
            served.end()


class Forked(Served):
    """A forked server."""

    def __init__(self, process, ready):
        super().__init__(process, ready)
        self._pid = ready["pid"]
        self.status = None

    def end(self, how=15):
        """Sends the signal, and waits for the end; a second call does nothing."""
        if self.status is None:
            os.kill(self._pid, how)
            self.status = int(self.process.stdout.readline())
        return self.status


@contextmanager
def zygote(folder, **environment):
    """A process that forks servers with their data in `folder`."""
    settings = {"BT_STUDIO_DATA_DIR": str(folder), "BT_STUDIO_PORT": "0", "BT_STUDIO_TOKEN": "t" * 24}
    clean = {name: value for name, value in os.environ.items() if not name.startswith("BT_STUDIO_")}
    with tempfile.TemporaryFile("w+") as log, tempfile.TemporaryDirectory() as readies:
        process = subprocess.Popen(
            [sys.executable, "-m", "tests.backend.zygote"],
            cwd=REPOSITORY,
            env=clean | settings | environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=log,
            text=True,
        )
        with process:
            try:
                yield Zygote(process, Path(readies))
            finally:
                process.stdin.close()
                process.wait(timeout=TIMEOUT_S)


def main():
    """Forks a server for each line, one after the other."""
    from backend.config.environment import environment
    from backend.config.server import make_data_folder

    make_data_folder(environment().data_dir)
    from backend.cli.serve import _serve
    from backend.config import asgi, urls  # noqa: F401 - imported once for all

    answers = os.dup(1)
    os.dup2(2, 1)  # the output of servers must not mix with the answers
    for line in sys.stdin:
        child = os.fork()
        if child == 0:
            _serve(open_browser=False, ready_file=Path(line.strip()))
            os._exit(0)
        _, status = os.waitpid(child, 0)
        os.write(answers, f"{os.waitstatus_to_exitcode(status)}\n".encode())


if __name__ == "__main__":
    main()
