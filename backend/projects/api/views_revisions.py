"""Views of the revisions of a project, and of drafts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from django.db import transaction
from drf_spectacular.types import OpenApiTypes
from drf_spectacular.utils import extend_schema
from rest_framework.decorators import action
from rest_framework.response import Response

from backend.accounts.api.requests import if_match, parsed, user_of
from backend.accounts.api.viewsets import ResourceViewSet
from backend.core.rest.openapi import IF_MATCH
from backend.projects.api import presentation
from backend.projects.api import serializers as s
from backend.projects.api.views import opened
from backend.projects.api.views_files import file_response
from backend.projects.documents import checking
from backend.projects.storage import draft_writes, names, queries, writes
from backend.projects.storage.access import Need

if TYPE_CHECKING:
    from uuid import UUID

    from django.http import HttpResponse
    from django.http.response import HttpResponseBase
    from rest_framework.request import Request


class Revisions(ResourceViewSet):
    """The revisions of a project."""

    lookup_url_kwarg = "number"
    lookup_value_converter = "int"

    @extend_schema(
        operation_id="list_revisions",
        parameters=[s.RevisionListQuerySerializer],
        responses=s.RevisionListSerializer,
        tags=["revisions"],
    )
    def list(self, request: Request, project_id: UUID) -> Response:
        """Lists the revisions, the newest first: all, or those that changed one file."""
        asked = parsed(s.RevisionListQuerySerializer, request.query_params.dict())
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        page, following = queries.history(
            project, path=asked["path"], before=asked.get("before"), limit=asked["limit"]
        )
        return Response({"items": [presentation.revision(row) for row in page], "next_before": following})

    @extend_schema(
        operation_id="label_revision",
        parameters=[IF_MATCH],
        request=s.LabelSerializer,
        responses=s.RevisionSerializer,
        tags=["revisions"],
    )
    @transaction.atomic  # includes the reads for the answer
    def partial_update(self, request: Request, project_id: UUID, number: int) -> Response:
        """Sets the label of a revision, or removes it."""
        asked = parsed(s.LabelSerializer, request.data)
        row = writes.label_revision(
            project_id, number, asked["label"], acting_user=user_of(request), if_match=if_match(request)
        )
        return Response(presentation.revision(row), headers={"ETag": queries.revision_etag(row)})

    @extend_schema(
        operation_id="download_old_file",
        responses={(200, "application/octet-stream"): OpenApiTypes.BINARY},
        tags=["revisions"],
    )
    @action(detail=True, url_path="files/<path:path>")
    def download_file(self, request: Request, project_id: UUID, number: int, path: str) -> HttpResponse:
        """Returns the bytes of a file in a revision."""
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        return file_response(queries.file_at(project, number, names.file_path(path)))

    @extend_schema(
        operation_id="diff_revision",
        parameters=[s.DiffQuerySerializer],
        responses=s.DiffSerializer,
        tags=["revisions"],
    )
    @action(detail=True)
    def diff(self, request: Request, project_id: UUID, number: int) -> HttpResponseBase:
        """Compares a revision with the previous one, or with `against` (0 is the empty project)."""
        asked = parsed(s.DiffQuerySerializer, request.query_params.dict())
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        newer = queries.listed_at(project, number)
        against = asked.get("against", number - 1)
        older = queries.listed_at(project, against) if against else {}
        older_texts, newer_texts = queries.differing(older, newer)
        return checking.answered(
            self,
            request,
            "diff",
            lambda found: Response({"older": against, "newer": number} | found),
            older=older_texts,
            newer=newer_texts,
        )

    @extend_schema(
        operation_id="restore_revision",
        parameters=[IF_MATCH],
        request=s.RestoreRevisionSerializer,
        responses=s.ProjectDetailSerializer,
        tags=["revisions"],
    )
    @action(detail=True, methods=["post"])
    def restore(self, request: Request, project_id: UUID, number: int) -> HttpResponseBase:
        """Makes a new revision in which files have the content that they had in this one."""
        asked = parsed(s.RestoreRevisionSerializer, request.data)
        paths = [names.file_path(path, field="paths") for path in asked["paths"]]
        user, tag = user_of(request), if_match(request)
        return opened(
            self,
            request,
            lambda: writes.restore_revision(project_id, number, acting_user=user, paths=paths, if_match=tag),
        )


class Drafts(ResourceViewSet):
    """Drafts: text that a user has typed and not saved."""

    lookup_url_kwarg = "path"
    lookup_value_converter = "path"

    @extend_schema(operation_id="list_drafts", responses=s.DraftListSerializer, tags=["drafts"])
    def list(self, request: Request, project_id: UUID) -> Response:
        """Lists the user's drafts in this project."""
        user = user_of(request)
        rows = queries.drafts(queries.project(project_id, user=user, need=Need.WRITE), user=user)
        return Response({"items": [presentation.draft(row) for row in rows]})

    @extend_schema(
        operation_id="save_draft",
        parameters=[IF_MATCH],
        request=s.SaveDraftSerializer,
        responses=s.DraftSerializer,
        tags=["drafts"],
    )
    def update(self, request: Request, project_id: UUID, path: str) -> Response:
        """Stores a draft. Saving the file removes the draft."""
        asked = parsed(s.SaveDraftSerializer, request.data)
        row = draft_writes.save_draft(
            project_id, path, acting_user=user_of(request), if_match=if_match(request), **asked
        )
        return Response(presentation.draft(row), headers={"ETag": queries.draft_etag(row)})

    @extend_schema(
        operation_id="discard_draft", parameters=[IF_MATCH], responses={204: None}, tags=["drafts"]
    )
    def destroy(self, request: Request, project_id: UUID, path: str) -> Response:
        """Discards a draft."""
        draft_writes.discard_draft(project_id, path, acting_user=user_of(request), if_match=if_match(request))
        return Response(status=204)
