"""Views of a project's files as downloads (one file, the whole project, the tree as XML), and of imports."""

from __future__ import annotations

from functools import partial
from typing import IO, TYPE_CHECKING, Any, Final

from django.http import HttpResponse
from drf_spectacular.types import OpenApiTypes
from drf_spectacular.utils import OpenApiParameter, OpenApiResponse, extend_schema
from rest_framework import serializers
from rest_framework.decorators import action
from rest_framework.parsers import BaseParser, MultiPartParser

from backend.accounts.api.requests import user_of
from backend.accounts.api.viewsets import ResourceViewSet
from backend.core.file_answers import saved_as
from backend.core.objects.downloads import is_direct, redirected
from backend.core.problems import InvalidInputError
from backend.core.processes.stops import Stop
from backend.core.readers import reserve
from backend.core.rest.openapi import DIRECT, IDEMPOTENCY_KEY
from backend.ingress.bodies import body_of
from backend.projects.api import serializers as s
from backend.projects.api.schema import NOT_SOUND
from backend.projects.api.views import opened
from backend.projects.documents import archive, bundles, checking, export, python_trees
from backend.projects.storage import names, queries, writes
from backend.projects.storage.access import Need
from backend.workers.aside import unpacking
from backend.workers.deferred import Deferred
from backend.workers.jobs import ASK
from backend.workers.priorities import pool

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


ORDERS: Final = (ASK, "bottom-to-top", "top-to-bottom")


def flag(request: Request, name: str) -> bool:
    """Returns a boolean parameter of the query."""
    wish = request.query_params.get(name, "false").lower()
    if wish not in {"", "0", "1", "true", "false"}:
        raise InvalidInputError(f"{name} is true or false.", field=name)
    return wish in {"1", "true"}


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
            files=checking.files_of(project),
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
        headers = {"Content-Type": "application/zip"} | saved_as(f"{project.name}.zip")
        return export.answer_with_zip(self, request, checking.owner(request), project, headers)

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
        if flag(request, "dockerized"):
            return bundles.answer_with_zip(self, request, project, "app_zip", filename=project.name)
        name = request.query_params.get("name") or None
        return bundles.answer_with_zip(self, request, project, "package", name=name)

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
        return bundles.answer_with_zip(self, request, project, "cpp_package", name=name)

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
            files=checking.files_of(project),
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
        return bundles.answer_with_preview(self, request, project, name)

    @extend_schema(
        operation_id="import_project",
        parameters=[
            IDEMPOTENCY_KEY,
            OpenApiParameter(
                "filename", str, description="The file's name, where the body is the file itself."
            ),
            OpenApiParameter("repair", bool, description="Escape bare & and < in attributes of XML."),
            OpenApiParameter("main", str, description="The main tree, or its file; in Python its name."),
            OpenApiParameter(
                "order",
                str,
                enum=ORDERS,
                description="The order of children on JdeRobot's canvas, in place of the project's; `ask` "
                "refuses the project's where only the other one reaches all branches.",
            ),
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
        """Makes a project from a BT Studio zip, a JdeRobot or Groot2 project, BT.CPP XML or py_trees.

        The body is the file, or a form with the file. A body may be as large as the user's quota permits; a
        form may be as large as any other request. A Python file that builds a tree with py_trees is run where
        the user's robots are read, with limits, to see the tree.
        """
        user = user_of(request)
        data, name = _uploaded(request)
        main = request.query_params.get("main") or request.POST.get("main", "")
        order = request.query_params.get("order") or request.POST.get("order", "")
        if order not in {"", *ORDERS}:
            raise InvalidInputError(f"order is {', '.join(ORDERS)}.", field="order")
        wants_repair = flag(request, "repair") or request.POST.get("repair") == "true"

        if name.lower().endswith(python_trees.SUFFIX):
            return self._of_python(request, python_trees.Python(data, name, main))

        def create(files: Mapping[str, Any], proposal: dict[str, Any] | None = None) -> HttpResponseBase:
            return opened(
                self,
                request,
                lambda: writes.create_project(files, acting_user=user, message="Import"),
                status=201,
                more={"proposal": proposal, "one_block": ""},
            )

        def translated(done: Future[dict[str, Any]]) -> HttpResponseBase:
            return create(**checking.accepted(done.result()))

        def unpacked(done: Future[Upload]) -> HttpResponseBase:
            upload = done.result()
            with upload.spool:
                if upload.is_ours:
                    return create(upload.files)
                # All of it is in memory until the answer has arrived, so it stays counted.
                reserve(sum(content.size for content in upload.files.values()))
                asked: dict[str, Any] = {
                    "files": {path: content.data for path, content in upload.files.items()}
                }
                asked |= {"name": upload.name, "repair": wants_repair, "main": main, "order": order}
            return Deferred(self, request, pool().ask(checking.owner(request), "opened", **asked), translated)

        work = unpacking.ask(f"user {user.pk}", partial(archive.read_upload, data, name))
        return Deferred(self, request, work, unpacked)

    def _of_python(self, request: Request, python: python_trees.Python) -> Deferred:
        """Makes a project from a Python file that builds a tree with py_trees."""
        user, stop = user_of(request), Stop()
        work = python_trees.read(user, python, stop)

        def create(done: Future[python_trees.Made]) -> HttpResponseBase:
            made = done.result()
            return opened(
                self,
                request,
                lambda: writes.create_project(made.files, acting_user=user, message="Import"),
                status=201,
                more={"proposal": None, "one_block": made.one_block},
            )

        def close() -> None:
            """Removes what was made, also if the client has left meanwhile."""
            if work.done() and not work.cancelled() and work.exception() is None:
                work.result().spool.close()

        answer = Deferred(self, request, work, create, cancel=stop.set)
        answer.close_with(close)
        return answer


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
