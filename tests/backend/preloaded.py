"""Forks `python -m MODULE` from a process that has imported the libraries: a server starts in half the time.

What reads the settings (the product, and Django's apps) is imported by the forked process, with its own
environment. One process of this kind serves all tests of a pytest process.
"""

from __future__ import annotations

import gc
import importlib
import json
import os
import runpy
import selectors
import signal
import socket
import subprocess
import sys
import threading
import traceback
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any, NoReturn, Self

if TYPE_CHECKING:
    from collections.abc import Iterator

REPOSITORY = Path(__file__).parents[2]
# Those that take long, and need no settings.
LIBRARIES = (
    "cryptography.hazmat.primitives.serialization",
    "cryptography.x509",
    "django.core.management.commands.migrate",
    "django.db.backends.postgresql.psycopg_any",
    "django.db.backends.sqlite3.base",
    "django.test",
    "docutils.parsers.rst",
    "psutil",
    "pydantic_settings",
    "requests",
    "typer",
    "uvicorn.protocols.websockets.websockets_sansio_impl",
    "websockets.sync.client",
    "yaml",
)
STREAMS = 3
LARGEST = 1 << 20


class Process:
    """A forked process, with what tests use of `subprocess.Popen`."""

    def __init__(self, preloaded: Preloaded, pid: int) -> None:
        self._preloaded, self.pid = preloaded, pid

    @property
    def returncode(self) -> int | None:
        """The exit status as far as it is known."""
        return self._preloaded.ended.get(self.pid)

    def poll(self) -> int | None:
        """Returns the exit status if it has ended."""
        self._preloaded.hear(0)
        return self.returncode

    def wait(self, timeout: float | None = None) -> int:
        """Waits for its end.

        Raises:
            subprocess.TimeoutExpired: it runs still.
        """
        deadline_s = None if timeout is None else monotonic() + timeout
        while (status := self.returncode) is None:
            left_s = 1.0 if deadline_s is None else deadline_s - monotonic()
            if left_s <= 0:
                raise subprocess.TimeoutExpired(str(self.pid), timeout or 0)
            self._preloaded.hear(min(left_s, 1.0))
        return status

    def send_signal(self, number: int) -> None:
        """Sends a signal unless it has ended."""
        if self.poll() is None:
            os.kill(self.pid, number)

    def terminate(self) -> None:
        """Asks it to end."""
        self.send_signal(signal.SIGTERM)

    def kill(self) -> None:
        """Ends it."""
        self.send_signal(signal.SIGKILL)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.wait()


class Preloaded:
    """The process that forks; it ends with this one."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._control, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.ended: dict[int, int] = {}
        self._started: list[int] = []
        with theirs:
            command = [sys.executable, "-m", "tests.backend.preloaded", str(theirs.fileno())]
            self._process = subprocess.Popen(command, cwd=REPOSITORY, pass_fds=[theirs.fileno()])

    def start(
        self, module: str, *arguments: str, env: dict[str, str], streams: tuple[int, int, int]
    ) -> Process:
        """Starts a module in the folder of the repository; `streams` are its input, output and errors."""
        with self._lock:
            request = json.dumps([module, arguments, env]).encode()
            socket.send_fds(self._control, [request], list(streams))
            while not self._started:
                self._receive()
            return Process(self, self._started.pop())

    def hear(self, timeout_s: float) -> None:
        """Notes what has ended."""
        with self._lock:
            self._control.settimeout(max(timeout_s, 0.0))
            try:
                self._receive()
            except (BlockingIOError, TimeoutError):
                pass
            finally:
                self._control.settimeout(None)

    def _receive(self) -> None:
        message = self._control.recv(LARGEST)
        assert message, "the process that forks has ended"
        pid, status = json.loads(message)
        if status is None:
            self._started.append(pid)
        else:
            self.ended[pid] = status

    def close(self) -> None:
        """Ends it."""
        self._control.close()
        self._process.wait(60)


_allowed: list[Preloaded | None] = []


@contextmanager
def preloading() -> Iterator[None]:
    """Programs are forked in this block; the process that forks is started when it is needed first."""
    _allowed.append(None)
    yield
    if running := _allowed.pop():
        running.close()


def preloaded() -> Preloaded | None:
    """Returns the process that forks; none outside of `preloading`, as in a benchmark."""
    if _allowed and _allowed[-1] is None:
        _allowed[-1] = Preloaded()
    return _allowed[-1] if _allowed else None


def _become(request: bytes, streams: list[int]) -> NoReturn:
    """Runs a module in this forked process as `python -m` does."""
    status: Any = 1
    try:
        for number, stream in enumerate(streams):
            os.dup2(stream, number)
        for stream in streams:
            os.close(stream)
        module, arguments, env = json.loads(request)
        os.environ.clear()
        os.environ.update(env)
        folders = env.get("PYTHONPATH", "").split(os.pathsep)
        sys.path[1:1] = [folder for folder in folders if folder and folder not in sys.path]
        sys.argv = [module, *arguments]
        runpy.run_module(module, run_name="__main__", alter_sys=True)
        status = 0
    except SystemExit as ended:
        status = ended.code or 0
        if not isinstance(status, int):
            sys.stderr.write(f"{status}\n")
            status = 1
    except KeyboardInterrupt:
        traceback.print_exc()
        sys.stdout.flush()
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGINT)
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)


def _reap(control: socket.socket) -> None:
    while True:
        try:
            pid, status = os.waitpid(-1, os.WNOHANG)
        except ChildProcessError:
            return
        if pid == 0:
            return
        control.send(json.dumps([pid, os.waitstatus_to_exitcode(status)]).encode())


def main() -> None:
    """Forks for each request, and reports each end, until the tests end."""
    control = socket.socket(fileno=int(sys.argv[1]))
    for name in LIBRARIES:
        importlib.import_module(name)
    gc.collect()
    gc.freeze()
    interrupt = signal.signal(signal.SIGINT, signal.SIG_IGN)  # the tests end it
    woken, wakes = socket.socketpair()
    woken.setblocking(False)
    wakes.setblocking(False)
    child = signal.signal(signal.SIGCHLD, lambda *_: None)
    signal.set_wakeup_fd(wakes.fileno(), warn_on_full_buffer=False)
    with selectors.DefaultSelector() as selector:
        selector.register(control, selectors.EVENT_READ)
        selector.register(woken, selectors.EVENT_READ)
        while True:
            ready = {key.fileobj for key, _ in selector.select()}
            if woken in ready:
                woken.recv(4096)
                _reap(control)
            if control in ready:
                request, streams, _, _ = socket.recv_fds(control, LARGEST, STREAMS)
                if not request:
                    return
                if (pid := os.fork()) == 0:
                    signal.set_wakeup_fd(-1)
                    signal.signal(signal.SIGCHLD, child)
                    signal.signal(signal.SIGINT, interrupt)
                    for each in (control, woken, wakes, selector):
                        each.close()
                    _become(request, streams)
                for stream in streams:
                    os.close(stream)
                control.send(json.dumps([pid, None]).encode())


if __name__ == "__main__":
    main()
