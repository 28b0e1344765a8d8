"""Passes jobs about projects to the pool of processes, and answers requests with the results."""

from __future__ import annotations

import logging
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any, Final, NoReturn

from backend.accounts.api.requests import user_of
from backend.accounts.audit import client_address
from backend.config.environment import REPOSITORY
from backend.projects.errors import CheckFailedError
from backend.workers.deferred import Deferred
from backend.workers.priorities import pool

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request
    from rest_framework.response import Response
    from rest_framework.views import APIView

log = logging.getLogger(__name__)

UNIVERSES: Final = REPOSITORY / "executor" / "universes"
# A check only needs to know that the other files exist.
_CHECKED: Final = ("project.json", "enums.json", "trees/", "actions/", "imports/")
_TESTED: Final = (*_CHECKED, "tests/")


def answered(
    view: APIView, request: Request, job: str, make: Callable[[Any], HttpResponseBase], **arguments: Any
) -> Deferred:
    """Answers a request with the response that `make` returns for the result of a job.

    Raises:
        BusyError: too many jobs wait already.
    """
    work = pool().ask(_owner(request), job, **arguments)
    return Deferred(view, request, work, lambda done: make(_accepted(done.result())))


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
    kept = {path: data for path, data in files.items() if path.startswith(_TESTED)}
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
    kept = {path: data for path, data in files.items() if path.startswith(_CHECKED)}
    return answered(view, request, "run_coverage", make, files=kept, seen=dict(seen))


def reported(
    view: APIView, request: Request, response: Response, read: Callable[[], Mapping[str, bytes]]
) -> Deferred:
    """Adds the translator's findings about files to a response, and never fails; `read` returns the files.

    The files are already saved: a failed check must not look like a failed save.
    """

    def finish(done: Future[Any]) -> Response:
        response.data |= _report(done)
        return response

    return Deferred(view, request, _checking(request, read), finish)


def _checking(request: Request, read: Callable[[], Mapping[str, bytes]]) -> Future[Any]:
    try:
        files = {path: data if path.startswith(_CHECKED) else b"" for path, data in read().items()}
        return pool().ask(_owner(request), "report", files=files)
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
    return {"actions": [], "diagnostics": [found.to_json()], "checked": False}


def _owner(request: Request) -> str:
    """Returns the owner of the work in the pool: the user, or for guests their address."""
    user = user_of(request)
    return f"user {user.pk}" if user.pk else f"address {client_address.get()}"


def _accepted(result: dict[str, Any]) -> dict[str, Any]:
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


def built_in_universe(files: Mapping[str, bytes], name: str) -> bytes | None:
    """Returns the document of a built-in universe, if the project has robots that may be placed in it.

    Otherwise None.
    """
    path = UNIVERSES / f"{name}.yaml"
    has_robots = any(path.startswith("robots/") for path in files)
    return path.read_bytes() if has_robots and path in UNIVERSES.glob("*.yaml") else None
