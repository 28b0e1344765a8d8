"""Views that format and check Python while a user edits it; nothing is stored."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from drf_spectacular.utils import extend_schema
from rest_framework.response import Response
from rest_framework.views import APIView

from backend.accounts.api.requests import parsed, user_of
from backend.language import ruff
from backend.language import serializers as s
from backend.language.places import checker
from backend.workers.aside import checkers
from backend.workers.deferred import Deferred

if TYPE_CHECKING:
    from collections.abc import Callable

    from rest_framework.request import Request


class Format(APIView):
    """Formats Python with ruff."""

    @extend_schema(
        operation_id="format_python",
        request=s.SourceSerializer,
        responses=s.FormattedSerializer,
        tags=["language"],
    )
    def post(self, request: Request) -> Deferred:
        """Formats a source; one that does not parse comes back unchanged, with its errors."""
        given = parsed(s.SourceSerializer, request.data)
        work = partial(ruff.format_source, **given, run=checker(user_of(request)))
        return _answered(self, request, work)


class Lint(APIView):
    """Finds problems with ruff."""

    @extend_schema(
        operation_id="lint_python",
        request=s.SourceSerializer,
        responses=s.FindingsSerializer,
        tags=["language"],
    )
    def post(self, request: Request) -> Deferred:
        """Lists probable errors, with the edits that fix them."""
        given = parsed(s.SourceSerializer, request.data)
        work = partial(_found, **given, run=checker(user_of(request)))
        return _answered(self, request, work)


def _found(**given: Any) -> dict[str, Any]:
    return {"findings": ruff.findings(**given)}


def _answered(view: APIView, request: Request, work: Callable[[], dict[str, Any]]) -> Deferred:
    """Returns a deferred answer with the result of ruff, so that no request thread waits for it."""
    asked = checkers.ask(f"user {user_of(request).pk}", work)
    return Deferred(view, request, asked, lambda done: Response(done.result()))
