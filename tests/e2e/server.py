"""The real server, started as a user starts it, and the processes that it leaves."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

import psutil

from tests.processes import with_word

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

# Generous: benchmarks measure durations, and a busy machine must not fail a test.
DEADLINE_S = 60


class Server(NamedTuple):
    """A running server: the link with the token, and its process."""

    url: str
    process: psutil.Process

    @property
    def origin(self) -> str:
        """Scheme, host and port of the server."""
        return self.url.split("/?")[0].rstrip("/")

    def children(self) -> list[psutil.Process]:
        """Returns every process of a session below the server: managers, worlds, applications."""
        return with_word("executor", self.process.children(recursive=True))


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


def wait_until(
    true: Callable[[], object], what: str, *, deadline_s: float = DEADLINE_S, every_s: float = 0.05
) -> None:
    """Waits for `true()`; the error names the condition that was not met."""
    end = time.monotonic() + deadline_s
    while not true():
        assert time.monotonic() < end, f"after {deadline_s} s still not: {what}"
        time.sleep(every_s)
