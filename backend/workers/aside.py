"""Threads for work that does not suit the pool of processes, so that no request thread waits for it.

The pool is for work that computes in Python. Unpacking a zip needs more memory than a worker may have, and
zlib releases the interpreter lock. For a formatter in a container, a thread only has to wait.
"""

from __future__ import annotations

import threading
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from django.db import connection

from backend.core.processes.fair import FairQueue, QueueFullError
from backend.workers.errors import BusyError

if TYPE_CHECKING:
    from collections.abc import Callable


class _Task(NamedTuple):
    work: Callable[[], Any]
    future: Future[Any]


class Aside:
    """A few threads that users share in turn; each user has a limited number.

    Args:
        name: the prefix of the threads' names.
        threads: the number of threads; they start with the first work.
        per_owner: the number of threads that may work for one owner at the same time.
        waiting: the number of calls that may wait.
    """

    def __init__(self, name: str, threads: int, per_owner: int, waiting: int) -> None:
        self._name, self._number = name, threads
        self._changed = threading.Condition()
        self._queue: FairQueue[_Task] = FairQueue(room=waiting, per_owner=per_owner)
        self._threads: list[threading.Thread] = []

    def ask(self, owner: str, work: Callable[[], Any]) -> Future[Any]:
        """Runs the work on the next free thread.

        Raises:
            BusyError: too many calls wait.
        """
        task = _Task(work, Future())
        with self._changed:
            try:
                self._queue.put(owner, task)
            except QueueFullError:
                raise BusyError(
                    "The server has too much of this to do at the moment.",
                    hint="Try again in a few seconds.",
                ) from None
            if len(self._threads) < self._number:
                thread = threading.Thread(target=self._serve, name=self._name, daemon=True)
                self._threads.append(thread)
                thread.start()
            self._changed.notify()
        return task.future

    def _serve(self) -> None:
        while True:
            owner, task = self._taken()
            result, error = None, None
            try:
                result = task.work()
            except BaseException as raised:  # the waiting caller gets the error
                error = raised
            finally:
                connection.close()
            with self._changed:
                self._queue.done(owner)
                self._changed.notify()
            if error is None:
                task.future.set_result(result)
            else:
                task.future.set_exception(error)
            del task, result, error  # the request's files are closed with the request

    def _taken(self) -> tuple[str, _Task]:
        with self._changed:
            while (found := self._queue.take()) is None:
                self._changed.wait()
            return found


unpacking: Final = Aside("unpacking", threads=2, per_owner=1, waiting=8)
packing: Final = Aside("packing", threads=2, per_owner=1, waiting=16)
conversions: Final = Aside("conversions", threads=2, per_owner=1, waiting=8)
importing: Final = Aside("importing", threads=2, per_owner=1, waiting=8)
pulls: Final = Aside("pulls", threads=4, per_owner=1, waiting=64)
sweeps: Final = Aside("sweeps", threads=1, per_owner=1, waiting=1)
checkers: Final = Aside("checkers", threads=4, per_owner=2, waiting=32)
