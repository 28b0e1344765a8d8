"""A web server without some of its fast pieces: `python -m tests.benchmarks.without PIECE,… serve …`.

Each piece is replaced by what a Django project has of itself. `save_cost` measures what that costs.
"""

from __future__ import annotations

import gc
import sys
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable


def one_statement() -> None:
    """Writes row by row, in the same hand-written SQL."""
    from backend.projects.storage import rows

    rows.AT_ONCE = -1


def sql_writes() -> None:
    """Writes by the ORM."""
    from backend.projects.storage import rows
    from tests.benchmarks import orm_rows

    rows.write, rows.forget_drafts = orm_rows.write, orm_rows.forget_drafts


def sql_reads() -> None:
    """Reads the project and its files by the ORM."""
    from backend.projects.storage import rows
    from tests.benchmarks import orm_rows

    rows.project, rows.existing = orm_rows.project, orm_rows.existing
    rows.root_trees, rows.taken_by_others = orm_rows.root_trees, orm_rows.taken_by_others


def sessions() -> None:
    """Reads the session by Django's `cached_db`, and the user by the ORM."""
    from backend.accounts import identity

    def remember(key: str, user: Any, _: object) -> None:
        # Which thread a request waits for depends on its user: that is no matter of speed.
        identity._known[key] = identity._Known("", user.pk, "", frozenset())

    identity._known_user = lambda _: None  # type: ignore[assignment]
    identity._remember = remember


def sessions_of_database() -> None:
    """Reads the session by Django's `db`."""
    from django.conf import settings

    settings.SESSION_ENGINE = "django.contrib.sessions.backends.db"
    sessions()


def threads() -> None:
    """Python's thread pool, whose threads take turns."""
    from backend.ingress import handler

    handler.Threads = PlainThreads  # type: ignore[assignment, misc]


class PlainThreads:
    """The interface of `Threads`."""

    def __init__(self, number: int, name: str, **_: object) -> None:
        self._pool = ThreadPoolExecutor(number, name)

    def run(
        self, loop: asyncio.AbstractEventLoop, work: Callable[[], Any], _: str | None = None
    ) -> asyncio.Future[Any]:
        """Does the work in one of them."""
        return loop.run_in_executor(self._pool, work)

    def full_for_s(self) -> float:
        """Nobody knows."""
        return 0.0

    stuck_for_s = full_for_s


def handler() -> None:
    """Django's ASGI handler: it makes a thread for each request, so that connections cannot stay."""
    from django.core.handlers.asgi import ASGIHandler
    from django.db import connections

    from backend.core.processes.threads import Threads
    from backend.ingress import handler as ours

    class DjangosHandler(ASGIHandler):
        def __init__(self, _: object = None) -> None:
            super().__init__()
            self.threads = Threads(1, "unused")

    connections.settings["default"]["CONN_MAX_AGE"] = 0
    ours.ThreadedHandler = DjangosHandler  # type: ignore[assignment, misc]


def contents() -> None:
    """Fetches all contents that a check needs, each time."""
    from backend.projects.storage import cache

    cache._kept.get = lambda _: {}  # type: ignore[assignment, method-assign]


def lists() -> None:
    """Fetches the list of a project's files, each time."""
    from backend.projects.storage import cache

    cache.files = lambda _: None  # type: ignore[assignment, misc]
    cache.put_files = lambda *_: None  # type: ignore[misc]


def own_caches() -> None:
    """The caches of contents and lists by `cachetools`."""
    from threading import Lock

    from cachetools import LRUCache

    from backend.projects.storage import cache

    lock = Lock()
    known: LRUCache[str, bytes] = LRUCache(cache.ROOM, getsizeof=len)
    of_projects: LRUCache[Any, Any] = LRUCache(cache.FILES, getsizeof=lambda one: len(one[2]))

    def put(sha256: str, data: bytes) -> None:
        if len(data) <= cache.LARGEST:
            with lock:
                known[sha256] = data

    def get(wanted: Any) -> dict[str, bytes]:
        with lock:
            return {sha256: known[sha256] for sha256 in wanted if sha256 in known}

    def put_files(project: Any, files: Any) -> None:
        with lock:
            of_projects[project.pk] = (project.revision, project.updated_at, files)

    def files(project: Any) -> dict[str, Any] | None:
        with lock:
            revision, at, found = of_projects.get(project.pk, (0, None, {}))
        return dict(found) if (revision, at) == (project.revision, project.updated_at) else None

    cache._kept.get, cache._kept.put = get, put  # type: ignore[method-assign]
    cache.put, cache.files, cache.put_files = put, files, put_files  # type: ignore[assignment, misc]


def prepared() -> None:
    """PostgreSQL reads and plans each statement again, and psycopg puts the values into its text."""
    from django.db import connections

    options = connections.settings["default"]["OPTIONS"]
    for name in ("server_side_binding", "prepare_threshold"):
        options.pop(name, None)


def serializers() -> None:
    """Makes a serializer for each request, as DRF's documentation does."""
    from backend.accounts.api import requests

    requests._reader = lambda serializer: serializer()  # type: ignore[assignment]


def pages() -> None:
    """Django's middleware for sessions, languages, users and messages, for the API as well."""
    from backend.accounts.sign_in.middleware import OnPages

    OnPages.__call__ = lambda self, request: super(OnPages, self).__call__(request)  # type: ignore[method-assign, misc]


def own_projects() -> None:
    """Asks the database for the role of a project's owner, too."""
    from backend.projects.models import Project
    from backend.projects.storage import access

    def find_role(project: Project, user: Any) -> None:
        found = access.with_role(Project.objects.filter(pk=project.pk), user).select_related("owner").get()
        project.owner, project.rank = found.owner, found.rank  # type: ignore[attr-defined]

    access.find_role = find_role


def notices() -> None:
    """Sends the notice of a save in the request's thread, with an event loop of its own."""
    from backend.core import notify

    notify._teller.serve = lambda _: None  # type: ignore[method-assign]
    notify.serve = notify._teller.serve  # type: ignore[misc]


def frozen() -> None:
    """The garbage collector looks through all that was imported, again and again."""
    gc.freeze = lambda: None


def switching() -> None:
    """Threads give way after 5 ms."""
    from backend.config import server

    server.SWITCH_S = 0.005  # type: ignore[misc]


PIECES: dict[str, Callable[[], None]] = {
    piece.__name__: piece
    for piece in (
        one_statement,
        sql_writes,
        sql_reads,
        sessions,
        sessions_of_database,
        threads,
        handler,
        contents,
        lists,
        own_caches,
        prepared,
        serializers,
        pages,
        own_projects,
        notices,
        frozen,
        switching,
    )
}
ALL = "all"
NOT_IN_ALL = {"one_statement", "sessions_of_database", "threads", "own_caches"}
"""Others replace the same place."""


def leave_out(names: str) -> None:
    """Replaces the pieces, before the application is imported."""
    chosen = [name for name in names.split(",") if name not in {"", ALL}]
    if ALL in names.split(","):
        chosen = [name for name in PIECES if name not in NOT_IN_ALL]
    for name in chosen:
        PIECES[name]()


def main() -> None:
    """Serves."""
    names = sys.argv.pop(1)
    from backend.config import server

    run = server.run

    def run_without(*arguments: Any, **options: Any) -> None:
        leave_out(names)
        run(*arguments, **options)

    server.run = run_without
    from backend.cli.main import main as serve

    serve()


if __name__ == "__main__":
    main()
