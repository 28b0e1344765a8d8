"""Errors as RFC 9457 problem documents.

    StudioError                 status, code, title, hint; each app has subclasses in its `errors.py`
    ├─ InvalidInputError        422, names the field
    ├─ NotFoundError            404
    └─ (see `errors.py` of projects and sessions)

Views raise these errors. `exception_handler` converts them to answers, and does the same for errors of DRF,
and of a database that cannot be reached or is full. Every other error becomes a 500.
"""

from __future__ import annotations

import errno
import logging
import math
from http import HTTPStatus
from typing import Any, ClassVar

from django.core.exceptions import PermissionDenied
from django.db import OperationalError
from django.http import Http404, HttpRequest, JsonResponse
from rest_framework import exceptions
from rest_framework.response import Response

log = logging.getLogger(__name__)

DISK_FULL = frozenset({"SQLITE_FULL", "SQLITE_IOERR_WRITE", "53100"})
"""The error codes of SQLite and PostgreSQL for a full disk."""
DATABASE_READ_ONLY = ("SQLITE_READONLY", "SQLITE_CANTOPEN", "25006")
"""The beginnings of the error codes of SQLite and PostgreSQL for a database that cannot be written."""
FULL = frozenset({errno.ENOSPC, errno.EDQUOT})
READ_ONLY = frozenset({errno.EROFS, errno.EACCES, errno.EPERM})
RETRY_S = 5
MEDIA_TYPE = "application/problem+json"
TYPE_PREFIX = "urn:bt-studio:problem:"


class StudioError(Exception):
    """An error that is shown to the user.

    Args:
        detail: one sentence that says what happened.
        hint: one sentence that says what the user can do now.
        field: the part of the request that is wrong, as a dotted path.
        extra: additional members of the problem document.
    """

    status: ClassVar[int] = 400
    code: ClassVar[str] = "bad_request"
    title: ClassVar[str] = "The request cannot be carried out"
    retry_after_s: ClassVar[int] = 0
    """Seconds after which the client may try again; 0 if a repetition does not help."""

    @property
    def headers(self) -> dict[str, str]:
        """The headers of the answer."""
        return {"Retry-After": str(self.retry_after_s)} if self.retry_after_s else {}

    def __init__(self, detail: str, *, hint: str = "", field: str = "", **extra: Any) -> None:
        super().__init__(detail)
        self.detail = detail
        self.hint = hint
        self.field = field
        self.extra = extra

    def document(self) -> dict[str, Any]:
        """Returns the problem document."""
        return problem(
            self.status,
            self.code,
            title=self.title,
            detail=self.detail,
            hint=self.hint,
            field=self.field,
            **self.extra,
        )


class InvalidInputError(StudioError):
    """A value in the request is invalid."""

    status = 422
    code = "invalid_input"
    title = "A value cannot be used"


class NotFoundError(StudioError):
    """The resource does not exist, or this user may not know that it does."""

    status = 404
    code = "not_found"
    title = "Not found"


class ServerBusyError(StudioError):
    """The server has too much of something to do, or to hold, at the moment."""

    status = 503
    code = "busy"
    title = "The server is busy"
    retry_after_s = 5


def problem(
    status: int, code: str, *, title: str = "", detail: str, hint: str = "", **extra: Any
) -> dict[str, Any]:
    """Builds a problem document; members without a value are left out."""
    document = {
        "type": TYPE_PREFIX + code,
        "title": title or HTTPStatus(status).phrase,
        "status": status,
        "code": code,
        "detail": detail,
        "hint": hint,
    }
    return document | {key: value for key, value in extra.items() if value not in ("", None)}


def problem_response(document: dict[str, Any], headers: dict[str, str] | None = None) -> JsonResponse:
    """Returns a problem document as Django's response, for errors outside of DRF."""
    return JsonResponse(document, status=document["status"], content_type=MEDIA_TYPE, headers=headers)


