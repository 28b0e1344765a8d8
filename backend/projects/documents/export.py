"""Zips of a project's files, made in a file.

Their contents are fetched part by part, so a project is never completely in memory. They are compressed by
separate threads, so that a zip occupies no thread of requests for long.
"""

from __future__ import annotations

import zipfile
from contextlib import suppress
from functools import partial
from typing import IO, TYPE_CHECKING, Final, Protocol

from backend.core.file_answers import FileAnswer
from backend.core.readers import release
from backend.core.scratch import scratch
from backend.projects.storage import names
from backend.projects.storage.queries import data_of, existing_files
from backend.workers import zips
from backend.workers.aside import packing
from backend.workers.deferred import Deferred

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from concurrent.futures import Future

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request
    from rest_framework.views import APIView

    from backend.projects.models import Project
    from backend.projects.storage.changes import Existing
    from backend.projects.storage.queries import ListedFile

    Item = tuple[str, Existing | ListedFile | bytes]
    """A file of a zip: its path, and the stored file that has its content, or the content."""

PART_BYTES: Final = 8 * 1024 * 1024
"""Bytes of the files that are fetched at once; one file may be larger."""


class Zipping:
    """A zip that is made in a file; equal files give equal bytes."""

    def __init__(self, items: Iterable[Item], file: IO[bytes]) -> None:
        self.file = file
        self._archive = zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED)
        self._parts = _parts(items)

    def next(self) -> Callable[[], None] | None:
        """Fetches the next part of the contents, and returns what adds it; None if the zip is complete."""
        release()
        part = next(self._parts, None)
        if part is None:
            self._archive.close()
            return None
        return partial(zips.add, self._archive, _contents(part))

    def give_up(self) -> None:
        """Removes the unfinished file."""
        with suppress(Exception):  # the disk may be full
            self._archive.close()
        self.file.close()


def items_of(project: Project) -> list[Item]:
    """Returns the current files of a project, without files of tools."""
    files = existing_files(project)
    return [(path, file) for path, file in files.items() if not names.is_of_tool(path)]


def write_zip(items: Iterable[Item], file: IO[bytes]) -> None:
    """Writes a zip to a file."""
    zipping = Zipping(items, file)
    while (work := zipping.next()) is not None:
        work()


def answer_with_zip(
    view: APIView, request: Request, owner: str, project: Project, headers: dict[str, str]
) -> HttpResponseBase:
    """Answers with the zip of a project.

    Raises:
        NoRoomError, BusyError: too many large files are being sent, or too many zips are being made.
    """
    making = Zipping(items_of(project), scratch().file(expected=project.size))
    return answer_with_file(view, request, owner, making, headers)


class Making(Protocol):
    """A file that is made step by step."""

    file: IO[bytes]

    def next(self) -> Callable[[], None] | None:
        """Returns the next piece of work; None if the file is complete."""

    def give_up(self) -> None:
        """Removes the unfinished file."""


def answer_with_file(
    view: APIView, request: Request, owner: str, making: Making, headers: dict[str, str]
) -> HttpResponseBase:
    """Answers with a file that separate threads make.

    Raises:
        NoRoomError, BusyError: too many large files are being sent, or too many are being made.
    """

    def following(done: Future[None] | None = None) -> HttpResponseBase:
        try:
            if done is not None:
                done.result()
            work = making.next()
            if work is None:
                return FileAnswer(making.file, headers=headers)
            return Deferred(view, request, packing.ask(owner, work), following)
        except BaseException:
            making.give_up()
            raise

    return following()


def _parts(items: Iterable[Item]) -> Iterator[list[Item]]:
    """Yields files in parts of `PART_BYTES`, ordered by path."""
    part: list[Item] = []
    size = 0
    for item in sorted(items, key=lambda item: item[0]):
        more = len(item[1]) if isinstance(item[1], bytes) else item[1].size
        if part and size + more > PART_BYTES:
            yield part
            part, size = [], 0
        part.append(item)
        size += more
    if part:
        yield part


def _contents(part: list[Item]) -> dict[str, bytes]:
    stored = data_of([file for _, file in part if not isinstance(file, bytes)])
    return {path: file if isinstance(file, bytes) else stored[file.path] for path, file in part}
