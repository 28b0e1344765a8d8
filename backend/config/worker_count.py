"""The number of web workers, and the cases in which there can be only one."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from backend.config.server import ServeError
from backend.core.processes.memory import limit_mib

if TYPE_CHECKING:
    from backend.config.environment import Environment

CONNECTIONS: Final = 10
"""Connections to the database that one worker may hold: for request threads, launch threads and sockets."""
SPARE: Final = 10
"""Connections for the parent, a backup, the command line and a console."""


def judge_workers(settings: Environment) -> None:
    """Raises an error if several workers are configured, but only one is possible.

    Raises:
        ServeError: several workers are not possible; the text tells the reason and what to do.
    """
    if settings.workers <= 1 or settings.may_be_several:
        return
    remedy = "or leave --workers (BT_STUDIO_WORKERS) at 1."
    if not settings.is_team:
        raise ServeError(
            "Several workers are for a server with accounts: set BT_STUDIO_MODE=team "
            f"(docs/how-to/run-a-team-server.md), {remedy}"
        )
    if not settings.is_postgresql:
        raise ServeError(
            "Several workers need PostgreSQL, since SQLite lets one process write at a time: "
            f"set BT_STUDIO_DATABASE_URL=postgresql://…, {remedy}"
        )
    raise ServeError(
        "Several workers need executors in containers, since an executor that is a child of one worker "
        f"ends with it: set BT_STUDIO_LAUNCHER=docker, {remedy}"
    )


def workers_of(settings: Environment) -> int:
    """Returns the number of workers: the configured one, or as many as the machine and the database permit.

    Raises:
        ServeError: the database does not allow as many connections as needed.
    """
    if not settings.may_be_several or settings.workers == 1:
        return 1
    most = max(1, (admitted_connections(settings.database_url.get_secret_value()) - SPARE) // CONNECTIONS)
    if settings.workers > most:
        raise ServeError(
            f"{settings.workers} workers may need {settings.workers * CONNECTIONS + SPARE} connections to "
            f"the database, which admits enough for {most}: raise max_connections of PostgreSQL, or use "
            f"--workers {most}."
        )
    return settings.workers or min(settings.processes(cores(), limit_mib()).workers, most)


def too_little_memory(settings: Environment) -> str:
    """Returns a sentence if the processes may take more memory than the container has; else ""."""
    limit = limit_mib()
    needed = settings.processes(cores(), limit).needed_mib()
    if limit is None or needed <= limit:
        return ""
    return (
        f"This server's processes may take {needed} MiB of memory, but its container has {limit} MiB, and "
        "the kernel ends what exceeds it: raise its limit, or lower BT_STUDIO_WORKERS, "
        "BT_STUDIO_WORK_PROCESSES, BT_STUDIO_WORK_MEMORY_MIB or BT_STUDIO_MAX_UNREAD_BYTES."
    )


def admitted_connections(url: str) -> int:
    """Returns the number of connections that the database allows."""
    import psycopg  # noqa: PLC0415 - localhost does without

    with psycopg.connect(url, connect_timeout=5) as connection:
        row = connection.execute("SHOW max_connections").fetchone()
    return int(row[0]) if row else 0


def cores() -> int:
    """Returns the number of processors that this process may use."""
    return len(os.sched_getaffinity(0))
