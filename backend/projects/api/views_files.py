"""Views of a project's files as downloads (one file, the whole project, the tree as XML), and of imports."""

from __future__ import annotations

from functools import partial
from typing import IO, TYPE_CHECKING, Any

from django.http import HttpResponse
from drf_spectacular.types import OpenApiTypes
from drf_spectacular.utils import OpenApiParameter, OpenApiResponse, extend_schema
from rest_framework import serializers
from rest_framework.decorators import action
from rest_framework.parsers import BaseParser, MultiPartParser
from rest_framework.response import Response

from backend.accounts.api.requests import user_of
from backend.accounts.api.viewsets import ResourceViewSet
from backend.core.file_answers import saved_as
from backend.core.objects.downloads import is_direct, redirected
from backend.core.problems import InvalidInputError
from backend.core.rest.openapi import DIRECT, IDEMPOTENCY_KEY
from backend.ingress.bodies import body_of
from backend.projects.api import serializers as s
from backend.projects.api.schema import NOT_SOUND
from backend.projects.api.views import opened
from backend.projects.documents import archive, checking
from backend.projects.storage import names, queries, writes
from backend.projects.storage.access import Need
from backend.workers.aside import unpacking
from backend.workers.deferred import Deferred

if TYPE_CHECKING:
    from collections.abc import Mapping
    from concurrent.futures import Future
    from uuid import UUID

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request

    from backend.projects.documents.archive import Upload


def download(data: bytes | str, content_type: str, filename: str) -> HttpResponse:
    """Returns bytes that the browser saves and never displays; stored content must not run as a page."""
    return HttpResponse(data, headers={"Content-Type": content_type} | saved_as(filename))


def flag(request: Request, name: str) -> bool:
    """Returns a boolean parameter of the query."""
    wish = request.query_params.get(name, "false").lower()
    if wish not in {"", "0", "1", "true", "false"}:
        raise InvalidInputError(f"{name} is true or false.", field=name)
    return wish in {"1", "true"}


def zipped(name: str, made: dict[str, Any]) -> HttpResponse:
    """Returns a zip that a worker made."""
    return download(made["zip"], "application/zip", f"{name}.zip")


def packaged(made: dict[str, Any]) -> HttpResponse:
    """Returns a package that a worker made, under the package's name."""
    return zipped(made["name"], made)


def file_response(file: queries.StoredFile) -> HttpResponse:
    """Returns a stored file, with its revision in the ETag."""
    response = download(file.data, "application/octet-stream", file.path.rpartition("/")[2])
    response.headers["ETag"] = f'"{file.sha256}"'
    response.headers["X-Revision"] = str(file.revision)
    return response


class PackageFileSerializer(serializers.Serializer[dict[str, object]]):
    """A file of the package."""

    path = serializers.CharField()
    size = serializers.IntegerField()


class PackagePreviewSerializer(serializers.Serializer[dict[str, object]]):
    """The list of files of a package."""

    name = serializers.CharField()
    files = PackageFileSerializer(many=True)
    manifest = serializers.CharField(help_text="package.xml, with the dependencies.")
    diagnostics = s.DiagnosticSerializer(many=True)


class UploadSerializer(serializers.Serializer[dict[str, object]]):
    """A file to import."""

    file = serializers.FileField()
    repair = serializers.BooleanField(required=False, help_text="Escape bare & and < in attributes of XML.")


class RawFile(BaseParser):
    """Parses a request whose whole body is a file. The file is already a temporary file."""

    media_type = "application/octet-stream"

    def parse(
        self, stream: Any, media_type: str | None = None, parser_context: Mapping[str, Any] | None = None
    ) -> dict[str, str]:
        """Does nothing: the view reads the temporary file."""
        return {}


