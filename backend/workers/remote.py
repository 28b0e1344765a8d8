"""The client of the pool that several web workers share; `service.py` is its server."""

from __future__ import annotations

import itertools
import logging
import socket
import threading
from concurrent.futures import Future
from concurrent.futures import TimeoutError as FutureTimeoutError
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Final

import msgspec

from backend.workers import frames
from backend.workers.errors import BusyError, TookTooLongError, WorkFailedError

if TYPE_CHECKING:
    from pathlib import Path

    from backend.core.problems import StudioError

log = logging.getLogger(__name__)

PATIENCE_S: Final = 2.0
_ERRORS: Final[dict[str, type[StudioError]]] = {
    error.code: error for error in (BusyError, TookTooLongError, WorkFailedError)
}


class RemotePool:
    """Passes jobs to the shared pool; its methods are thread-safe.

    Args:
        path: the path of the pool's socket.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._lock = threading.Lock()
        self._line: _Line | None = None

    @property
    def waiting(self) -> int:
        """The number of waiting jobs of all web workers; 0 while the pool does not answer."""
        with suppress(BusyError, FutureTimeoutError):
            return int(self._ask({}).result(PATIENCE_S))
        return 0

    def ask(self, owner: str, job: str, **arguments: Any) -> Future[Any]:
        """Passes a job to the pool, like `Pool.ask`.

        If too many jobs wait, the error is raised by the future.

        Raises:
            BusyError: the pool is restarting.
        """
        return self._ask({"owner": owner, "job": job, "arguments": arguments})

    def _ask(self, message: dict[str, Any]) -> Future[Any]:
        with self._lock:
            if self._line is None or self._line.is_over:
                self._line = _Line(self._path)
        return self._line.ask(message)


class _Line:
    """One connection to the pool; it is not used again after it has ended."""

    def __init__(self, path: Path) -> None:
        self._connection = socket.socket(socket.AF_UNIX)
        try:
            self._connection.settimeout(PATIENCE_S)
            self._connection.connect(str(path))
            self._connection.settimeout(None)
        except OSError as error:
            self._connection.close()
            raise _gone() from error
        self.is_over = False
        self._lock, self._sending = threading.Lock(), threading.Lock()
        self._numbers = itertools.count()
        self._asked: dict[int, Future[Any]] = {}
        threading.Thread(target=self._read, name="pool", daemon=True).start()

    def ask(self, message: dict[str, Any]) -> Future[Any]:
        """Sends a job; returns a future that receives the result or an error."""
        future: Future[Any] = Future()
        number = next(self._numbers)
        packed = frames.pack(message | {"number": number})
        with self._lock:
            if self.is_over:
                raise _gone()
            self._asked[number] = future
        try:
            with self._sending:
                frames.send(self._connection, packed)
        except frames.FrameError:
            self._end()
        return future

    def _read(self) -> None:
        with suppress(frames.FrameError, msgspec.DecodeError):
            while True:
                answer = msgspec.msgpack.decode(frames.receive(self._connection))
                with self._lock:
                    future = self._asked.pop(answer["number"], None)
                if future is None:  # the connection ended meanwhile
                    break
                if "error" in answer:
                    kind = _ERRORS.get(answer["error"], WorkFailedError)
                    future.set_exception(kind(answer["detail"], hint=answer["hint"]))
                else:
                    future.set_result(answer["result"])
                del answer, future  # they do not stay while the thread waits
        self._end()
        self._connection.close()

    def _end(self) -> None:
        with self._lock:
            self.is_over = True
            asked, self._asked = self._asked, {}
        with suppress(OSError):
            self._connection.shutdown(socket.SHUT_RDWR)
        for future in asked.values():
            future.set_exception(_gone())


def _gone() -> BusyError:
    return BusyError(
        "What translates and checks projects is being started again.", hint="Try again in a few seconds."
    )
