"""Views of stored runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from drf_spectacular.types import OpenApiTypes
from drf_spectacular.utils import extend_schema
from rest_framework.decorators import action
from rest_framework.response import Response

from backend.accounts.api.requests import parsed, user_of
from backend.accounts.api.viewsets import ResourceViewSet
from backend.core.file_answers import FileAnswer
from backend.core.scratch import scratch
from backend.runs import queries, writes
from backend.runs import serializers as s
from backend.runs.ranges import asked_range

if TYPE_CHECKING:
    from uuid import UUID

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request

    from backend.runs.models import Run


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
    def create(self, request: Request, project_id: UUID) -> Response:
        """Stores the recording of a run of your session. The last 20 stay, and all that are pinned."""
        asked, user = parsed(s.KeepRunSerializer, request.data), user_of(request)
        values: dict[str, Any] = {"recorded_as": asked.pop("run"), **asked}
        return Response(s.presented(writes.keep(project_id, values, acting_user=user), user), status=201)

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
        operation_id="download_run",
        responses={(200, "application/octet-stream"): OpenApiTypes.BINARY},
        tags=["runs"],
    )
    @action(detail=True)
    def recording(self, request: Request, project_id: UUID, run_id: UUID) -> HttpResponseBase:
        """Returns the recording as an MCAP file, or the range of its bytes that `Range` names."""
        run = queries.run(project_id, run_id, user=user_of(request))
        tag = f'"{run.sha256}"'
        if request.headers.get("If-None-Match") == tag:
            return Response(status=304, headers={"ETag": tag})
        is_same = request.headers.get("If-Range", tag) == tag
        wanted = asked_range(request.headers.get("Range", ""), run.size) if is_same else None
        return _answer(run, wanted, tag)


def _answer(run: Run, wanted: tuple[int, int] | None, tag: str) -> HttpResponseBase:
    begin, end = wanted or (0, run.size)
    file = scratch().file(expected=end - begin)
    try:
        for part in queries.parts(run, begin, end):
            file.write(part)
    except BaseException:
        file.close()
        raise
    name = quote(run.name, safe="")
    headers = {
        "Content-Type": "application/octet-stream",
        "Content-Disposition": f"attachment; filename=\"run.mcap\"; filename*=UTF-8''{name}.mcap",
        "X-Content-Type-Options": "nosniff",
        "Accept-Ranges": "bytes",
        "ETag": tag,
        "Cache-Control": "private, no-cache",
    }
    if wanted is None:
        return FileAnswer(file, headers=headers)
    return FileAnswer(
        file, status=206, headers=headers | {"Content-Range": f"bytes {begin}-{end - 1}/{run.size}"}
    )
