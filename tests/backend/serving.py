"""Starts the real server for a test."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryFile

from tests.backend.migrated import add_sqlite
from tests.backend.preloaded import preloaded
from tests.backend.programs import environment_with

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
    server that says more waits. Its program is that of `repository`. With files it is forked, where
    `preloaded` allows it.
    """
    command = [*program, "serve", "--no-browser", "--data-dir", str(folder), *arguments]
    own = environment_with(environment, repository)
    if log and not prefix and program is PROGRAM and repository == REPOSITORY and (forking := preloaded()):
        streams = (0, log[0].fileno(), log[1].fileno())
        return forking.start(*command[1:], env=own, streams=streams)
    output, errors = log or (subprocess.PIPE, subprocess.PIPE)
    return subprocess.Popen(
        [*prefix, sys.executable, *command],
        cwd=repository,
        env=own,
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
def serving(
    folder,
    *arguments,
    prefix=(),
    program=PROGRAM,
    log=None,
    repository=REPOSITORY,
    is_migrated=True,
    **environment,
):
    """A server on a free port, which is stopped at the end; it writes to the open file `log`, if any.

    It finds the tables of a new database in its data folder, unless it shall make them, or uses another one.
    """
    if is_migrated and repository == REPOSITORY and "BT_STUDIO_DATABASE_URL" not in environment:
        add_sqlite(Path(folder))
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
