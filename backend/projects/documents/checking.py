"""Passes jobs about projects to the pool of processes, and answers requests with the results."""

from __future__ import annotations

import hashlib
import logging
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any, Final, NamedTuple, NoReturn

from backend.accounts.api.requests import user_of
from backend.accounts.audit import client_address
from backend.config.environment import REPOSITORY
from backend.core.problems import StudioError
from backend.core.readers import release
from backend.projects.errors import CheckFailedError, QuotaExceededError
from backend.projects.storage import names, queries
from backend.workers.deferred import Deferred
from backend.workers.priorities import pool

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request
    from rest_framework.response import Response
    from rest_framework.views import APIView

    from backend.accounts.models import User
    from backend.projects.models import Project
    from backend.projects.storage.changes import Existing

    Look = Callable[[User, "Robots"], Future[list[dict[str, Any]]]]

log = logging.getLogger(__name__)

UNIVERSES: Final = REPOSITORY / "executor" / "universes"
CHECKED: Final = ("project.json", "enums.json", "trees/", "actions/", "imports/", "universes/", "tests/")
"""Beginnings of the paths of the files that a check reads; that others exist is enough."""
MOST_CHECKED: Final = 48 * 1024 * 1024
"""Bytes of trees and Python that a check reads: as many as trees may have, and half as many of Python."""
ROBOTS: Final = ("robots/", "assets/")
"""Beginnings of the paths of the files that a robot may name."""
NOT_LOOKED_AT: Final = "BT0915"
"""The code of the note that a robot with macros is not looked at."""
_lookers: Final[list[Look]] = []


class Robots(NamedTuple):
    """The robots of a project.

    Attributes:
        key: is equal for equal files.
        items: the files that a robot may name: paths, and stored files or unsaved contents. They are of the
            same state as the key, whatever is saved meanwhile.
    """

    key: str
    items: Sequence[tuple[str, Existing | bytes]]


def robots_of(project: Project, typed: Mapping[str, bytes]) -> Robots:
    """Returns the robots of a project as they would be with unsaved files."""
    now: dict[str, Existing | bytes] = {**queries.existing_files(project), **typed}
    items = [
        (path, now[path]) for path in sorted(now) if path.startswith(ROBOTS) and not names.is_of_tool(path)
    ]
    hashes = [
        (path, hashlib.sha256(file).hexdigest() if isinstance(file, bytes) else file.sha256)
        for path, file in items
    ]
    return Robots(hashlib.sha256(repr(hashes).encode()).hexdigest(), items)


def look_at_robots_by(look: Look) -> None:
    """Takes the function that looks at robots with macros; it is of a higher layer."""
    _lookers[:] = [look]


def files_of(project: Project) -> dict[str, bytes]:
    """Returns the files of a project as a check needs them.

    Raises:
        QuotaExceededError: they are too large to be checked.
    """
    listed = queries.existing_files(project).items()
    require_checkable(file.size for path, file in listed if path.startswith(CHECKED))
    return queries.contents(project, CHECKED)


def require_checkable(sizes: Iterable[int]) -> None:
    """Raises QuotaExceededError if files are too large to be checked with every save."""
    if sum(sizes) > MOST_CHECKED:
        raise QuotaExceededError(
            f"Its trees and Python are larger than the {MOST_CHECKED:,} bytes that are checked.",
            hint="Remove what it does not need.",
        )


def answered(
    view: APIView, request: Request, job: str, make: Callable[[Any], HttpResponseBase], **arguments: Any
) -> Deferred:
    """Answers a request with the response that `make` returns for the result of a job.

    Raises:
        BusyError: too many jobs wait already.
    """
    work = pool().ask(owner(request), job, **arguments)
    if "files" in arguments:
        release()  # the pool has packed them
    return Deferred(view, request, work, lambda done: make(accepted(done.result())))


