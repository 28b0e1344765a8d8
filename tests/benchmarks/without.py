"""A web server without some of its fast paths: `python -m tests.benchmarks.without PIECE,… serve …`.

Each of them is replaced by the usual way of a Django project. `save_cost` measures the difference.
"""

from __future__ import annotations

import gc
import sys
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable


def one_write() -> None:
    """Writes by the ORM, as on SQLite."""
    from backend.projects.storage import at_once

    at_once.has_room = lambda writing: not writing


def one_read() -> None:
    """Reads and locks the project by the ORM."""
    from backend.projects.storage import at_once, rows

    at_once.locked = rows.locked


def room() -> None:
    """Sums the sizes of the owner's other projects by the ORM."""
    from backend.projects.storage import at_once

    at_once.taken_by_others = lambda project: None


def threads() -> None:
    """Python's thread pool, whose threads take turns."""
    from backend.ingress import handler

    handler.Threads = PlainThreads  # type: ignore[attr-defined, assignment]


class PlainThreads:
    """The interface of `Threads`."""

    def __init__(self, number: int, name: str, **_: object) -> None:
        self._pool = ThreadPoolExecutor(number, name)

    def run(
        self, loop: asyncio.AbstractEventLoop, work: Callable[[], Any], _: str | None = None
    ) -> asyncio.Future[Any]:
        """Runs the work in one of the threads."""
        return loop.run_in_executor(self._pool, work)

    def full_for_s(self) -> float:
        """Returns 0, since this pool does not measure it."""
        return 0.0

    stuck_for_s = full_for_s


def handler() -> None:
    """Django's ASGI handler: it makes a thread for each request, so connections cannot stay open."""
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

    cache.put = lambda *_: None


def lists() -> None:
    """Fetches the list of a project's files, each time."""
    from backend.projects.storage import cache

    cache.put_files = lambda *_: None


def prepared() -> None:
    """Makes PostgreSQL parse and plan each statement again, with the values in its text."""
    from django.db import connections

    options = connections.settings["default"]["OPTIONS"]
    for name in ("server_side_binding", "prepare_threshold"):
        options.pop(name, None)


def serializers() -> None:
    """Makes a serializer for each request, as DRF's documentation does."""
    from backend.accounts.api import requests

    requests._reader = lambda serializer: serializer()


def pages() -> None:
    """Adds Django's middleware for sessions, languages, users and messages to the API, too."""
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

    notify._teller.serve = lambda loop: None  # type: ignore[method-assign]
    notify.serve = notify._teller.serve


def frozen() -> None:
    """Makes the garbage collector scan all imported objects again and again."""
    gc.freeze = lambda: None


def switching() -> None:
    """Makes threads switch after 5 ms only."""
    from backend.config import server

    server.SWITCH_S = 0.005  # type: ignore[misc]


PIECES: dict[str, Callable[[], None]] = {
    piece.__name__: piece
    for piece in (
        one_write,
        one_read,
        room,
        own_projects,
        contents,
        lists,
        serializers,
        prepared,
        frozen,
        switching,
        pages,
        notices,
        threads,
        handler,
    )
}
ALL = "all"
NOT_IN_ALL = {"threads"}
"""Django's handler needs none."""


def leave_out(names: str) -> None:
    """Replaces the pieces, before the application is imported."""
    chosen = [name for name in names.split(",") if name not in {"", ALL}]
    if ALL in names.split(","):
        chosen = [name for name in PIECES if name not in NOT_IN_ALL]
    for name in chosen:
        PIECES[name]()


def main() -> None:
    """Serves without the named fast paths."""
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