def exception_handler(error: Exception, context: dict[str, Any]) -> Response | None:
    """Converts an error of a view to an answer, as DRF's hook.

    Known errors become a problem document, others a logged 500.
    """
    headers: dict[str, str] = {}
    if isinstance(error, StudioError):
        document = error.document()
        headers |= error.headers
    elif isinstance(error, Http404):
        document = problem(404, "not_found", detail="There is nothing at this address.")
    elif isinstance(error, OperationalError):
        log.error("the database failed", exc_info=error)
        document, headers = database_problem(error), {"Retry-After": str(RETRY_S)}
    elif isinstance(error, OSError) and (found := disk_problem(error)) is not None:
        log.error("the disk cannot be written", exc_info=error)
        document = found
    elif isinstance(error, PermissionDenied):
        document = problem(403, "forbidden", detail="This is not allowed.")
    elif isinstance(error, exceptions.ValidationError):
        field, detail = _first_message(error.detail)
        document = problem(422, "invalid_input", title=InvalidInputError.title, detail=detail, field=field)
    elif isinstance(error, exceptions.APIException):
        field, detail = _first_message(error.detail)
        codes = error.get_codes()
        document = problem(
            error.status_code, codes if isinstance(codes, str) else "bad_request", detail=detail
        )
        if wait := getattr(error, "wait", None):
            headers["Retry-After"] = str(math.ceil(wait))
        if isinstance(error, exceptions.MethodNotAllowed):
            headers["Allow"] = ", ".join(context["view"].allowed_methods)
    else:
        return None
    return Response(document, status=document["status"], content_type=MEDIA_TYPE, headers=headers)


def disk_full() -> dict[str, Any]:
    """Returns the problem document for a full disk."""
    return problem(
        507,
        "disk_full",
        detail="The server's disk is full: nothing was written, and what was saved before is safe.",
        hint="Keep this page open, make room on the server's disk, then save again.",
    )


def read_only() -> dict[str, Any]:
    """Returns the problem document for a data folder or a database that cannot be written."""
    return problem(
        507,
        "read_only",
        detail="The server cannot write to its disk: nothing was written, and what was saved before is safe.",
        hint="Keep this page open; the data folder or the database is read-only, which its administrator "
        "must change. Then save again.",
    )


def disk_problem(error: OSError) -> dict[str, Any] | None:
    """Returns the problem document for an error of the disk; None for other errors."""
    if error.errno in FULL:
        return disk_full()
    return read_only() if error.errno in READ_ONLY else None


def database_problem(error: OperationalError) -> dict[str, Any]:
    """Returns the problem document for an error of the database.

    The transaction was not committed, so the client may try again as soon as the database can write.
    """
    cause = error.__cause__
    code = str(getattr(cause, "sqlite_errorname", None) or getattr(cause, "sqlstate", None))
    if code in DISK_FULL:
        return disk_full()
    if code.startswith(DATABASE_READ_ONLY):
        return read_only()
    return problem(
        503,
        "database_unavailable",
        detail="The database does not answer: nothing was written.",
        hint="Try again in a moment. If it stays so, the server's log has the reason.",
    )


def _first_message(detail: Any, path: str = "") -> tuple[str, str]:
    """Returns the first leaf of DRF's nested error structure, with its dotted path."""
    if isinstance(detail, dict):
        key, value = next(iter(detail.items()))
        own = "" if key == "non_field_errors" else str(key)
        return _first_message(value, ".".join(filter(None, (path, own))))
    if isinstance(detail, list):
        for index, value in enumerate(detail):
            if isinstance(value, dict | list) and value:
                return _first_message(value, ".".join(filter(None, (path, str(index)))))
            if value:
                return path, str(value)
        return path, "A value is missing."
    return path, str(detail)


def not_found(request: HttpRequest, exception: Exception | None = None) -> JsonResponse:
    """Answers 404 for addresses that no view serves, as Django's `handler404`."""
    return problem_response(problem(404, "not_found", detail="There is nothing at this address."))


def server_error(request: HttpRequest) -> JsonResponse:
    """Answers 500, as Django's `handler500`; the traceback is in the log only."""
    return problem_response(
        problem(
            500,
            "internal_error",
            detail="The server failed to answer; this is a fault of BT Studio.",
            hint="The server's log has the details. Nothing that was acknowledged is lost.",
        )
    )
