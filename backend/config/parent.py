"""The parent of several web workers and their pool: holds the port, and replaces workers that end or hang.

The parent answers no requests and does no work for users, so it hardly ever crashes. Workers are new
processes and not forks, since a fork of a process with threads is unsafe. They inherit the listening socket,
so a connection that arrives while a worker is replaced is accepted by another worker.
"""

from __future__ import annotations

import logging
import selectors
import signal
import socket
import subprocess
import sys
import tempfile
import time
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final

from backend.config.environment import REPOSITORY, environment
from backend.config.server import ServeError
from backend.core.clients import proxies
from backend.core.logs import set_up
from backend.core.processes.numbers import BEAT, STARTED, STUCK, make_page
from backend.core.processes.siblings import PAGE, PLACES, POOL

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

log = logging.getLogger(__name__)

TICK_S: Final = 1.0
HUNG_S: Final = 60.0
"""Seconds for which a worker's event loop, or all of its request threads, may make no progress."""
SHORT_LIFE_S: Final = 10.0
"""Seconds; a worker that ends sooner after its start is restarted after a pause."""
FIRST_PAUSE_S: Final = 0.5
LONGEST_PAUSE_S: Final = 30.0
FUTILE: Final = 5
"""The number of failed starts in a row of all workers after which the server ends."""
POOL_PAGE: Final = "pool.numbers"
STOP_S: Final = 20.0
"""Seconds that workers may take to end after the signal."""
ENDING: Final = (signal.SIGTERM, signal.SIGINT)


class Child:
    """One worker process, and its replacements.

    Args:
        name: its name in the log.
        command: its command line.
        page: its page of counters.
        descriptors: the file descriptors that it inherits.
    """

    def __init__(
        self,
        name: str,
        command: Sequence[str],
        page: memoryview[float],
        descriptors: Sequence[int] = (),
    ) -> None:
        self.name = name
        self._command, self._descriptors = command, descriptors
        self._page = page
        self._process: subprocess.Popen[bytes] | None = None
        self._since_s = self._due_s = 0.0
        self._beat = (0.0, 0.0)
        self._is_given_up = False
        self.failures = 0
        """Failed starts in a row."""

    @property
    def has_started(self) -> bool:
        """Whether the worker has answered since its start."""
        return self._process is not None and bool(self._page[STARTED])

    def start_if_due(self, now_s: float) -> None:
        """Starts the worker, unless it is running or its pause is not over."""
        if self._process is not None or now_s < self._due_s:
            return
        self._page[STARTED] = self._page[STUCK] = self._page[BEAT] = 0
        self._process = subprocess.Popen(
            self._command,
            cwd=REPOSITORY,
            pass_fds=self._descriptors,
            # Nothing is ever written to this pipe: when it closes, the worker knows that the parent ended.
            stdin=subprocess.PIPE,
            start_new_session=True,  # Ctrl+C is for the parent, which passes it on
        )
        self._since_s, self._beat, self._is_given_up = now_s, (0.0, 0.0), False

    def ended(self, now_s: float) -> int | None:
        """Returns the exit status once after the worker has ended, and schedules its restart.

        Otherwise None.
        """
        if self._process is None or (status := self._process.poll()) is None:
            return None
        has_lived = self.has_started and now_s - self._since_s >= SHORT_LIFE_S
        self.failures = 0 if has_lived else self.failures + 1
        self._due_s = now_s if has_lived else now_s + _pause_s(self.failures)
        self._forget()
        return status

    def hangs(self, passed_s: float) -> bool:
        """Returns whether the worker made no progress for too long; True only once.

        Args:
            passed_s: seconds since the last call. If they are many, the parent itself was suspended.
        """
        if self._process is None or not self._page[STARTED] or self._is_given_up:
            return False
        beat, silent_s = self._beat
        silent_s = 0.0 if self._page[BEAT] != beat else silent_s + min(passed_s, TICK_S)
        self._beat = (self._page[BEAT], silent_s)
        self._is_given_up = max(silent_s, self._page[STUCK]) > HUNG_S
        return self._is_given_up

    def tell(self, number: signal.Signals) -> None:
        """Sends a signal to the worker."""
        if self._process is not None:
            with suppress(ProcessLookupError):
                self._process.send_signal(number)

    def close_input(self) -> None:
        """Closes the worker's standard input, the signal that the parent ends."""
        if self._process is not None and self._process.stdin is not None:
            self._process.stdin.close()

    def end(self, deadline_s: float) -> None:
        """Waits for the end of the worker, and kills it after a timeout."""
        if self._process is None:
            return
        try:
            self._process.wait(max(0.0, deadline_s - time.monotonic()))
        except subprocess.TimeoutExpired:
            log.warning("the %s did not end and is killed", self.name)
            self._process.kill()
            self._process.wait()
        self._forget()

    def _forget(self) -> None:
        self.close_input()
        self._process = None
        self._page[STARTED] = 0


def _pause_s(failures: int) -> float:
    return float(min(FIRST_PAUSE_S * 2 ** (failures - 1), LONGEST_PAUSE_S))


