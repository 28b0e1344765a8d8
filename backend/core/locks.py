"""Named locks among all web servers of one database. They last until the end of the transaction.

On SQLite these functions do nothing: a writing transaction is exclusive from its beginning (`IMMEDIATE`).
"""

from __future__ import annotations

import hashlib

from django.db import connection


def transaction_lock(name: str, *, shared: bool = False) -> None:
    """Waits until no other transaction holds the lock, and takes it.

    Several transactions can hold it `shared`.
    """
    if connection.vendor != "postgresql":
        return
    function = "pg_advisory_xact_lock_shared" if shared else "pg_advisory_xact_lock"
    with connection.cursor() as cursor:
        cursor.execute(f"SELECT {function}(%s)", [lock_number(name)])


def lock_number(name: str) -> int:
    """Returns the number of a lock; PostgreSQL identifies advisory locks by numbers."""
    return int.from_bytes(hashlib.sha256(name.encode()).digest()[:8], signed=True)
