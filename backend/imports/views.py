"""Views that import robots, worlds and maps into a project, or look what an upload holds."""

from __future__ import annotations

from contextlib import ExitStack
from typing import TYPE_CHECKING, Any, Final

import msgspec
from drf_spectacular.types import OpenApiTypes
from drf_spectacular.utils import extend_schema
from rest_framework.decorators import action
from rest_framework.response import Response

from backend.accounts.api.requests import if_match, parsed, user_of
from backend.accounts.api.viewsets import ResourceViewSet
from backend.core.limits import LIMITS
from backend.core.problems import InvalidInputError
from backend.core.processes.stops import Stop
from backend.core.rest.openapi import IDEMPOTENCY_KEY, IF_MATCH, problem_of
from backend.imports import answers, writes
from backend.imports import serializers as s
from backend.imports.runner import runner
from backend.ingress.bodies import body_of
from backend.projects.api.idempotency import once, replayed
from backend.projects.api.views_files import RawFile
from backend.projects.errors import QuotaExceededError
from backend.projects.storage import queries
from backend.projects.storage.access import Need
from backend.projects.storage.spools import Spool
from backend.workers.aside import importing
from backend.workers.deferred import Deferred

if TYPE_CHECKING:
    from collections.abc import Callable
    from concurrent.futures import Future
    from uuid import UUID

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request

    from backend.accounts.models import User

UPLOAD: Final = {"application/octet-stream": OpenApiTypes.BINARY}
REFUSED: Final = problem_of(
    s.ImportProblemSerializer, "It cannot be imported, or not clear what.", status=422
)


class Imports(ResourceViewSet):
    """Imports into a project."""

    expensive = ("POST",)
    parser_classes = (RawFile,)

    @extend_schema(
        operation_id="inspect_import",
        parameters=[s.InspectQuerySerializer],
        request=UPLOAD,
        responses={200: s.InspectedSerializer} | REFUSED,
        tags=["imports"],
    )
    @action(detail=False, methods=["post"])
    def inspect(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Lists the robots, worlds and maps in a file or zip, which is the body. Nothing is executed."""
        asked, user = parsed(s.InspectQuerySerializer, request.query_params.dict()), user_of(request)
        project = queries.project(project_id, user=user, need=Need.WRITE)
        paths = list(queries.existing_files(project))
        free = {kind: writes.FreeNames(kind, paths) for kind in s.KINDS}

        def answered(found: bytes) -> Callable[[], Response]:
            read = answers.read(found)
            for item in read.items:
                item.name = free[item.kind].like(item.name)
            made = {"items": read.items, "left_out": read.left_out}
            return lambda: Response(msgspec.to_builtins(made))

        return _deferred(self, request, user, _header(asked), answered)

    @extend_schema(
        operation_id="import_part",
        parameters=[s.ImportQuerySerializer, IF_MATCH, IDEMPOTENCY_KEY],
        request=UPLOAD,
        responses={201: s.ImportedPartSerializer} | REFUSED,
        tags=["imports"],
    )
    def create(self, request: Request, project_id: UUID) -> HttpResponseBase:
        """Imports a robot, a world or a map from a file or zip, which is the body, as one revision.

        A robot is driven 1 m and turned by 360° first. If the client leaves meanwhile, nothing is written.
        """
        query = request.query_params
        asked = parsed(s.ImportQuerySerializer, query.dict() | {"arg": query.getlist("arg")})
        user, tag, kind = user_of(request), if_match(request), asked["kind"]
        project = queries.project(project_id, user=user, need=Need.WRITE)
        known = replayed(request, user)
        if known is not None:
            return known
        if asked["name"] and not asked["replace"]:
            writes.require_free(kind, asked["name"], queries.existing_files(project))
        upload, spools = body_of(request), ExitStack()

        def answered(found: bytes) -> Callable[[], Response]:
            read = answers.read(found)
            part = writes.Part(kind, read.name or "", asked["use"], asked["replace"])
            spool = spools.enter_context(Spool())
            files = answers.contents(read.files, upload, writes.prefixes(kind, part.name), spool)
            report = msgspec.to_builtins(
                {
                    "report": read.report,
                    "test_drive": read.test_drive,
                    "can_simplify": read.can_simplify,
                    "things": read.things,
                }
            )

            def effect() -> Response:
                made = writes.write_part(project_id, part, files, acting_user=user, if_match=tag)
                about = {
                    "revision": made.project.revision,
                    "previous_revision": made.previous,
                    "name": part.name,
                    "path": read.path,
                    "paths": made.paths,
                    "removed": made.removed,
                }
                headers = {"ETag": queries.etag(made.project)}
                return Response(about | report, status=201, headers=headers)

            def act() -> Response:
                with spools:
                    return once(request, user, effect)

            return act

        made = _deferred(self, request, user, _header(asked), answered)
        made.close_with(spools.close)  # the client may leave, or the contents may be refused
        return made


def _header(asked: dict[str, Any]) -> dict[str, Any]:
    arguments = dict(text.split(":=", 1) for text in asked.get("arg", ()))
    return {
        "filename": asked["filename"],
        "kind": asked.get("kind", ""),
        "main": asked.get("main", ""),
        "name": asked.get("name", ""),
        "arguments": arguments,
        "simplify": asked.get("simplify", False),
    }


def _deferred(
    view: Imports,
    request: Request,
    user: User,
    header: dict[str, Any],
    answered: Callable[[bytes], Callable[[], Response]],
) -> Deferred:
    """Answers with what `answered` returns for the answer of the child; the latter is read in a thread."""
    upload, stop, run = body_of(request), Stop(), runner(user)
    if not upload.read(1):
        text = "No file came with the request."
        raise InvalidInputError(text, hint="Send it as the body.", field="file")
    most = LIMITS["import_upload_bytes"]
    if upload.seek(0, 2) > most:
        raise QuotaExceededError(f"An upload has at most {most:,} bytes.", field="file")

    def work() -> Callable[[], Response]:
        upload.seek(0)
        return answered(run(header, upload, stop))

    def finish(done: Future[Callable[[], Response]]) -> Response:
        return done.result()()

    asked = importing.ask(f"user {user.pk}", work)
    return Deferred(view, request, asked, finish, cancel=stop.set)
