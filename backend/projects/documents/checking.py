"""Jobs about projects for the pool of processes, and the use of its answers."""

from __future__ import annotations

import logging
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any, Final, NoReturn

from backend.accounts.api.requests import user_of
from backend.accounts.audit import client_address
from backend.config.environment import REPOSITORY
from backend.projects.errors import CheckFailedError
from backend.workers.deferred import Deferred
from backend.workers.lanes import pool

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request
    from rest_framework.response import Response
    from rest_framework.views import APIView

log = logging.getLogger(__name__)

UNIVERSES: Final = REPOSITORY / "executor" / "universes"
# Of all other files a check needs to know only that they are there.
_CHECKED: Final = ("project.json", "trees/", "actions/", "imports/")


def answered(
    view: APIView, request: Request, job: str, make: Callable[[Any], HttpResponseBase], **arguments: Any
) -> Deferred:
    """Answers a request with what `make` makes of the result of a job.

    Raises:
        BusyError: too much work waits already.
    """
    work = pool().ask(_owner(request), job, **arguments)
    return Deferred(view, request, work, lambda done: make(_accepted(done.result())))


def reported(
    view: APIView, request: Request, response: Response, read: Callable[[], Mapping[str, bytes]]
) -> Deferred:
    """Adds to a response what the translator says of the project whose files `read` fetches; never fails.

    What it tells of is stored already: that it cannot be checked must not look as if it had not been saved.
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
    """For whom the pool works: users have their share, guests share one an address."""
    user = user_of(request)
    return f"user {user.pk}" if user.pk else f"address {client_address.get()}"


def _accepted(result: dict[str, Any]) -> dict[str, Any]:
    if "refused" in result:
        refuse(result["refused"])
    return result


def refuse(diagnostics: list[dict[str, Any]]) -> NoReturn:
    """Raises what the translator refused as an answer with `diagnostics`."""
    first = next(
        (d for d in diagnostics if d["severity"] == "error"), diagnostics[0] if diagnostics else None
    )
    raise CheckFailedError(
        first["message"] if first else "The project cannot be translated.",
        hint=(first or {}).get("hint") or "The list of problems says what to do about each.",
        diagnostics=diagnostics,
    )


def built_in_universe(files: Mapping[str, bytes], name: str) -> bytes | None:
    """The document of a built-in universe, where the project has robots that may come with it."""
    path = UNIVERSES / f"{name}.yaml"
    has_robots = any(path.startswith("robots/") for path in files)
    return path.read_bytes() if has_robots and path in UNIVERSES.glob("*.yaml") else None
