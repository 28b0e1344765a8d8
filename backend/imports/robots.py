"""Looks at robots with macros for a check of the page: in the child of imports, never in the web server."""

from __future__ import annotations

import threading
from concurrent.futures import Future
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Final

import msgspec
from cachetools import LRUCache
from msgspec import Meta

from backend.core.processes.stops import Stop
from backend.core.scratch import scratch
from backend.imports.errors import NotLookedAtError
from backend.imports.runner import runner
from backend.projects.documents.export import write_zip
from backend.workers.aside import importing
from translator.diagnostic import Place, diagnostic

if TYPE_CHECKING:
    from backend.accounts.models import User
    from backend.imports.runner import Run
    from backend.projects.documents.checking import Robots

MOST_KNOWN: Final = 200
_MOST_FOUND: Final = 200


class _Found(msgspec.Struct):
    file: Annotated[str, Meta(max_length=1_000)]
    line: int
    message: Annotated[str, Meta(max_length=20_000)]


class _Answer(msgspec.Struct):
    findings: list[_Found]


class Known:
    """The findings about the robots that were looked at last, by their keys. All threads use it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._found: LRUCache[str, tuple[_Found, ...]] = LRUCache(MOST_KNOWN)

    def get(self, key: str) -> tuple[_Found, ...] | None:
        """Returns what was found; None if the robots were not looked at, or it is forgotten."""
        with self._lock:
            return self._found.get(key)

    def put(self, key: str, found: tuple[_Found, ...]) -> None:
        """Keeps what was found."""
        with self._lock:
            self._found[key] = found


_known: Final = Known()


def look(user: User, robots: Robots) -> Future[list[dict[str, Any]]]:
    """Returns the errors of the robots with macros of a project, once they are known.

    Args:
        user: in whose tools they are read.
        robots: their files.

    Returns:
        a future; it may raise `NotLookedAtError`, or an error of `scratch`.

    Raises:
        ImportUnavailableError: no process may read them here.
        BusyError: too many wait.
    """
    run = runner(user)
    found = _known.get(robots.key)
    if found is not None:
        known: Future[list[dict[str, Any]]] = Future()
        known.set_result(_told(found))
        return known
    return importing.ask(f"user {user.pk}", partial(_looked, robots, run))


def _looked(robots: Robots, run: Run) -> list[dict[str, Any]]:
    found = _known.get(robots.key)  # another request may have looked meanwhile
    if found is None:
        found = _asked(robots, run)
        _known.put(robots.key, found)
    return _told(found)


def _asked(robots: Robots, run: Run) -> tuple[_Found, ...]:
    with scratch().file() as file:
        write_zip(robots.items, file)
        file.seek(0)
        answer = run({"filename": "robots.zip", "kind": "check"}, file, Stop())
    try:
        found = msgspec.json.decode(answer, type=_Answer).findings
    except (msgspec.DecodeError, UnicodeError) as error:
        raise NotLookedAtError(
            "The robots with macros could not be looked at.", hint="Check the project again."
        ) from error
    return tuple(found[:_MOST_FOUND])


def _told(found: tuple[_Found, ...]) -> list[dict[str, Any]]:
    return [
        diagnostic("BT0916", Place(item.file, line=item.line), problem=item.message).to_json()
        for item in found
    ]