class ProjectFiles(ResourceViewSet):
    """Downloads of a project in several forms, and the import of a project."""

    lookup_url_kwarg = "project_id"
    lookup_value_converter = "uuid"

    @extend_schema(
        operation_id="download_file",
        responses={(200, "application/octet-stream"): OpenApiTypes.BINARY, 302: DIRECT},
        tags=["files"],
    )
    @action(detail=True, url_path="files/<path:path>")
    def download_file(self, request: Request, project_id: UUID, path: str) -> HttpResponse:
        """Returns the bytes of a current file."""
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        path = names.file_path(path)
        if is_direct(request, path) and (key := queries.object_of(project, path)):
            return redirected(key, path.rpartition("/")[2])
        return file_response(queries.current_file(project, path))

    @extend_schema(
        operation_id="get_xml",
        parameters=[OpenApiParameter("self_contained", bool, description="With the actions' source.")],
        responses={(200, "text/xml"): OpenApiTypes.STR} | NOT_SOUND,
        tags=["files"],
    )
    @action(detail=True)
    def xml(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Returns the tree as BT.CPP v4 XML.

        The answer is 422 with `diagnostics` if the project has errors.
        """
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        return checking.answered(
            self,
            request,
            "xml",
            lambda made: download(made["text"], "text/xml; charset=utf-8", f"{project.name}.xml"),
            files=queries.contents(project),
            self_contained=flag(request, "self_contained"),
        )

    @extend_schema(
        operation_id="export_project",
        responses={(200, "application/zip"): OpenApiTypes.BINARY},
        tags=["files"],
    )
    @action(detail=True, expensive=("GET",))
    def export(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Returns the current files as a zip. The same revision gives the same bytes."""
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        files = queries.contents(project)
        return checking.answered(self, request, "pack", partial(zipped, project.name), files=files)

    @extend_schema(
        operation_id="get_package",
        parameters=[
            OpenApiParameter("name", str, description="Name of the ROS package; else made of the project's."),
            OpenApiParameter("dockerized", bool, description="The app that the manager runs."),
        ],
        responses={(200, "application/zip"): OpenApiTypes.BINARY} | NOT_SOUND,
        tags=["files"],
    )
    @action(detail=True, expensive=("GET",))
    def package(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Returns the ROS 2 package as a zip.

        The answer is 422 with `diagnostics` if the project has errors.
        """
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        files = queries.contents(project)
        if flag(request, "dockerized"):
            return checking.answered(self, request, "app_zip", partial(zipped, project.name), files=files)
        name = request.query_params.get("name") or None
        return checking.answered(self, request, "package", packaged, files=files, name=name)

    @extend_schema(
        operation_id="get_cpp_package",
        parameters=[
            OpenApiParameter("name", str, description="Name of the ROS package; else made of the project's.")
        ],
        responses={(200, "application/zip"): OpenApiTypes.BINARY} | NOT_SOUND,
        tags=["files"],
    )
    @action(detail=True, expensive=("GET",))
    def cpp(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Returns a package for BehaviorTree.CPP 4 as a zip: the trees, and skeletons of the nodes in C++.

        The answer is 422 with `diagnostics` if the project has errors.
        """
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        name = request.query_params.get("name") or None
        files = queries.contents(project)
        return checking.answered(self, request, "cpp_package", packaged, files=files, name=name)

    @extend_schema(
        operation_id="get_models",
        responses={(200, "text/xml"): OpenApiTypes.STR},
        tags=["files"],
    )
    @action(detail=True)
    def models(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Returns the models of the project's nodes (`TreeNodesModel`), which Groot2 reads as a palette."""
        return self._text(request, project_id, "models", "_models.xml")

    @extend_schema(
        operation_id="get_schema",
        responses={(200, "text/xml"): OpenApiTypes.STR},
        tags=["files"],
    )
    @action(detail=True)
    def xsd(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Returns an XML Schema of documents with the project's nodes, by which editors of XML check them."""
        return self._text(request, project_id, "xsd", ".xsd")

    def _text(self, request: Request, project_id: UUID, job: str, ending: str) -> HttpResponseBase:
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        return checking.answered(
            self,
            request,
            job,
            lambda made: download(made["text"], "text/xml; charset=utf-8", f"{project.name}{ending}"),
            files=queries.contents(project),
        )

    @extend_schema(
        operation_id="preview_package",
        parameters=[OpenApiParameter("name", str, description="Name of the ROS package.")],
        responses={200: PackagePreviewSerializer} | NOT_SOUND,
        tags=["files"],
    )
    @action(detail=True, url_path="package/preview")
    def package_preview(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Lists the files of the ROS 2 package, without making a download."""
        project = queries.project(project_id, user=user_of(request), need=Need.READ)
        name = request.query_params.get("name") or None
        files = queries.contents(project)
        return checking.answered(self, request, "package_preview", Response, files=files, name=name)

    @extend_schema(
        operation_id="import_project",
        parameters=[
            IDEMPOTENCY_KEY,
            OpenApiParameter(
                "filename", str, description="The file's name, where the body is the file itself."
            ),
            OpenApiParameter("repair", bool, description="Escape bare & and < in attributes of XML."),
        ],
        request={"application/octet-stream": OpenApiTypes.BINARY, "multipart/form-data": UploadSerializer},
        responses={201: OpenApiResponse(s.ImportedProjectSerializer)} | NOT_SOUND,
        tags=["files"],
    )
    @action(
        detail=False,
        methods=["post"],
        url_path="import",
        parser_classes=(MultiPartParser, RawFile),
        expensive=("POST",),
    )
    def import_project(self, request: Request) -> HttpResponseBase:
        """Makes a project from a BT Studio zip, a JdeRobot or Groot2 project, or BT.CPP XML.

        The body is the file, or a form with the file. A body may be as large as the user's quota permits; a
        form may be as large as any other request.
        """
        user = user_of(request)
        data, name = _uploaded(request)
        wants_repair = flag(request, "repair") or request.POST.get("repair") == "true"

        def create(made: dict[str, Any]) -> HttpResponseBase:
            files: dict[str, bytes] = made["files"]
            return opened(
                self,
                request,
                lambda: writes.create_project(files, acting_user=user, message="Import"),
                status=201,
                more={"proposal": made["proposal"]},
            )

        def unpacked(done: Future[Upload]) -> HttpResponseBase:
            upload = done.result()
            if upload.is_ours:
                return create({"files": upload.files, "proposal": None})
            return checking.answered(
                self, request, "opened", create, files=upload.files, name=upload.name, repair=wants_repair
            )

        work = unpacking.ask(f"user {user.pk}", partial(archive.read_upload, data, name))
        return Deferred(self, request, work, unpacked)


def _uploaded(request: Request) -> tuple[IO[bytes], str]:
    """Returns the uploaded file and its name."""
    forms = request.FILES
    if not request.content_type.startswith("multipart/"):
        body = body_of(request)
        name = request.query_params.get("filename", "")
        if not body.read(1):
            raise InvalidInputError(
                "No file came with the request.", hint="Send it as the body.", field="file"
            )
        body.seek(0)
        return body, name
    uploaded = forms.get("file")
    if uploaded is None or uploaded.file is None:
        raise InvalidInputError("No file came with the request.", hint="Send it as “file”.", field="file")
    return uploaded.file, uploaded.name or ""
