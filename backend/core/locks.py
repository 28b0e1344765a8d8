"""Locks by name that last until the end of a transaction, among all web servers of one database.

On SQLite a transaction that writes is alone from its beginning (`IMMEDIATE`), so that nothing is to be done.
"""

from __future__ import annotations

import hashlib

from django.db import connection


def transaction_lock(name: str, *, shared: bool = False) -> None:
    """Waits until no other transaction holds the lock; shared holders do not exclude each other."""
    if connection.vendor != "postgresql":
        return
    function = "pg_advisory_xact_lock_shared" if shared else "pg_advisory_xact_lock"
    with connection.cursor() as cursor:
        cursor.execute(f"SELECT {function}(%s)", [lock_number(name)])


def lock_number(name: str) -> int:
    """The number under which PostgreSQL knows the lock."""
    return int.from_bytes(hashlib.sha256(name.encode()).digest()[:8], signed=True)
