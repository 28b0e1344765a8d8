"""Tests with Python, of which each waits for a place: the next one goes to the user who holds the fewest."""

from __future__ import annotations

import threading
from concurrent.futures import Future
from contextlib import suppress
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from django.db import connection

from backend.config.environment import environment
from backend.core.processes.fair_places import Share, testers
from backend.language.errors import NoTestsError, TestsEndedError
from backend.workers.errors import BusyError

if TYPE_CHECKING:
    from collections.abc import Callable
    from uuid import UUID

    from backend.accounts.models import User
    from backend.core.processes.fair_places import Ticket, Turn
    from backend.core.processes.stops import Stop

POLL_S: Final = 0.5
MOST_WAITING: Final = 32
"""The number of tests of all users that wait in one web worker."""


class _Tests(NamedTuple):
    ticket: Ticket
    work: Callable[[], Any]
    stop: Stop
    future: Future[Any]


class InTurn:
    """The tests of this process: one thread watches them, and starts one for each place."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._changed = threading.Event()
        self._waiting: list[_Tests] = []
        self._running: list[_Tests] = []
        self._watcher: threading.Thread | None = None

    def ask(self, user: User, project_id: UUID, work: Callable[[], Any], stop: Stop) -> Future[Any]:
        """Runs the tests of a project for a user as soon as it is their turn.

        To cancel what is returned withdraws the tests until then. If the user ends them, it fails with
        TestsEndedError.

        Args:
            user: the user.
            project_id: the project.
            work: runs the tests.
            stop: ends them while they run.

        Raises:
            BusyError: so many wait already, of this user or of all.
        """
        ticket = testers.enter(str(user.pk), _share(), about=str(project_id), is_exempt=user.is_exempt)
        with self._lock:
            is_full = len(self._waiting) >= MOST_WAITING
            if ticket is not None and not is_full:
                future: Future[Any] = Future()
                future.add_done_callback(lambda _: self._changed.set())
                self._waiting.append(_Tests(ticket, work, stop, future))
                if self._watcher is None:
                    self._watcher = threading.Thread(target=self._watch, name="tests", daemon=True)
                    self._watcher.start()
                self._changed.set()
                return future
        if ticket is not None:
            ticket.give_back()
        raise BusyError(
            "So many of your tests with Python run or wait already, or of all users.",
            hint="Try again in a few seconds.",
        )

    def look(self) -> None:
        """Looks at once whether tests may start or were ended."""
        self._changed.set()

    def _watch(self) -> None:
        while True:
            # Places that other workers give back, and tests that are ended there, are seen by asking.
            self._changed.wait(POLL_S if self._waiting or self._running else None)
            self._changed.clear()
            for each in list(self._waiting):
                self._start(each)
            for each in list(self._running):
                self._end(each)

    def _end(self, running: _Tests) -> None:
        """Ends one that runs, if its user wants that."""
        with suppress(Exception):  # such as that the disk of the board is full; the others still run
            if running.ticket.is_ended():
                # It may wait for a socket; the other tests must not.
                threading.Thread(target=running.stop.set, name="ends a test", daemon=True).start()
                self._running.remove(running)

    def _start(self, waiting: _Tests) -> None:
        """Starts one that waits, if it has its place; one whose client has left gives its place back."""
        error: Exception | None = None
        try:
            if not waiting.future.cancelled() and waiting.ticket.turn() is not None:
                return
            if waiting.ticket.is_ended():
                error = _ended()
        except Exception as raised:  # such as that the disk of the board is full; the others still wait
            error = raised
        with self._lock:
            self._waiting.remove(waiting)
        is_wanted = waiting.future.set_running_or_notify_cancel()
        if is_wanted and error is None:
            self._running.append(waiting)
            try:
                threading.Thread(target=self._run, args=(waiting,), name="test", daemon=True).start()
            except RuntimeError as raised:  # no thread can be started
                error = raised
                self._running.remove(waiting)
            else:
                return
        with suppress(Exception):
            waiting.ticket.give_back()
        if is_wanted:
            waiting.future.set_exception(error)

    def _run(self, running: _Tests) -> None:
        error: BaseException | None = None
        result = None
        try:
            result = running.work()
        except BaseException as raised:  # the waiting caller gets the error
            error = raised
        connection.close()
        with suppress(Exception):  # such as that the disk of the board is full; the caller gets its result
            if error is not None and running.ticket.is_ended():
                error = _ended()
            running.ticket.give_back()
        with suppress(ValueError):  # it was ended
            self._running.remove(running)
        self._changed.set()
        if error is None:
            running.future.set_result(result)
        else:
            running.future.set_exception(error)


def turn_of(user: User, project_id: UUID) -> Turn | None:
    """Returns the turn of the user's tests of a project that wait; None if none wait."""
    return testers.turn_of(str(user.pk), _share(), about=str(project_id))


def end_tests(user: User, project_id: UUID) -> None:
    """Ends the user's tests of a project that wait or run, in all workers.

    Raises:
        NoTestsError: there are none.
    """
    if not testers.end(str(user.pk), about=str(project_id)):
        raise NoTestsError(
            "None of your tests of this project waits or runs.", hint="They may have ended meanwhile."
        )
    python_tests().look()


def _ended() -> TestsEndedError:
    return TestsEndedError("You have ended these tests.", hint="Run them again when you want their results.")


def _share() -> Share:
    limits = environment()
    return Share(
        limits.max_tests,
        limits.of_one_user(limits.max_user_tests),
        limits.of_one_user(limits.max_user_waiting),
    )


@lru_cache(maxsize=1)
def python_tests() -> InTurn:
    """Returns the tests of this process."""
    return InTurn()
