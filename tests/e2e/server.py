"""The real server, started as a user starts it, and the processes that it leaves."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

import psutil

from tests.deadline import DEADLINE_S, wait_until
from tests.processes import command_line, with_word

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["DEADLINE_S", "RARELY_S", "Server", "command", "serving", "wait_until"]
# Between looks that take processor time themselves: at a picture of the page, at all processes.
RARELY_S = 0.25


class Server(NamedTuple):
    """A running server: the link with the token, and its process."""

    url: str
    process: psutil.Process

    @property
    def origin(self) -> str:
        """Scheme, host and port of the server."""
        return self.url.split("/?")[0].rstrip("/")

    def children(self) -> list[psutil.Process]:
        """Returns every process of a project's session below the server: managers, worlds, applications.

        Those of a manager that follows a program, or that waits for one, are not among them.
        """
        return [
            process
            for manager in self.process.children()
            if "--attach" not in command_line(manager)
            for process in with_word("executor", [manager, *_below(manager)])
        ]


def _below(process: psutil.Process) -> list[psutil.Process]:
    try:
        return process.children(recursive=True)
    except psutil.NoSuchProcess:
        return []


def command(*arguments: str, python: str = sys.executable) -> list[str]:
    """Returns the `bt-studio` program of this environment, or of another Python's."""
    return [python, "-m", "backend.cli.main", *arguments]


@contextmanager
def serving(
    folder: Path, *arguments: str, python: str = sys.executable, **environment: str
) -> Iterator[Server]:
    """Starts `bt-studio serve` on a free port with its data in `folder`; ends it and its descendants."""
    ready = folder / "ready.json"
    log = (folder / "serve.log").open("wb")
    data = str(folder / "data")
    serve = command("serve", "--no-browser", "--port", "0", "--data-dir", data, python=python)
    process = subprocess.Popen(
        [*serve, "--ready-file", str(ready), *arguments],
        env=os.environ | environment,
        stdout=log,
        stderr=subprocess.STDOUT,
    )

    def answered() -> bool:
        return ready.exists() or process.poll() is not None

    try:
        wait_until(lambda: ready.exists() or process.poll() is not None, "the server serves")
        assert process.poll() is None, (folder / "serve.log").read_text()
        yield Server(json.loads(ready.read_text())["url"], psutil.Process(process.pid))
    finally:
        below = psutil.Process(process.pid).children(recursive=True) if process.poll() is None else []
        process.send_signal(signal.SIGINT)
        process.wait(DEADLINE_S)
        _, alive = psutil.wait_procs(below, timeout=DEADLINE_S)
        log.close()
    assert not alive, f"the server left processes behind: {alive}"
