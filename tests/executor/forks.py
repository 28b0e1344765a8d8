"""Starts processes of the product as forks of one that has loaded their modules, see `fork_server`."""

from __future__ import annotations

import json
import os
import select
import signal
import socket
import subprocess
import sys
import tempfile
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor.ros.environment import lockstep_environment
from executor.supervision.single_threaded import SINGLE_THREADED

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__all__ = ["FORKS", "Fork", "completed"]

ROOT: Final = Path(__file__).parents[2]
LONGEST: Final = 1 << 16
LONGEST_S: Final = 580


class Fork:
    """A process, as far as it is like one of `subprocess`."""

    def __init__(self, server: ForkServer, pid: int) -> None:
        self._server = server
        self.pid = pid
        self._fd = os.pidfd_open(pid)
        self.returncode: int | None = None

    def wait(self, timeout: float | None = None) -> int:
        """Waits for its end; returns its exit code, negative for a signal.

        Raises:
            subprocess.TimeoutExpired: it has not ended in time.
        """
        if self.returncode is None:
            if not select.select([self._fd], [], [], timeout)[0]:
                raise subprocess.TimeoutExpired("a fork", timeout or 0.0)
            self.returncode = self._server.ask({"ended": self.pid})
            os.close(self._fd)
        return self.returncode

    def kill(self) -> None:
        """Kills it, unless it has ended."""
        if self.returncode is None:
            signal.pidfd_send_signal(self._fd, signal.SIGKILL)


class ForkServer:
    """The server of this process, which is started with its first fork."""

    def __init__(self) -> None:
        self._link: socket.socket | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()

    def start(
        self, module: str, arguments: Sequence[str], environment: Mapping[str, str], *files: int
    ) -> Fork:
        """Runs the `main` of a module; `files` get the numbers from 0 on."""
        request = {
            "module": module,
            "arguments": list(arguments),
            "environment": dict(environment),
            "folder": str(ROOT),
            "numbers": list(range(len(files))),
        }
        return Fork(self, self.ask(request, *files))

    def ask(self, request: dict[str, Any], *files: int) -> int:
        """Sends a request, and returns the number that is its answer."""
        with self._lock:
            link = self._link or self._begin()
            socket.send_fds(link, [json.dumps(request).encode()], list(files))
            return int(json.loads(link.recv(LONGEST)))

    def close(self) -> None:
        """Ends the server, and with it what it has forked."""
        if self._link is not None and self._process is not None:
            self._link.close()
            assert self._process.wait(60) == 0
        self._link = self._process = None

    def _begin(self) -> socket.socket:
        self._link, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "tests.executor.fork_server", str(theirs.fileno())],
                cwd=ROOT,
                env={**os.environ, **lockstep_environment(), **SINGLE_THREADED},
                pass_fds=[theirs.fileno()],
            )
        return self._link


FORKS: Final = ForkServer()


def completed(module: str, *arguments: object) -> subprocess.CompletedProcess[str]:
    """Runs the `main` of a module, whose ROS graph is isolated, to its end."""
    words = [str(each) for each in arguments]
    environment = {**os.environ, **lockstep_environment(), **SINGLE_THREADED}
    with (
        Path(os.devnull).open() as nothing,
        tempfile.TemporaryFile("w+") as out,
        tempfile.TemporaryFile("w+") as errors,
    ):
        files = (each.fileno() for each in (nothing, out, errors))
        status = FORKS.start(module, words, environment, *files).wait(LONGEST_S)
        out.seek(0)
        errors.seek(0)
        return subprocess.CompletedProcess([module, *words], status, out.read(), errors.read())
