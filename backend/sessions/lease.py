"""Leases: one web server does periodic work for all while it renews its lease, a row of the database.

The lease is a row and not a lock of the database: a lock is held as long as its connection lasts, and a
server that hangs, is frozen with its machine, or has lost the network may keep its connection for hours. The
row expires by the clock of the database, which is the same for all servers. If a holder is late, it and its
successor may do the same work for a while. Every task is correct even if two servers do it at the same time;
the lease only saves work.

A server that is the only one of its database, or whose executors are its own child processes, always has
every lease.
"""

from __future__ import annotations

import logging
import os
import socket
from contextlib import contextmanager
from secrets import token_hex
from typing import TYPE_CHECKING, Final

from django.db import connection

from backend.sessions.lifecycle.writes import launcher
from backend.sessions.models import Lease

if TYPE_CHECKING:
    from collections.abc import Iterator

log = logging.getLogger(__name__)

CARE: Final = "care"
"""The name of the lease for the maintenance of all sessions, every few seconds."""
GARBAGE: Final = "garbage"
"""The name of the lease for removing data that can no longer be reached, once a day."""
LONGEST_CHORE_S: Final = 1800.0

_TAKE: Final = """
    INSERT INTO {table} (name, owner, until) VALUES (%s, %s, clock_timestamp() + %s * interval '1 second')
    ON CONFLICT (name) DO UPDATE SET owner = excluded.owner, until = excluded.until
    WHERE {table}.until < clock_timestamp() OR ({table}.owner = excluded.owner AND %s)
    RETURNING 1
"""


class Holder:
    """One web server, or one of its workers, as a holder of leases in the database."""

    def __init__(self) -> None:
        self.name = f"{socket.gethostname()[:40]} {os.getpid()} {token_hex(8)}"

    def hold(self, name: str, seconds: float) -> bool:
        """Takes or renews a lease; returns False if another server has it."""
        return self._take(name, seconds, is_renewal=True)

    @contextmanager
    def chore(self, name: str, every_s: float) -> Iterator[bool]:
        """Yields whether this server must do a periodic task now; only one of all servers does it.

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
    """Returns whether no other server can do the work of this one."""
    return connection.vendor != "postgresql" or not launcher().survives_server


holder: Final = Holder()
