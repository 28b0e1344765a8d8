"""Named locks that this process holds for as long as it needs, all on one connection to the database.

A lock of PostgreSQL is held by a connection. Work that takes seconds would need a connection of its own only
to hold its lock, and sixty robots that start would take more connections than the server has. When this
process ends in any way, its connection ends with it, and others get the locks.

On SQLite, with one server, nothing is locked.
"""

from __future__ import annotations

import logging
import time
from contextlib import contextmanager
from threading import Lock
from typing import TYPE_CHECKING, Final

from django.db import DatabaseError, connection

from backend.core.locks import lock_number

if TYPE_CHECKING:
    from collections.abc import Iterator

    from django.db.backends.base.base import BaseDatabaseWrapper

__all__ = ["Holder", "held_by_process"]

log = logging.getLogger(__name__)

_PAUSE_S: Final = 0.05
_TAKE: Final = "SELECT pg_try_advisory_lock(%s)"
_RELEASE: Final = "SELECT pg_advisory_unlock(%s)"


class Holder:
    """The connection that holds the locks, if there are any; threads use it in turn, and never for long."""

    def __init__(self) -> None:
        self._turn = Lock()
        self._connection: BaseDatabaseWrapper | None = None
        self._held = 0

    def take(self, name: str) -> bool:
        """Takes a lock; returns False if another process holds it."""
        with self._turn:
            try:
                is_taken = self._ask(_TAKE, name)
            except DatabaseError as error:
                log.warning("the connection of the locks was lost, with all of them: %s", error)
                self._drop()
                is_taken = self._ask(_TAKE, name)
            self._held += is_taken
            if not self._held:
                self._drop()
            return is_taken

    def release(self, name: str) -> None:
        """Releases a lock; one that was lost with its connection is released already."""
        with self._turn:
            self._held -= 1
            try:
                self._ask(_RELEASE, name)
            except DatabaseError as error:
                log.warning("the lock “%s” went with its connection: %s", name, error)
                self._drop()
            if not self._held:
                self._drop()

    def _ask(self, statement: str, name: str) -> bool:
        if self._connection is None:
            self._connection = connection.copy()
            self._connection.inc_thread_sharing()
        with self._connection.cursor() as cursor:
            cursor.execute(statement, [lock_number(name)])
            return bool(cursor.fetchone()[0])

    def _drop(self) -> None:
        broken, self._connection = self._connection, None
        if broken is not None:
            broken.close()


holder: Final = Holder()


@contextmanager
def held_by_process(name: str) -> Iterator[None]:
    """Holds a lock; waits until no other process or transaction holds it.

    It excludes a `transaction_lock` of the same name, and is for one thread of this process at a time.

    Raises:
        DatabaseError: the database does not answer.
    """
    if connection.vendor != "postgresql":
        yield
        return
    while not holder.take(name):
        time.sleep(_PAUSE_S)
    try:
        yield
    finally:
        holder.release(name)
