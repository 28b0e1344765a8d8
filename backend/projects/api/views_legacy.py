"""The endpoints of JdeRobot BT Studio of 2024 under `/tree_api/`, with the functions of the REST API.

Calls that change state were GET in the original; here they are POST. The graph of a project is its main
diagram in BT Studio's format, and its files are the actions.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from django.http import HttpResponse
from django.urls import re_path
from drf_spectacular.utils import extend_schema
from rest_framework.parsers import FormParser, MultiPartParser
from rest_framework.response import Response
from rest_framework.views import APIView

from backend.accounts.api.requests import user_of
from backend.accounts.models import User
from backend.core.problems import InvalidInputError
from backend.core.rest.parsers import StrictJSONParser
from backend.projects.documents import bundles, templates
from backend.projects.storage import names, queries, writes
from backend.projects.storage.changes import Content, FileChange

if TYPE_CHECKING:
    from django.http.response import HttpResponseBase
    from rest_framework.request import Request

    from backend.projects.models import Project

Parameters = dict[str, str]


class Later(NamedTuple):
    """A zip that a worker makes: the arguments of `answer_with_zip`."""

    project: Project
    kind: str
    options: dict[str, Any]


Handler = Callable[[User, Parameters], Response | HttpResponse | Later]
DONE: Final = {"success": True}


def create_project(user: User, asked: Parameters) -> Response:
    """Creates an empty project with this name."""
    writes.create_project(
        templates.files_of(templates.EMPTY), acting_user=user, name=_need(asked, "project_name")
    )
    return Response(DONE, status=201)


def delete_project(user: User, asked: Parameters) -> Response:
    """Deletes a project. The REST API can restore it."""
    writes.delete_project(_project(user, asked).id, acting_user=user)
    return Response(DONE)


def get_project_list(user: User, asked: Parameters) -> Response:
    """Lists the names of all projects."""
    return Response({"project_list": [project.name for project in queries.projects(user=user, sort="name")]})


def save_project_graph(user: User, asked: Parameters) -> Response:
    """Replaces the main diagram."""
    project = _project(user, asked)
    graph = _need(asked, "graph_json")
    try:
        parsed = json.loads(graph)
    except (ValueError, RecursionError) as error:
        raise InvalidInputError("graph_json is not valid JSON.", field="graph_json") from error
    if not isinstance(parsed, dict):
        raise InvalidInputError("graph_json must be a JSON object.", field="graph_json")
    _write(user, project, _graph_path(project), graph)
    return Response(DONE)


def get_project_graph(user: User, asked: Parameters) -> Response:
    """Returns the main diagram as text."""
    project = _project(user, asked)
    return Response({"graph_json": queries.current_file(project, _graph_path(project)).text})


def get_file_list(user: User, asked: Parameters) -> Response:
    """Lists the names of the actions' files."""
    files = queries.existing_files(_project(user, asked))
    return Response(
        {"file_list": sorted(p.removeprefix("actions/") for p in files if p.startswith("actions/"))}
    )


def get_file(user: User, asked: Parameters) -> Response:
    """Returns the source of one action."""
    return Response({"content": queries.current_file(_project(user, asked), _action_path(asked)).text})


def create_file(user: User, asked: Parameters) -> Response:
    """Creates an action. The answer is a conflict if the action exists."""
    _write(user, _project(user, asked), _action_path(asked), asked.get("content", ""), base=0)
    return Response(DONE, status=201)


def save_file(user: User, asked: Parameters) -> Response:
    """Replaces the source of an action. This API has no revisions, so the last write wins."""
    project = _project(user, asked)
    queries.current_file(project, _action_path(asked))
    _write(user, project, _action_path(asked), _need(asked, "content"))
    return Response(DONE)


def delete_file(user: User, asked: Parameters) -> Response:
    project = _project(user, asked)
    queries.current_file(project, _action_path(asked))
    change = FileChange(_action_path(asked), project.revision, delete=True)
    writes.save_files(project.id, [change], acting_user=user, message="Delete a file")
    return Response(DONE)


