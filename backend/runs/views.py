"""Views of stored runs."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Final

from django.http import HttpResponse
from drf_spectacular.types import OpenApiTypes
from drf_spectacular.utils import OpenApiParameter, extend_schema
from rest_framework.decorators import action
from rest_framework.response import Response

from backend.accounts.api.requests import parsed, user_of
from backend.accounts.api.viewsets import ResourceViewSet
from backend.core.file_answers import FileAnswer, saved_as
from backend.core.objects.downloads import is_direct, redirected
from backend.core.problems import NotFoundError
from backend.core.rest.openapi import DIRECT
from backend.core.scratch import scratch
from backend.ingress.bodies import body_of
from backend.runs import logs, queries, writes
from backend.runs import serializers as s
from backend.runs.ranges import asked_range
from backend.workers.aside import conversions, pulls
from backend.workers.deferred import Deferred

if TYPE_CHECKING:
    from concurrent.futures import Future
    from uuid import UUID

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request

    from backend.accounts.models import User
    from backend.runs.models import Run


MOST_PART_BYTES: Final = 8 << 20


class Runs(ResourceViewSet):
    """The stored runs of a project."""

    lookup_url_kwarg = "run_id"
    lookup_value_converter = "uuid"
    expensive = ("POST",)

    @extend_schema(operation_id="list_runs", responses=s.RunListSerializer, tags=["runs"])
    def list(self, request: Request, project_id: UUID) -> Response:
        """Lists the runs that you kept, those that are shared, and, for the owner, all; pinned ones first."""
        user = user_of(request)
        return Response({"items": [s.presented(run, user) for run in queries.runs(project_id, user=user)]})

    @extend_schema(
        operation_id="keep_run", request=s.KeepRunSerializer, responses={201: s.RunSerializer}, tags=["runs"]
    )
    def create(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Stores the recording of a run of your session. The last 20 stay, and all that are pinned.

        Length, result and picture are read from the recording.
        """
        asked, user = parsed(s.KeepRunSerializer, request.data), user_of(request)
        source = writes.source(project_id, acting_user=user, attached=asked.pop("session", None))
        values: dict[str, Any] = {"recorded_as": asked.pop("run"), **asked}
        fetching = partial(writes.fetch, source, values["recorded_as"], user.pk)

        def kept(done: Future[writes.Fetched]) -> Response:
            run = writes.keep(done.result(), source.project, values, acting_user=user)
            return Response(s.presented(run, user), status=201)

        return Deferred(self, request, pulls.ask(f"user {user.pk}", fetching), kept)

    @extend_schema(
        operation_id="keep_log",
        parameters=[OpenApiParameter("filename", str, description="The name of the file; the run gets it.")],
        request={"application/octet-stream": OpenApiTypes.BINARY},
        responses={201: s.RunSerializer},
        tags=["runs"],
    )
    @action(detail=False, methods=["post"], expensive=("POST",))
    def logs(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Stores a log of a robot as a run. The body is the file.

        Known are MCAP, one file of a bag of ROS 2, and the `.btlog` and SQLite logs of BehaviorTree.CPP.
        """
        user, name = user_of(request), request.query_params.get("filename", "")
        project, body = logs.may_keep(project_id, acting_user=user), body_of(request)
        work = conversions.ask(f"user {user.pk}", partial(logs.read_log, body, name, f"user {user.pk}"))

        def kept(done: Future[logs.Recording]) -> Response:
            run = logs.keep_log(project, done.result(), acting_user=user)
            return Response(s.presented(run, user), status=201)

        return Deferred(self, request, work, kept)

    @extend_schema(operation_id="get_run", responses=s.RunSerializer, tags=["runs"])
    def retrieve(self, request: Request, project_id: UUID, run_id: UUID) -> Response:
        """Returns one run."""
        user = user_of(request)
        return Response(s.presented(queries.run(project_id, run_id, user=user), user))

    @extend_schema(
        operation_id="change_run", request=s.ChangeRunSerializer, responses=s.RunSerializer, tags=["runs"]
    )
    def partial_update(self, request: Request, project_id: UUID, run_id: UUID) -> Response:
        """Renames, notes, pins or shares a run."""
        asked, user = parsed(s.ChangeRunSerializer, request.data), user_of(request)
        return Response(s.presented(writes.change(project_id, run_id, asked, acting_user=user), user))

    @extend_schema(operation_id="delete_run", responses={204: None}, tags=["runs"])
    def destroy(self, request: Request, project_id: UUID, run_id: UUID) -> Response:
        """Deletes a run."""
        writes.delete(project_id, run_id, acting_user=user_of(request))
        return Response(status=204)

    @extend_schema(
        operation_id="get_run_thumbnail",
        responses={(200, "image/*"): OpenApiTypes.BINARY},
        tags=["runs"],
    )
    @action(detail=True)
    def thumbnail(self, request: Request, project_id: UUID, run_id: UUID) -> HttpResponseBase:
        """Returns a small picture of a run: of a camera, of the world and the robot's way, or of the tree."""
        run = queries.run(project_id, run_id, user=user_of(request), has_thumbnail=True)
        if not run.thumbnail_type:
            raise NotFoundError("This run has no picture.")
        headers = {
            "X-Content-Type-Options": "nosniff",
            "Content-Security-Policy": "default-src 'none'; sandbox",
            "Cache-Control": "private, max-age=86400, immutable",
        }
        return HttpResponse(bytes(run.thumbnail), content_type=run.thumbnail_type, headers=headers)

    @extend_schema(
        operation_id="download_run",
        responses={(200, "application/octet-stream"): OpenApiTypes.BINARY, 302: DIRECT},
        tags=["runs"],
    )
    @action(detail=True)
    def recording(self, request: Request, project_id: UUID, run_id: UUID) -> HttpResponseBase:
        """Returns the recording as an MCAP file, or the range of its bytes that `Range` names."""
        user = user_of(request)
        run = queries.run(project_id, run_id, user=user)
        tag = f'"{run.sha256}"'
        headers = saved_as(f"{run.name}.mcap") | {
            "Content-Type": "application/octet-stream",
            "X-Content-Type-Options": "nosniff",
            "Accept-Ranges": "bytes",
            "Cache-Control": "private, no-cache",
            "ETag": tag,
        }
        if request.headers.get("If-None-Match") == tag:
            return Response(status=304, headers={"ETag": tag})
        if run.stored_at and is_direct(request, f"{run.name}.mcap"):
            return redirected(run.stored_at, f"{run.name}.mcap")
        is_same = request.headers.get("If-Range", tag) == tag
        wanted = asked_range(request.headers.get("Range", ""), run.size) if is_same else None
        return _whole(run, user, headers) if wanted is None else _part(run, *wanted, headers)


def _part(run: Run, begin: int, end: int, headers: dict[str, str]) -> HttpResponse:
    """Returns a range of a recording, or its beginning if it is long: the client then requests the rest."""
    end = min(end, begin + MOST_PART_BYTES)
    headers |= {"Content-Range": f"bytes {begin}-{end - 1}/{run.size}"}
    return HttpResponse(b"".join(queries.parts(run, begin, end)), status=206, headers=headers)


def _whole(run: Run, user: User, headers: dict[str, str]) -> FileAnswer:
    """Returns a recording by a temporary file; each user, and all guests of a project, have one at a time."""
    who = f"guests of {run.project_id}" if user.is_guest else user.pk
    file = scratch().file(expected=run.size, key=f"download of {who}")
    try:
        for part in queries.parts(run, 0, run.size):
            file.write(part)
    except BaseException:
        file.close()
        raise
    return FileAnswer(file, headers=headers)
