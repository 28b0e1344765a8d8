"""Views that format, check and test Python while a user edits it; nothing is stored."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from drf_spectacular.utils import extend_schema
from rest_framework.response import Response
from rest_framework.views import APIView

from backend.accounts.api.requests import parsed, user_of
from backend.core.processes.stops import Stop
from backend.language import ruff
from backend.language import serializers as s
from backend.language.behaviours import completed, needs_python, runner
from backend.language.places import checker
from backend.language.turns import end_tests, python_tests, turn_of
from backend.projects.api.schema import NOT_SOUND
from backend.projects.api.serializers import CheckSerializer
from backend.projects.api.serializers_tests import TestReportSerializer
from backend.projects.documents import checking
from backend.projects.storage import names, queries
from backend.projects.storage.access import Need
from backend.workers.aside import checkers
from backend.workers.deferred import Deferred

if TYPE_CHECKING:
    from collections.abc import Callable
    from uuid import UUID

    from django.http.response import HttpResponseBase
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


class TestWithPython(APIView):
    """Runs behaviour tests whose leaves are `real`."""

    @extend_schema(
        operation_id="test_with_python",
        request=CheckSerializer,
        responses={200: TestReportSerializer} | NOT_SOUND,
        tags=["projects"],
    )
    def post(self, request: Request, project_id: UUID) -> Deferred:
        """Runs all behaviour tests of the project as it would be with these unsaved files.

        Leaves that are `real` run their Python in the user's tools: a container on a server for a team.
        """
        asked, user = parsed(CheckSerializer, request.data), user_of(request)
        project = queries.project(project_id, user=user, need=Need.RUN)
        files = checking.files_of(project)
        for overlay in asked["files"]:
            files[names.file_path(overlay["path"], field="files.path")] = overlay["content"].encode()
        run = runner(user)

        def rest(report: dict[str, Any]) -> HttpResponseBase:
            job = report.pop("job")
            if not needs_python(report):
                return Response(report)
            stop = Stop()
            work = python_tests().ask(user, project_id, partial(completed, report, job, run, stop), stop)

            def leave() -> None:
                work.cancel()
                stop.set()

            return Deferred(self, request, work, lambda done: Response(done.result()), cancel=leave)

        return checking.tested(self, request, files, rest, with_job=True)

    @extend_schema(operation_id="get_test_turn", responses=s.TestTurnSerializer, tags=["projects"])
    def get(self, request: Request, project_id: UUID) -> Response:
        """Returns the turn of the user's tests of the project that wait for a place, if any do."""
        user = user_of(request)
        queries.project(project_id, user=user, need=Need.RUN)
        turn = turn_of(user, project_id)
        is_own = turn is not None and turn.is_own
        return Response({"position": None if turn is None else turn.before + 1, "waits_for_own": is_own})

    @extend_schema(operation_id="end_test_with_python", responses={204: None}, tags=["projects"])
    def delete(self, request: Request, project_id: UUID) -> Response:
        """Ends the user's tests of the project that wait or run.

        The request that has started them is answered 409, `tests_ended`. If there are none, the answer is
        404, `no_tests`.
        """
        user = user_of(request)
        queries.project(project_id, user=user, need=Need.RUN)
        end_tests(user, project_id)
        return Response(status=204)


def _found(**given: Any) -> dict[str, Any]:
    return {"findings": ruff.findings(**given)}


def _answered(view: APIView, request: Request, work: Callable[[], dict[str, Any]]) -> Deferred:
    """Returns a deferred answer with the result of ruff, so that no request thread waits for it."""
    asked = checkers.ask(f"user {user_of(request).pk}", work)
    return Deferred(view, request, asked, lambda done: Response(done.result()))
