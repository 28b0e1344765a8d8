"""Views of the runs of a user in all projects."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from drf_spectacular.types import OpenApiTypes
from drf_spectacular.utils import OpenApiParameter, extend_schema
from rest_framework.decorators import action
from rest_framework.response import Response

from backend.accounts.api.requests import user_of
from backend.accounts.api.viewsets import ResourceViewSet
from backend.core.problems import StudioError
from backend.ingress.bodies import body_of
from backend.runs import logs, mine
from backend.runs import serializers as s
from backend.runs.outside import require_converter
from backend.workers.aside import conversions
from backend.workers.deferred import Deferred
from backend.workers.priorities import pool

if TYPE_CHECKING:
    from concurrent.futures import Future
    from uuid import UUID

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request


class MyRuns(ResourceViewSet):
    """The runs that the user has kept."""

    lookup_url_kwarg = "run_id"
    lookup_value_converter = "uuid"

    @extend_schema(operation_id="list_my_runs", responses=s.MyRunListSerializer, tags=["runs"])
    def list(self, request: Request) -> Response:
        """Lists the runs that you kept in all projects, and your last runs; the newest 100."""
        user = user_of(request)
        return Response({"items": [s.presented_mine(run, user) for run in mine.mine(user)]})

    @extend_schema(operation_id="delete_my_run", responses={204: None}, tags=["runs"])
    def destroy(self, request: Request, run_id: UUID) -> Response:
        """Deletes a run that you kept, also one of a project that you may no longer read."""
        mine.delete_mine(run_id, acting_user=user_of(request))
        return Response(status=204)

    @extend_schema(
        operation_id="open_log",
        parameters=[OpenApiParameter("filename", str, description="Its name, for project and run.")],
        request={"application/octet-stream": OpenApiTypes.BINARY},
        responses={201: s.MyRunSerializer},
        tags=["runs"],
    )
    @action(detail=False, methods=["post"], expensive=("POST",))
    def logs(self, request: Request) -> HttpResponseBase:
        """Stores a log of a robot as a run of a new project, with the tree of the log if it has one.

        The body is the file. Known are MCAP, one file of a bag of ROS 2, and the `.btlog` and SQLite logs of
        BehaviorTree.CPP.
        """
        require_converter()
        user, name, body = user_of(request), request.query_params.get("filename", ""), body_of(request)
        owner = f"user {user.pk}"

        def converted(done: Future[logs.Recording]) -> HttpResponseBase:
            recording = done.result()
            if not recording.facts.xml:
                return made(recording, {})
            asked: dict[str, Any] = {"files": {"tree.xml": recording.facts.xml}, "repair": False}
            try:
                work = pool().ask(owner, "opened", name=logs.title(recording.name), **asked)
            except BaseException:
                recording.file.close()
                raise
            return Deferred(self, request, work, lambda done: made(recording, _files(done)))

        def made(recording: logs.Recording, files: dict[str, bytes]) -> Response:
            run = logs.open_log(recording, files, acting_user=user)
            return Response(s.presented_mine(run, user), status=201)

        work = conversions.ask(owner, partial(logs.read_log, body, name, owner))
        return Deferred(self, request, work, converted)


def _files(done: Future[Any]) -> dict[str, bytes]:
    """Returns the project of a log's tree; nothing if none can be made of it; the run shows it anyway."""
    try:
        files: dict[str, bytes] = done.result().get("files", {})
    except StudioError:
        return {}
    return files
