"""Empties the database after a test that committed, at a fraction of the cost of Django's `flush`.

`flush` deletes from all tables, then makes the rows again that migrations make. Here tables with rows of the
test are emptied, and the others are left alone.
"""

from __future__ import annotations

from functools import cache
from typing import Any

from django.core.management import call_command
from django.db import connection, transaction
from django.db.backends.signals import connection_created
from django.test import testcases


@cache
def kept_rows() -> dict[str, int]:
    """The number of rows that migrations made in each table; it must be called before the first test."""
    return rows()


def rows() -> dict[str, int]:
    """Returns the number of rows of each table that has any."""
    names = _tables()
    quoted = (f"SELECT '{name}', count(*) FROM {connection.ops.quote_name(name)}" for name in names)  # noqa: S608
    with connection.cursor() as cursor:
        cursor.execute(" UNION ALL ".join(quoted))
        return {name: number for name, number in cursor.fetchall() if number}


@cache
def _tables() -> tuple[str, ...]:
    return tuple(connection.introspection.django_table_names(only_existing=True, include_views=False))


def empty() -> bool:
    """Empties the tables, except those with rows of migrations; returns whether these are as they were."""
    kept, found = kept_rows(), rows()
    if any(found.get(name) != number for name, number in kept.items()):
        return False
    with transaction.atomic(), connection.cursor() as cursor:
        for name in found.keys() - kept.keys():
            cursor.execute(f"DELETE FROM {connection.ops.quote_name(name)}")  # noqa: S608
    return True


def write_without_waiting(*, connection: Any, **_: Any) -> None:
    """Turns SQLite's waits for the disk off: a database of tests does not outlive the machine's failure."""
    if connection.vendor == "sqlite":
        with connection.cursor() as cursor:
            cursor.execute("PRAGMA synchronous = OFF")


def begin() -> None:
    """Makes Django's test cases use `empty`, which call `flush` after each test that commits."""
    kept_rows()
    connection_created.connect(write_without_waiting)
    connection.close()  # the next one does not wait

    def called(name: str, *arguments: Any, **options: Any) -> Any:
        if name != "flush" or not empty():
            call_command(name, *arguments, **options)

    testcases.call_command = called  # type: ignore[attr-defined]
