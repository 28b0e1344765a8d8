"""Answers with what a project is exported as or run from: apps, and packages for ROS.

Of a project that is not small, the web server fetches only the files that the translator reads. It writes the
other ones into the zips part by part, so a project is never completely in memory.
"""

from __future__ import annotations

import base64
import json
from functools import partial
from secrets import token_hex
from typing import IO, TYPE_CHECKING, Any, Final

from django.http import HttpResponse
from rest_framework.response import Response

from backend.core.file_answers import saved_as
from backend.core.readers import release
from backend.core.scratch import scratch
from backend.projects.documents import checking
from backend.projects.documents.export import Zipping, answer_with_file
from backend.projects.storage import queries
from backend.workers.bundles import put
from backend.workers.deferred import Deferred
from backend.workers.priorities import pool

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from concurrent.futures import Future

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request
    from rest_framework.views import APIView

    from backend.projects.documents.export import Item
    from backend.projects.models import Project
    from backend.projects.storage.changes import Existing

    Values = dict[str, Any]
    Work = Callable[[], None]

SMALL: Final = 4 * 1024 * 1024
"""Bytes of a project that comes to a worker whole, which makes its zips."""
ENCODED: Final = 3 * 256 * 1024
"""Bytes that are written as base64 at once; a multiple of three."""
LAUNCHED: Final = (".py", ".xml", ".yaml", ".yml")


def answer_with_zip(
    view: APIView, request: Request, project: Project, kind: str, *, filename: str = "", **asked: Any
) -> Deferred:
    """Answers with a zip that is a kind of bundle (`workers/bundles.py`).

    Args:
        view: the view.
        request: the request.
        project: the project.
        kind: the kind.
        filename: the name of the file, without `.zip`; that of the package if not given.
        asked: what else the kind is made of.

    Raises:
        QuotaExceededError: what the translator reads of it is too large.
        BusyError, NoRoomError: too much of this is being done.
    """

    def headers(values: Values) -> dict[str, str]:
        return {"Content-Type": "application/zip"} | saved_as(f"{filename or values['name']}.zip")

    def whole(values: Values) -> HttpResponse:
        return HttpResponse(values["zip"], headers=headers(values))

    def parted(values: Values, zipped: Mapping[str, list[Item]]) -> HttpResponseBase:
        making = Zipping(zipped["zip"], scratch().file(expected=project.size))
        return answer_with_file(view, request, checking.owner(request), making, headers(values))

    return _answered(view, request, project, kind, (whole, parted), asked)


def answer_with_app(view: APIView, request: Request, project: Project, universe: str) -> Deferred:
    """Answers with the data of the command that runs a project, in a universe, or in its own one if "".

    Raises:
        QuotaExceededError, BusyError, NoRoomError: as for `answer_with_zip`.
    """
    chosen = universe or project.universe
    built_in = checking.built_in_universe(queries.existing_files(project), chosen)
    asked = {"universe": universe, "built_in": built_in, "revision": project.revision}

    def parted(values: Values, zipped: Mapping[str, list[Item]]) -> HttpResponseBase:
        headers = {"Content-Type": "application/json"}
        making = JsonWithZips(values, zipped, scratch().file(expected=project.size))
        return answer_with_file(view, request, checking.owner(request), making, headers)

    return _answered(view, request, project, "app", (Response, parted), asked, f"universes/{chosen}.yaml")


def answer_with_preview(view: APIView, request: Request, project: Project, name: str | None) -> Deferred:
    """Answers with the list of the files of the ROS 2 package."""
    files, others = _read(queries.existing_files(project))
    asked = {"files": files, "others": others, "name": name}
    return checking.answered(view, request, "package_preview", Response, **asked)


def _answered(  # noqa: PLR0913, PLR0917 - what an answer is made of
    view: APIView,
    request: Request,
    project: Project,
    kind: str,
    ways: tuple[
        Callable[[Values], HttpResponseBase],
        Callable[[Values, Mapping[str, list[Item]]], HttpResponseBase],
    ],
    asked: Values,
    more: str = "",
) -> Deferred:
    whole, parted = ways
    current = queries.existing_files(project)
    if sum(file.size for file in current.values()) <= SMALL:
        files = queries.contents(project)
        return checking.answered(view, request, kind, whole, files=files, **asked)
    files, others = _read(current, more)
    work = pool().ask(checking.owner(request), "bundle", files=files, others=others, kind=kind, **asked)
    release()  # the pool has packed them

    def finish(done: Future[Any]) -> HttpResponseBase:
        made = checking.accepted(done.result())
        zipped = {
            place: [(path, current[held] if isinstance(held, str) else held) for path, held in listed]
            for place, listed in made["zips"].items()
        }
        return parted(made["values"], zipped)

    return Deferred(view, request, work, finish)


def _read(current: Mapping[str, Existing], more: str = "") -> tuple[dict[str, bytes], dict[str, int]]:
    """Returns the files that the translator reads, and the sizes of the others.

    Raises:
        QuotaExceededError: they are too large.
    """
    read = [file for path, file in current.items() if path == more or is_read(path)]
    checking.require_checkable(file.size for file in read)
    files = queries.data_of(read)
    return files, {path: file.size for path, file in current.items() if path not in files}


def is_read(path: str) -> bool:
    """Returns whether the translator reads a file for a package, and does not only pass it on."""
    is_started = path.startswith("launch/") and path.endswith(LAUNCHED)
    names_packages = path == "requirements.txt" or path.rpartition("/")[2] == "package.xml"
    return path.startswith(checking.CHECKED) or path.endswith(".py") or is_started or names_packages


class JsonWithZips:
    """A JSON document with zips in base64 that is made in a file.

    Args:
        values: the values but for the zips.
        zipped: the files of the zips, by the paths of their values.
        file: where it is written.
    """

    def __init__(self, values: Values, zipped: Mapping[str, list[Item]], file: IO[bytes]) -> None:
        self.file = file
        self._zipping: Zipping | None = None
        self._steps = self._all_steps(values, zipped)

    def next(self) -> Work | None:
        """Returns the next piece of work; None if the document is complete."""
        return next(self._steps, None)

    def give_up(self) -> None:
        """Removes the unfinished files."""
        if self._zipping is not None:
            self._zipping.give_up()
        self.file.close()

    def _all_steps(self, values: Values, zipped: Mapping[str, list[Item]]) -> Iterator[Work]:
        marks = {token_hex(): items for items in zipped.values()}
        for place, mark in zip(zipped, marks, strict=True):
            put(values, place, mark)
        rest = json.dumps(values, ensure_ascii=False)
        for mark in sorted(marks, key=rest.index):
            before, rest = rest.split(mark)
            self.file.write(before.encode())
            self._zipping = Zipping(marks[mark], scratch().file())
            while (work := self._zipping.next()) is not None:
                yield work
            yield partial(_encode, self._zipping.file, self.file)
            self._zipping.give_up()
        self.file.write(rest.encode())


def _encode(source: IO[bytes], target: IO[bytes]) -> None:
    """Appends a file in base64 to another one."""
    source.seek(0)
    while part := source.read(ENCODED):
        target.write(base64.b64encode(part))
