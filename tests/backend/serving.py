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

REPOSITORY = Path(__file__).parents[2]
TIMEOUT_S = 240
PROGRAM = ("-m", "backend.cli.main")


class Served:
    """A running server: its process, address and token."""

    def __init__(self, process, ready):
        self.process = process
        self.port = ready["port"]
        self.token = ready["url"].partition("token=")[2]
        self.base = (
            f"http://127.0.0.1:{self.port}" if "/?" not in ready["url"] else ready["url"].partition("/?")[0]
        )
        self.headers = {"Authorization": f"Bearer {self.token}"}

    def end(self, how=signal.SIGTERM):
        self.process.send_signal(how)
        self.output = self.process.communicate(timeout=TIMEOUT_S)
        return self.process.returncode


def start(folder, *arguments, prefix=(), program=PROGRAM, log=None, repository=REPOSITORY, **environment):
    """A process that serves, or tries to; started by the program `prefix`, if any.

    What it says goes to the open file `log`, or to pipes, which hold 64 KB: a server that says more waits.
    Its program is that of `repository`.
    """
    clean = {name: value for name, value in os.environ.items() if not name.startswith("BT_STUDIO_")}
    command = [sys.executable, *program, "serve", "--no-browser", "--data-dir", str(folder)]
    return subprocess.Popen(
        [*prefix, *command, *arguments],
        cwd=repository,
        env=clean | {"PYTHONPATH": str(repository)} | environment,
        stdout=log or subprocess.PIPE,
        stderr=log or subprocess.PIPE,
        text=True,
    )


def await_ready(process, ready_file):
    """Returns the address that the server writes when it is ready."""
    deadline = time.monotonic() + TIMEOUT_S
    while not ready_file.exists():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < deadline
        time.sleep(0.01)
    return json.loads(ready_file.read_text())


@contextmanager
def serving(folder, *arguments, prefix=(), program=PROGRAM, log=None, repository=REPOSITORY, **environment):
    """A server on a free port, which is stopped at the end."""
    ready_file = Path(folder) / "ready.json"
    ready_file.unlink(missing_ok=True)
    own = ("--port", "0", "--ready-file", str(ready_file))
    how = {"prefix": prefix, "program": program, "log": log, "repository": repository}
    process = start(folder, *own, *arguments, **how, **environment)
    with process:
        try:
            yield Served(process, await_ready(process, ready_file))
        finally:
            if process.poll() is None:
                process.terminate()
                process.communicate(timeout=TIMEOUT_S)