def generate_app(user: User, asked: Parameters) -> Later:
    """Returns the ROS 2 package of the project."""
    return Later(_project(user, asked), "package", {"name": asked.get("app_name") or None})


def get_dockerized_app(user: User, asked: Parameters) -> Later:
    """Returns the app in the form that the manager runs."""
    project = _project(user, asked)
    return Later(project, "app_zip", {"filename": asked.get("app_name") or project.name})


def _need(asked: Parameters, name: str) -> str:
    if not asked.get(name):
        raise InvalidInputError(f"The parameter {name} is missing.", field=name)
    return asked[name]


def _project(user: User, asked: Parameters) -> Project:
    return queries.project_named(_need(asked, "project_name"), user=user)


def _graph_path(project: Project) -> str:
    return names.file_path(f"trees/{project.main_tree}.json", field="project_name")


def _action_path(asked: Parameters) -> str:
    return names.file_path("actions/" + _need(asked, "filename"), field="filename")


def _write(user: User, project: Project, file: str, content: str, *, base: int | None = None) -> None:
    change = FileChange(file, project.revision if base is None else base, Content.of(content.encode()))
    writes.save_files(project.id, [change], acting_user=user, message="Save")


class Reading(APIView):
    """An endpoint that only reads. Its method is GET, as in the original."""

    handler: Handler | None = None
    expensive: tuple[str, ...] = ()

    @extend_schema(exclude=True)
    def get(self, request: Request) -> HttpResponseBase:
        """Calls the handler with the parameters of the query."""
        return _call(self, self.handler, request, request.query_params.dict())


class Writing(APIView):
    """An endpoint that changes state. Its method is POST, unlike in the original."""

    handler: Handler | None = None
    parser_classes = (StrictJSONParser, FormParser, MultiPartParser)

    @extend_schema(exclude=True)
    def post(self, request: Request) -> HttpResponseBase:
        """Calls the handler with the parameters of the body."""
        data: Any = request.data
        if not isinstance(data, dict):
            raise InvalidInputError("The body must be a JSON object or a form.")
        values = {name: data[name] for name in data}
        if wrong := next((name for name, value in values.items() if not isinstance(value, str | dict)), None):
            raise InvalidInputError("A parameter must be text.", field=str(wrong)[:100])
        texts = {
            name: value if isinstance(value, str) else json.dumps(value) for name, value in values.items()
        }
        return _call(self, self.handler, request, texts)


def _call(view: APIView, handler: Handler | None, request: Request, asked: Parameters) -> HttpResponseBase:
    assert handler is not None  # noqa: S101 - each address below names one
    answer = handler(user_of(request), asked)
    if isinstance(answer, Later):
        return bundles.answer_with_zip(view, request, answer.project, answer.kind, **answer.options)
    return answer


READING: Final[tuple[Handler, ...]] = (
    get_project_list,
    get_project_graph,
    get_file_list,
    get_file,
    generate_app,
    get_dockerized_app,
)
WRITING: Final[tuple[Handler, ...]] = (
    create_project,
    delete_project,
    save_project_graph,
    create_file,
    delete_file,
    save_file,
)
EXPENSIVE: Final[tuple[Handler, ...]] = (generate_app, get_dockerized_app)
ALIASES: Final[dict[str, Handler]] = {
    "save_project": save_project_graph,
    "get_simplified_app": get_dockerized_app,
}


def _address(name: str, handler: Handler) -> Any:
    options: dict[str, Any] = {"handler": staticmethod(handler)}
    if handler in WRITING:
        return re_path(f"^{name}/?$", Writing.as_view(**options))
    expensive = ("GET",) if handler in EXPENSIVE else ()
    return re_path(f"^{name}/?$", Reading.as_view(**options, expensive=expensive))


urlpatterns = [
    *(_address(handler.__name__, handler) for handler in (*READING, *WRITING)),
    *(_address(name, handler) for name, handler in ALIASES.items()),
]
