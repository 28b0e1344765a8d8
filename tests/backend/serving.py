"""Starts the real server for a test."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryFile

REPOSITORY = Path(__file__).parents[2]
TIMEOUT_S = 240
PROGRAM = ("-m", "backend.cli.main")


class Served:
    """A running server: its process, address and token, and the files that hold what it says."""

    def __init__(self, process, ready, said=()):
        self.process, self._said = process, said
        self.port = ready["port"]
        self.token = ready["url"].partition("token=")[2]
        self.base = (
            f"http://127.0.0.1:{self.port}" if "/?" not in ready["url"] else ready["url"].partition("/?")[0]
        )
        self.headers = {"Authorization": f"Bearer {self.token}"}

    def end(self, how=signal.SIGTERM):
        self.process.send_signal(how)
        self.process.wait(TIMEOUT_S)
        self.output = tuple(whole(file) for file in self._said)
        return self.process.returncode


def whole(file):
    """Returns all that a file contains, to which another process may append."""
    file.seek(0)
    return file.read()


def start(folder, *arguments, prefix=(), program=PROGRAM, log=None, repository=REPOSITORY, **environment):
    """A process that serves, or tries to; started by the program `prefix`, if any.

    What it says goes to the two open files `log`, for output and errors, or to pipes, which hold 64 KB: a
    server that says more waits. Its program is that of `repository`.
    """
    output, errors = log or (subprocess.PIPE, subprocess.PIPE)
    clean = {name: value for name, value in os.environ.items() if not name.startswith("BT_STUDIO_")}
    command = [sys.executable, *program, "serve", "--no-browser", "--data-dir", str(folder)]
    return subprocess.Popen(
        [*prefix, *command, *arguments],
        cwd=repository,
        env=clean | {"PYTHONPATH": str(repository)} | environment,
        stdout=output,
        stderr=errors,
        text=True,
    )


def await_ready(process, ready_file, said=str):
    """Returns the address that the server writes when it is ready; `said` returns why it does not come."""
    deadline = time.monotonic() + TIMEOUT_S
    while not ready_file.exists():
        assert process.poll() is None, said()
        assert time.monotonic() < deadline
        time.sleep(0.01)
    return json.loads(ready_file.read_text())


@contextmanager
def serving(folder, *arguments, prefix=(), program=PROGRAM, log=None, repository=REPOSITORY, **environment):
    """A server on a free port, which is stopped at the end; it writes to the open file `log`, if any."""
    ready_file = Path(folder) / "ready.json"
    ready_file.unlink(missing_ok=True)
    own = ("--port", "0", "--ready-file", str(ready_file))
    how = {"prefix": prefix, "program": program, "repository": repository}
    with TemporaryFile("a+") as output, TemporaryFile("a+") as errors:
        said = (log, log) if log else (output, errors)
        with start(folder, *own, *arguments, log=said, **how, **environment) as process:
            try:
                ready = await_ready(process, ready_file, lambda: [whole(file) for file in (output, errors)])
                yield Served(process, ready, () if log else said)
            finally:
                if process.poll() is None:
                    process.terminate()
                    process.wait(TIMEOUT_S)