def tested(
    view: APIView,
    request: Request,
    files: Mapping[str, bytes],
    make: Callable[[Any], HttpResponseBase],
    *,
    with_job: bool,
) -> Deferred:
    """Answers a request with the results of a project's behaviour tests, and with their job if wanted.

    Raises:
        BusyError: too many jobs wait already.
    """
    kept = {path: data for path, data in files.items() if path.startswith(CHECKED)}
    return answered(view, request, "behaviour_tests", make, files=kept, with_job=with_job)


def covered(
    view: APIView,
    request: Request,
    files: Mapping[str, bytes],
    seen: Mapping[str, str],
    make: Callable[[Any], HttpResponseBase],
) -> Deferred:
    """Answers a request with the coverage of a project's trees by the results of runs.

    Raises:
        BusyError: too many jobs wait already.
    """
    kept = {path: data for path, data in files.items() if path.startswith(CHECKED)}
    return answered(view, request, "run_coverage", make, files=kept, seen=dict(seen))


def reported(
    view: APIView,
    request: Request,
    response: Response,
    read: Callable[[], Mapping[str, bytes]],
    robots: Robots | None = None,
) -> Deferred:
    """Adds the translator's findings about files to a response, and never fails; `read` returns the files.

    The files are already saved: a failed check must not look like a failed save. With `robots`, those
    with macros are looked at, too; if that fails, the notes that they are not stay.
    """

    def finish(done: Future[Any]) -> HttpResponseBase:
        response.data |= _report(done)
        found = response.data["diagnostics"]
        if robots is None or not any(item["code"] == NOT_LOOKED_AT for item in found):
            return response
        try:
            looked = _lookers[0](user_of(request), robots)
        except StudioError:
            return response
        return Deferred(view, request, looked, seen)

    def seen(done: Future[list[dict[str, Any]]]) -> Response:
        error = done.exception()
        if error is None:
            kept = [item for item in response.data["diagnostics"] if item["code"] != NOT_LOOKED_AT]
            response.data["diagnostics"] = kept + done.result()
        elif not isinstance(error, StudioError):
            log.error("robots could not be looked at", exc_info=error)
        return response

    return Deferred(view, request, _checking(request, read), finish)


def _checking(request: Request, read: Callable[[], Mapping[str, bytes]]) -> Future[Any]:
    try:
        files = {path: data if path.startswith(CHECKED) else b"" for path, data in read().items()}
        return pool().ask(owner(request), "report", files=files)
    except Exception as error:
        failed: Future[Any] = Future()
        failed.set_exception(error)
        return failed


def _report(done: Future[Any]) -> dict[str, Any]:
    error = done.exception()
    if error is None:
        return {**done.result(), "checked": True}
    from translator.diagnostic import Place, diagnostic  # noqa: PLC0415 - keeps the start of the server short

    log.error("a project could not be checked", exc_info=error)
    found = diagnostic("BT0009", Place(), problem=type(error).__name__)
    return {"actions": [], "diagnostics": [found.to_json()], "ros_distro": None, "checked": False}


def owner(request: Request) -> str:
    """Returns the owner of the work in the pool: the user, or for guests their address."""
    user = user_of(request)
    return f"user {user.pk}" if user.pk else f"address {client_address.get()}"


def accepted(result: dict[str, Any]) -> dict[str, Any]:
    """Returns the result of a job, or raises an error with the translator's `diagnostics`."""
    if "refused" in result:
        refuse(result["refused"])
    return result


def refuse(diagnostics: list[dict[str, Any]]) -> NoReturn:
    """Raises an error with the translator's `diagnostics`."""
    first = next(
        (d for d in diagnostics if d["severity"] == "error"), diagnostics[0] if diagnostics else None
    )
    raise CheckFailedError(
        first["message"] if first else "The project cannot be translated.",
        hint=(first or {}).get("hint") or "The list of problems says what to do about each.",
        diagnostics=diagnostics,
    )


def built_in_universe(files: Iterable[str], name: str) -> bytes | None:
    """Returns the document of a built-in universe, if a project with these files has robots to place in it.

    Otherwise None.
    """
    path = UNIVERSES / f"{name}.yaml"
    has_robots = any(path.startswith("robots/") for path in files)
    return path.read_bytes() if has_robots and path in UNIVERSES.glob("*.yaml") else None