class Parent:
    """Keeps several workers running until it receives a signal to end."""

    def __init__(self, listener: socket.socket, count: int, *, on_ready: Callable[[], None]) -> None:
        self._listener, self._count, self._on_ready = listener, count, on_ready
        self._workers: list[Child] = []
        self._is_ready = False
        self._told: signal.Signals | None = None

    def run(self) -> signal.Signals | None:
        """Serves until a signal arrives; returns the signal.

        Raises:
            ServeError: the workers do not start, or none can be restarted.
        """
        with ExitStack() as stack:
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="bt-studio-")))
            (folder / PLACES).mkdir()
            woken = stack.enter_context(_Alarm(self._end))
            self._pool = self._make_pool(folder)
            self._workers = [self._worker(folder, number) for number in range(self._count)]
            stack.callback(self._end_all)
            looked_s = time.monotonic()
            while self._told is None:
                now_s = time.monotonic()
                self._look(now_s, now_s - looked_s)
                looked_s = now_s
                woken.wait(TICK_S)
        return self._told

    @staticmethod
    def _make_pool(folder: Path) -> Child:
        path = folder / POOL_PAGE
        page = make_page(path)
        command = [sys.executable, "-m", "backend.workers.service", "--socket", str(folder / POOL)]
        return Child("pool of processes", [*command, "--page", str(path)], page)

    def _worker(self, folder: Path, number: int) -> Child:
        command = [sys.executable, "-m", "backend.config.web_worker", "--fd", str(self._listener.fileno())]
        place = ["--folder", str(folder), "--count", str(self._count), "--own", str(number)]
        page = make_page(folder / PAGE.format(number))
        return Child(f"web worker {number}", [*command, *place], page, [self._listener.fileno()])

    def _end(self, number: signal.Signals) -> None:
        self._told = number

    def _look(self, now_s: float, passed_s: float) -> None:
        """Does one round: notes ended workers, kills workers that hang, and starts those that are due."""
        for worker in (self._pool, *self._workers):
            if worker.hangs(passed_s):
                log.error("the %s hangs and is replaced", worker.name)
                worker.tell(signal.SIGKILL)
            status = worker.ended(now_s)
            if status is not None:
                self._note_end(worker, status)
            worker.start_if_due(now_s)
        if not self._is_ready and all(each.has_started for each in (self._pool, *self._workers)):
            self._is_ready = True
            self._on_ready()

    def _note_end(self, worker: Child, status: int) -> None:
        how = _how_ended(status)
        if not self._is_ready:
            raise ServeError(f"The {worker.name} {how} before the server was ready; what it says is above.")
        if all(each.failures >= FUTILE and not each.has_started for each in self._workers):
            raise ServeError(f"No web worker can start any more; the last one {how}. What they say is above.")
        log.error("the %s %s and is started again", worker.name, how)

    def _end_all(self) -> None:
        for worker in self._workers:
            worker.tell(signal.SIGTERM)
        deadline_s = time.monotonic() + STOP_S
        for worker in self._workers:
            worker.end(deadline_s)
        self._pool.close_input()  # last: workers that are ending may still wait for the pool
        self._pool.end(deadline_s)


def _how_ended(status: int) -> str:
    return f"was ended by {signal.Signals(-status).name}" if status < 0 else f"ended with status {status}"


class _Alarm:
    """Wakes the parent when a child ends or when a signal to end arrives."""

    def __init__(self, on_end: Callable[[signal.Signals], None]) -> None:
        self._on_end = on_end

    def __enter__(self) -> _Alarm:
        self._ours, theirs = socket.socketpair()
        self._ours.setblocking(False)  # noqa: FBT003 - the library's
        theirs.setblocking(False)  # noqa: FBT003 - as above
        self._theirs = theirs
        self._selector = selectors.DefaultSelector()
        self._selector.register(self._ours, selectors.EVENT_READ)
        self._wakeup = signal.set_wakeup_fd(theirs.fileno(), warn_on_full_buffer=False)
        self._before = {number: signal.getsignal(number) for number in (*ENDING, signal.SIGCHLD)}
        for number in ENDING:
            signal.signal(number, lambda which, _: self._on_end(signal.Signals(which)))
        signal.signal(signal.SIGCHLD, lambda *_: None)  # only handled signals wake the process
        return self

    def __exit__(self, *_: object) -> None:
        signal.set_wakeup_fd(self._wakeup)
        for number, handler in self._before.items():
            signal.signal(number, handler)
        self._selector.close()
        self._ours.close()
        self._theirs.close()

    def wait(self, seconds: float) -> None:
        """Waits for the next signal, or until the timeout."""
        if self._selector.select(seconds):
            with suppress(BlockingIOError):
                while self._ours.recv(4096):
                    pass


def serve_by_several(listener: socket.socket, count: int, *, on_ready: Callable[[], None]) -> None:
    """Serves with several workers until SIGINT or SIGTERM; ends like a single server.

    Raises:
        ServeError: the workers do not start, or none can be restarted.
    """
    set_up(environment().log_level, environment().log_style)
    proxies.at_start()
    told = Parent(listener, count, on_ready=on_ready).run()
    if told is signal.SIGTERM:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        signal.raise_signal(signal.SIGTERM)
