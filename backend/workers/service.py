"""The pool that all web workers of a server use over a socket: `python -m backend.workers.service`.

With one pool, each user gets a fair share of the whole server, and the number of processes does not grow with
the number of web workers. The service and its processes end with the parent.
"""

from __future__ import annotations

import argparse
import logging
import os
import signal
import socket
import threading
import time
from contextlib import suppress
from pathlib import Path
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any, Final

import msgspec

from backend.config.environment import environment
from backend.core.logs import set_up
from backend.core.problems import StudioError
from backend.core.processes.numbers import BEAT, STARTED, read_page
from backend.core.processes.siblings import BEAT_EVERY_S
from backend.workers import frames
from backend.workers.priorities import make_pools

if TYPE_CHECKING:
    from collections.abc import Sequence
    from concurrent.futures import Future

    from backend.workers.pool import Pool
    from backend.workers.priorities import Pools

log = logging.getLogger(__name__)

STDIN: Final = 0
BACKLOG: Final = 64


def main(arguments: Sequence[str] | None = None) -> None:
    """Serves jobs until the parent ends."""
    parser = argparse.ArgumentParser(prog="python -m backend.workers.service", description=__doc__)
    parser.add_argument("--socket", type=Path, required=True, help="where web workers ask")
    parser.add_argument("--page", type=Path, required=True, help="where it reports that it is alive")
    options = parser.parse_args(arguments)
    set_up(environment().log_level, environment().log_style)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)  # its standard input closes when the parent ends
    pools = make_pools()
    threading.Thread(target=serve, args=(listening(options.socket), pools), daemon=True).start()
    threading.Thread(target=beat, args=(pools, read_page(options.page)), daemon=True).start()
    while os.read(STDIN, 1):
        pass


def beat(pool: Pools | Pool, page: memoryview[float]) -> None:
    """Reports periodically that the pool answers.

    It reads `waiting`, which takes the locks of `ask`; so the reports stop if `ask` hangs.
    """
    while True:
        _ = pool.waiting
        page[BEAT] = time.monotonic()
        page[STARTED] = 1
        time.sleep(BEAT_EVERY_S)


def listening(path: Path) -> socket.socket:
    """Returns a listening socket at this path, in a folder that only this user can access."""
    path.unlink(missing_ok=True)  # the socket of a killed predecessor
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(str(path))
    listener.listen(BACKLOG)
    return listener


def serve(listener: socket.socket, pool: Pools | Pool) -> None:
    """Serves all connections until the socket closes."""
    with suppress(OSError):
        while True:
            connection, _ = listener.accept()
            threading.Thread(target=_Asker(connection, pool).serve, daemon=True).start()


class _Asker:
    """The connection of one web worker: one thread reads its jobs, another one writes the answers."""

    def __init__(self, connection: socket.socket, pool: Pools | Pool) -> None:
        self._connection, self._pool = connection, pool
        self._answers: SimpleQueue[bytes | None] = SimpleQueue()

    def serve(self) -> None:
        """Serves one connection until the other side ends it."""
        threading.Thread(target=self._write, daemon=True).start()
        try:
            with suppress(frames.FrameError):
                while True:
                    self._take(msgspec.msgpack.decode(frames.receive(self._connection)))
        finally:
            self._answers.put(None)

    def _take(self, message: dict[str, Any]) -> None:
        number = message["number"]
        if "job" not in message:
            self._answers.put(frames.pack({"number": number, "result": self._pool.waiting}))
            return
        try:
            future = self._pool.ask(message["owner"], message["job"], **message["arguments"])
        except StudioError as error:
            self._answers.put(frames.pack({"number": number} | _told(error)))
        else:
            future.add_done_callback(lambda done: self._answers.put(_answer(number, done)))

    def _write(self) -> None:
        with self._connection, suppress(frames.FrameError):
            while (answer := self._answers.get()) is not None:
                frames.send(self._connection, answer)
                del answer  # it does not stay while the thread waits


def _answer(number: int, done: Future[Any]) -> bytes:
    error = done.exception()
    return frames.pack({"number": number} | ({"result": done.result()} if error is None else _told(error)))


def _told(error: BaseException) -> dict[str, Any]:
    """Returns an error as a message; the other side raises BT Studio's own errors again."""
    if isinstance(error, StudioError):
        return {"error": error.code, "detail": error.detail, "hint": error.hint}
    log.error("a job failed", exc_info=error)
    return {"error": "", "detail": "The work could not be done; this is a fault of BT Studio.", "hint": ""}


if __name__ == "__main__":
    main()
