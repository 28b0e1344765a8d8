"""Leases: one web server does periodic work for all while it renews its lease, a row of the database.

A row and not a lock of the database: a lock is held as long as its connection, and a server that hangs, is
frozen with its machine, or has lost the network may keep that for hours. The row runs out by the clock of the
database, which is the same for all. A holder that was late does for a while what its successor does, too:
every chore is right when two do it at once; the lease only saves the work.

Where a server is alone with its database, or its executors are children that only it can look after, it has
every lease at once.
"""

from __future__ import annotations

import logging
import os
import socket
from contextlib import contextmanager
from secrets import token_hex
from typing import TYPE_CHECKING, Final

from django.db import connection

from backend.sessions.models import Lease
from backend.sessions.writes import launcher

if TYPE_CHECKING:
    from collections.abc import Iterator

log = logging.getLogger(__name__)

CARE: Final = "care"
"""The sessions: who has it looks after all of them, every few seconds."""
GARBAGE: Final = "garbage"
"""What nobody can reach any more, once a day."""
LONGEST_CHORE_S: Final = 1800.0

_TAKE: Final = """
    INSERT INTO {table} (name, owner, until) VALUES (%s, %s, clock_timestamp() + %s * interval '1 second')
    ON CONFLICT (name) DO UPDATE SET owner = excluded.owner, until = excluded.until
    WHERE {table}.until < clock_timestamp() OR ({table}.owner = excluded.owner AND %s)
    RETURNING 1
"""


class Holder:
    """One web server, or one of its workers, as stored in the database."""

    def __init__(self) -> None:
        self.name = f"{socket.gethostname()[:40]} {os.getpid()} {token_hex(8)}"

    def hold(self, name: str, seconds: float) -> bool:
        """Takes or renews a lease; returns False if another server has it."""
        return self._take(name, seconds, is_renewal=True)

    @contextmanager
    def chore(self, name: str, every_s: float) -> Iterator[bool]:
        """Yields whether this server must do a periodic task now, which only one of all servers does.

        If the task fails or the server ends, the next caller tries it again.
        """
        if not self._take(name, LONGEST_CHORE_S, is_renewal=False):
            yield False
            return
        try:
            yield True
        except BaseException:
            self.give_back(name)
            raise
        self._take(name, every_s, is_renewal=True)

    def give_back(self, name: str) -> None:
        """Releases the lease, so that the next server can take it immediately."""
        Lease.objects.filter(name=name, owner=self.name).delete()

    def _take(self, name: str, seconds: float, *, is_renewal: bool) -> bool:
        if is_alone():
            return True
        with connection.cursor() as cursor:
            cursor.execute(_TAKE.format(table=Lease._meta.db_table), [name, self.name, seconds, is_renewal])
            return cursor.fetchone() is not None


def is_alone() -> bool:
    """Whether no other server can do this server's work."""
    return connection.vendor != "postgresql" or not launcher().survives_server


holder: Final = Holder()
