"""A fixed pool of threads, in which the idle thread that worked last gets the next call.

The caches of this thread are still warm: its connection to the database, and the PostgreSQL process with
prepared statements. In `ThreadPoolExecutor` the threads take turns, so each of them starts cold. Owners do
take turns, and each has a limited number of threads, so that the others find a free one.
"""

from __future__ import annotations

import atexit
import itertools
import sys
import threading
import time
from contextlib import suppress
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from backend.core.processes.fair import FairQueue

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable

    Job = Callable[[], Callable[[], None]]
    """A function that does the work, and returns the function that reports its end."""

PATIENCE_S: Final = 5.0
"""Seconds for which the end of the program waits for each thread that still works."""


class _Task(NamedTuple):
    owner: str
    job: Job


Inbox = SimpleQueue[_Task | None]


class Threads:
    """Threads that call blocking functions for coroutines.

    Args:
        number: the number of threads.
        name: the prefix of their names.
        per_owner: the number of threads that may work for one owner at the same time; None means all threads.
    """

    def __init__(self, number: int, name: str, *, per_owner: int | None = None) -> None:
        self._number, self._name = number, name
        self._per_owner = per_owner or number
        self._lock = threading.Lock()
        self._idle: list[Inbox] = []
        self._waiting = self._empty()
        self._nobody = itertools.count()
        self._threads: dict[threading.Thread, Inbox] = {}
        self._full_since_s: float | None = None
        self._progress_s = 0.0
        atexit.register(self.end)

    def run(
        self, loop: asyncio.AbstractEventLoop, work: Callable[[], Any], owner: str | None = None
    ) -> asyncio.Future[Any]:
        """Makes a thread call the function as soon as one is free; returns a future of the loop.

        Args:
            loop: the loop of the coroutine that waits.
            work: the function to call.
            owner: the owner, whose number of threads is limited. Without an owner, nothing limits the call.
        """
        future = loop.create_future()

        def job() -> Callable[[], None]:
            try:
                result, error = work(), None
            except BaseException as raised:  # the waiting caller gets it
                result, error = None, raised
            return lambda: _tell(loop, future, result, error)

        self._hand_out(f"#{next(self._nobody)}" if owner is None else owner, job)
        return future

    def full_for_s(self) -> float:
        """Returns the seconds for which no thread has been free."""
        with self._lock:
            return 0.0 if self._full_since_s is None else time.monotonic() - self._full_since_s

    def stuck_for_s(self) -> float:
        """Returns the seconds for which no thread has been free or has finished a call."""
        with self._lock:
            if self._full_since_s is None:
                return 0.0
            return time.monotonic() - max(self._full_since_s, self._progress_s)

    def end(self) -> None:
        """Waits for the running calls, each for at most `PATIENCE_S`."""
        with self._lock:
            threads, self._threads = self._threads, {}
            self._waiting = self._empty()
        for inbox in threads.values():
            inbox.put(None)
        for thread in threads:
            thread.join(PATIENCE_S)
        atexit.unregister(self.end)

    def _empty(self) -> FairQueue[Job]:
        return FairQueue(room=sys.maxsize, per_owner=self._per_owner)

    def _hand_out(self, owner: str, job: Job) -> None:
        with self._lock:
            self._waiting.put(owner, job)
            is_one_free = self._idle or len(self._threads) < self._number
            if not is_one_free or (taken := self._waiting.take()) is None:
                return
            inbox = self._idle.pop() if self._idle else self._begin_thread()
            if not self._idle and len(self._threads) == self._number:
                self._full_since_s = time.monotonic()
        inbox.put(_Task(*taken))

    def _begin_thread(self) -> Inbox:
        inbox: Inbox = SimpleQueue()
        name = f"{self._name}_{len(self._threads)}"
        thread = threading.Thread(target=self._work, args=(inbox,), name=name, daemon=True)
        self._threads[thread] = inbox
        thread.start()
        return inbox

    def _work(self, inbox: Inbox) -> None:
        while (following := inbox.get()) is not None:
            while following is not None:
                done, tell = following.owner, following.job()
                following = self._next(inbox, done)  # before `tell`, whose receiver then finds an idle thread
                tell()
                del tell  # nothing of a request and its answer stays with a thread that waits

    def _next(self, inbox: Inbox, done: str) -> _Task | None:
        """Returns the next call that may begin.

        If there is none, counts this thread as idle and returns None.
        """
        with self._lock:
            self._progress_s = time.monotonic()
            self._waiting.done(done)
            if (taken := self._waiting.take()) is not None:
                return _Task(*taken)
            self._idle.append(inbox)
            self._full_since_s = None
            return None


def _tell(
    loop: asyncio.AbstractEventLoop, future: asyncio.Future[Any], result: Any, error: BaseException | None
) -> None:
    # If the loop has ended, nobody waits for the result.
    with suppress(RuntimeError):
        loop.call_soon_threadsafe(_settle, future, result, error)


def _settle(future: asyncio.Future[Any], result: Any, error: BaseException | None) -> None:
    if future.cancelled():
        return
    if error is None:
        future.set_result(result)
    else:
        future.set_exception(error)
