"""Prepares statements again whose columns a newer web server has changed meanwhile.

PostgreSQL refuses a prepared statement when a migration has changed the type of a column that it returns
("cached plan must not change result type"), as long as its connection lasts. During a rolling upgrade the
servers of the release before would answer 500 for minutes. A new connection knows nothing of the old plans.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from django.db import NotSupportedError, OperationalError
from django.db.backends.signals import connection_created

if TYPE_CHECKING:
    from collections.abc import Callable

    from django.db.backends.base.base import BaseDatabaseWrapper

__all__ = ["watch_plans"]

_STALE: Final = "cached plan must not change result type"


def watch_plans() -> None:
    """Watches the statements of each connection to PostgreSQL."""
    connection_created.connect(_watch, dispatch_uid="stale_plans")


def _watch(sender: object, *, connection: BaseDatabaseWrapper, **_: object) -> None:
    if connection.vendor == "postgresql" and _executed not in connection.execute_wrappers:
        connection.execute_wrappers.append(_executed)


def _executed(
    execute: Callable[..., Any],
    sql: str,
    params: Any,
    many: bool,  # noqa: FBT001 - the signature of Django's wrappers
    context: dict[str, Any],
) -> Any:
    """Executes a statement; a stale one is executed again on a new connection.

    Raises:
        OperationalError: it is part of a transaction, which was rolled back and may be tried again.
    """
    try:
        return execute(sql, params, many, context)
    except NotSupportedError as error:
        if _STALE not in str(error):
            raise
        connection, cursor = context["connection"], context["cursor"]
        if connection.in_atomic_block:
            connection.close_at = 0.0  # it is closed before the next request
            raise OperationalError("the tables were changed meanwhile") from error
        connection.close()
        connection.ensure_connection()
        cursor.cursor = connection.create_cursor()
        return execute(sql, params, many, context)
