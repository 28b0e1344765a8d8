"""Views of projects, and of actions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from uuid import UUID

from django.db import transaction
from drf_spectacular.utils import OpenApiParameter, extend_schema
from rest_framework.decorators import action
from rest_framework.response import Response
from rest_framework.views import APIView

from backend.accounts.api.requests import if_match, parsed, user_of
from backend.accounts.api.viewsets import ResourceViewSet
from backend.core.rest.openapi import IDEMPOTENCY_KEY, IF_MATCH, IF_NONE_MATCH, problem_of
from backend.projects.api import presentation
from backend.projects.api import serializers as s
from backend.projects.api.idempotency import once
from backend.projects.api.schema import NOT_SOUND, ConflictProblemSerializer
from backend.projects.api.serializers_tests import TestReportSerializer
from backend.projects.documents import bundles, checking, templates
from backend.projects.storage import names, queries, writes
from backend.projects.storage.access import Need

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request

    from backend.projects.models import Project


def opened(
    view: APIView,
    request: Request,
    write: Callable[[], Project],
    *,
    status: int = 200,
    more: Mapping[str, Any] | None = None,
) -> HttpResponseBase:
    """Writes a project once for each `Idempotency-Key`, and answers with the project and its problems.

    The data of the answer are read in the same transaction. Otherwise an error after the commit would make a
    stored write look like a failed one. `more` is added to the answer.
    """
    made: list[presentation.Opened] = []

    def effect() -> Response:
        with transaction.atomic():
            project = write()
            found = presentation.opened(project)
        made.append(found)
        return Response(found.rows | dict(more or {}), status=status, headers={"ETag": queries.etag(project)})

    response = once(request, user_of(request), effect)
    return checking.reported(
        view,
        request,
        response,
        lambda: made[0].checked_files() if made else _stored(request, response.data["id"]),
    )


def _stored(request: Request, project_id: UUID | str) -> dict[str, bytes]:
    """Returns the current files of a project, for the answer to a repeated request."""
    project = queries.project(UUID(str(project_id)), user=user_of(request), need=Need.READ)
    return checking.files_of(project)


class Projects(ResourceViewSet):
    """The projects of a user, and the operations on each."""

    lookup_url_kwarg = "project_id"
    lookup_value_converter = "uuid"

    @extend_schema(
        operation_id="list_projects",
        parameters=[s.ProjectListQuerySerializer],
        responses=s.ProjectListSerializer,
        tags=["projects"],
    )
    def list(self, request: Request) -> Response:
        """Lists the user's projects."""
        asked = parsed(s.ProjectListQuerySerializer, request.query_params.dict())
        user = user_of(request)
        rows = queries.projects(user=user, search=asked["search"], sort=asked["sort"], shelf=asked["shelf"])
        end = asked["offset"] + asked["limit"]
        page, total = queries.page(rows, asked["offset"], end, user=user)
        diagrams = queries.root_diagrams(page)
        types = queries.conditions_of(diagrams)
        items = [
            presentation.summary(project, diagrams.get(project.id), types.get(project.id, []))
            for project in page
        ]
        return Response({"items": items, "total": total, "next_offset": end if end < total else None})

    @extend_schema(
        operation_id="create_project",
        parameters=[IDEMPOTENCY_KEY],
        request=s.CreateProjectSerializer,
        responses={201: s.ProjectDetailSerializer},
        tags=["projects"],
    )
    def create(self, request: Request) -> HttpResponseBase:
        """Creates a project from a template."""
        asked = parsed(s.CreateProjectSerializer, request.data)
        user = user_of(request)

        def create() -> Project:
            files = templates.files_of(asked["template"])
            return writes.create_project(files, acting_user=user, name=asked["name"])

        return opened(self, request, create, status=201)

    @extend_schema(
        operation_id="get_project",
        parameters=[IF_NONE_MATCH],
        responses={200: s.ProjectDetailSerializer, 304: None},
        tags=["projects"],
    )
    def retrieve(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Opens a project: its files, actions and problems."""
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        if queries.etag(project) in request.headers.get("If-None-Match", ""):
            return Response(status=304, headers={"ETag": queries.etag(project)})
        found = presentation.opened(project)
        response = Response(found.rows, headers={"ETag": queries.etag(project)})
        return checking.reported(self, request, response, found.checked_files)

    @extend_schema(
        operation_id="edit_project",
        parameters=[IF_MATCH],
        request=s.EditProjectSerializer,
        responses={200: s.ProjectDetailSerializer}
        | problem_of(ConflictProblemSerializer, "project.json changed meanwhile, or the name is taken."),
        tags=["projects"],
    )
    def partial_update(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Renames a project or changes its settings."""
        asked = parsed(s.EditProjectSerializer, request.data)
        user, tag = user_of(request), if_match(request)
        return opened(
            self,
            request,
            lambda: writes.edit_settings(project_id, acting_user=user, if_match=tag, **asked),
        )

    @extend_schema(
        operation_id="delete_project", parameters=[IF_MATCH], responses={204: None}, tags=["projects"]
    )
    def destroy(self, request: Request, project_id: UUID) -> Response:
        """Deletes a project. `restore` restores it."""
        writes.delete_project(project_id, acting_user=user_of(request), if_match=if_match(request))
        return Response(status=204)

    @extend_schema(
        operation_id="restore_project",
        parameters=[IF_MATCH],
        request=None,
        responses=s.ProjectDetailSerializer,
        tags=["projects"],
    )
    @action(detail=True, methods=["post"])
    def restore(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Restores a deleted project. It gets another name if its own name has been taken since."""
        user, tag = user_of(request), if_match(request)
        return opened(
            self, request, lambda: writes.restore_project(project_id, acting_user=user, if_match=tag)
        )

    @extend_schema(
        operation_id="archive_project",
        parameters=[IF_MATCH],
        request=None,
        responses=s.ProjectDetailSerializer,
        tags=["projects"],
    )
    @action(detail=True, methods=["post"])
    def archive(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Moves a project to the archive."""
        user, tag = user_of(request), if_match(request)
        return opened(
            self,
            request,
            lambda: writes.set_archived(project_id, acting_user=user, archived=True, if_match=tag),
        )

    @extend_schema(
        operation_id="unarchive_project",
        parameters=[IF_MATCH],
        request=None,
        responses=s.ProjectDetailSerializer,
        tags=["projects"],
    )
    @action(detail=True, methods=["post"])
    def unarchive(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Moves a project out of the archive."""
        user, tag = user_of(request), if_match(request)
        return opened(
            self,
            request,
            lambda: writes.set_archived(project_id, acting_user=user, archived=False, if_match=tag),
        )

    @extend_schema(
        operation_id="duplicate_project",
        parameters=[IDEMPOTENCY_KEY],
        request=s.DuplicateProjectSerializer,
        responses={201: s.ProjectDetailSerializer},
        tags=["projects"],
    )
    @action(detail=True, methods=["post"], expensive=("POST",))
    def duplicate(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Makes a new project from the current files of this one."""
        name = parsed(s.DuplicateProjectSerializer, request.data)["name"]
        user = user_of(request)
        return opened(
            self,
            request,
            lambda: writes.duplicate_project(project_id, acting_user=user, name=name),
            status=201,
        )

    @extend_schema(
        operation_id="save_changes",
        parameters=[IF_MATCH, IDEMPOTENCY_KEY],
        request=s.ChangesSerializer,
        responses={200: s.ChangesDoneSerializer}
        | problem_of(ConflictProblemSerializer, "A base is stale; nothing was written."),
        tags=["projects"],
    )
    @action(detail=True, methods=["post"])
    def changes(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Writes, renames and deletes files in one step, completely or not at all."""
        asked = parsed(s.ChangesSerializer, request.data)
        user = user_of(request)
        saved: list[Project] = []

        def effect() -> Response:
            project = writes.save_files(
                project_id,
                s.file_changes(asked),
                acting_user=user,
                message=asked["message"],
                if_match=if_match(request),
            )
            saved.append(project)
            return Response(presentation.changed(project), headers={"ETag": queries.etag(project)})

        response = once(request, user, effect)
        return checking.reported(
            self,
            request,
            response,
            lambda: checking.files_of(saved[0]) if saved else _stored(request, project_id),
        )

    @extend_schema(
        operation_id="check_project",
        request=s.CheckSerializer,
        responses=s.ReportSerializer,
        tags=["projects"],
    )
    @action(detail=True, methods=["post"])
    def check(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Checks the project as it would be with these unsaved files.

        Robots with macros are looked at in a separate process, which is the user's tools on a server.
        """
        asked = parsed(s.CheckSerializer, request.data)
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        typed = _typed(asked)
        files = checking.files_of(project) | typed
        robots = checking.robots_of(project, typed)
        return checking.reported(self, request, Response({}), lambda: files, robots)

    @extend_schema(
        operation_id="change_distribution",
        request=s.DistributionSerializer,
        responses=s.DistributionChangeSerializer,
        tags=["projects"],
    )
    @action(detail=True, methods=["post"])
    def distribution(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Returns the files of the project for another ROS distribution, with these unsaved files.

        Nodes and ports of Nav2 get the names that they have there. Nothing is written.
        """
        asked = parsed(s.DistributionSerializer, request.data)
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        files = checking.files_of(project) | _typed(asked)
        return checking.answered(
            *(self, request, "changed_distribution", Response), files=files, ros_distro=asked["ros_distro"]
        )

    @extend_schema(
        operation_id="test_project",
        request=s.CheckSerializer,
        responses={200: TestReportSerializer} | NOT_SOUND,
        tags=["projects"],
    )
    @action(detail=True, methods=["post"], expensive=("POST",))
    def test(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Runs the behaviour tests of the project as it would be with these unsaved files.

        No Python of the project runs: tests with leaves that are `real` have the outcome `needs_python`.
        """
        asked = parsed(s.CheckSerializer, request.data)
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        files = checking.files_of(project) | _typed(asked)
        return checking.tested(self, request, files, Response, with_job=False)

    @extend_schema(
        operation_id="get_app",
        parameters=[OpenApiParameter("universe", str, description="Where to run, if not where it says.")],
        responses={200: s.AppSerializer} | NOT_SOUND,
        tags=["projects"],
    )
    @action(detail=True)
    def app(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Returns the project in the form that the executor runs.

        The answer is 422 with `diagnostics` if the project has errors.
        """
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        universe = request.query_params.get("universe") or ""
        return bundles.answer_with_app(self, request, project, universe)


def _typed(asked: Mapping[str, Any]) -> dict[str, bytes]:
    """Returns the unsaved files of a request."""
    return {
        names.file_path(overlay["path"], field="files.path"): overlay["content"].encode()
        for overlay in asked["files"]
    }


class InspectAction(APIView):
    """Reads the source of one action."""

    @extend_schema(
        operation_id="inspect_action",
        request=s.InspectActionSerializer,
        responses=s.ActionSerializer,
        tags=["projects"],
    )
    def post(self, request: Request) -> HttpResponseBase:
        """Returns the declarations in the source of an action."""
        asked = parsed(s.InspectActionSerializer, request.data)
        filename = names.file_path(asked["filename"], field="filename")
        return checking.answered(
            self, request, "inspect", Response, source=asked["source"], filename=filename
        )
