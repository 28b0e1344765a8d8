"""Formatting and checking of Python that is being written; nothing is stored."""

from __future__ import annotations

from typing import TYPE_CHECKING

from drf_spectacular.utils import extend_schema
from rest_framework.response import Response
from rest_framework.views import APIView

from backend.config.api import parsed, user_of
from backend.language import ruff
from backend.language import serializers as s
from backend.language.places import checker

if TYPE_CHECKING:
    from rest_framework.request import Request


class Format(APIView):
    """Ruff's formatter."""

    @extend_schema(
        operation_id="format_python",
        request=s.SourceSerializer,
        responses=s.FormattedSerializer,
        tags=["language"],
    )
    def post(self, request: Request) -> Response:
        """The source in the usual style; 422 when it does not parse."""
        given = parsed(s.SourceSerializer, request.data)
        return Response({"source": ruff.format_source(**given, run=checker(user_of(request)))})


class Lint(APIView):
    """Ruff's findings."""

    @extend_schema(
        operation_id="lint_python",
        request=s.SourceSerializer,
        responses=s.FindingsSerializer,
        tags=["language"],
    )
    def post(self, request: Request) -> Response:
        """What is likely wrong, with the edits that mend it."""
        given = parsed(s.SourceSerializer, request.data)
        return Response({"findings": ruff.findings(**given, run=checker(user_of(request)))})
