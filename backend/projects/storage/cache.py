"""Keeps contents and lists of files that were used lately, so that a save does not fetch them again.

A content is named by its hash, so what is kept is never out of date. A list of files is that of one revision
of a project, made at one time: the project's row tells which one it is.
"""

from __future__ import annotations

from collections import OrderedDict
from threading import Lock
from typing import TYPE_CHECKING, Final

from backend.projects.models import Blob

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from datetime import datetime
    from uuid import UUID

    from backend.projects.models import Project
    from backend.projects.storage.changes import Existing

LARGEST: Final = 256 * 1024
"""Bytes; larger contents are fetched each time."""
ROOM: Final = 48 * 1024 * 1024
"""Bytes of all contents that this process keeps."""
FILES: Final = 40_000
"""Files in all lists that this process keeps."""


class _Kept:
    def __init__(self) -> None:
        self._lock = Lock()
        self._contents: OrderedDict[str, bytes] = OrderedDict()
        self._size = 0

    def put(self, sha256: str, data: bytes) -> None:
        """Keeps a content; what was not used for longest goes."""
        if len(data) > LARGEST:
            return
        with self._lock:
            if sha256 not in self._contents:
                self._contents[sha256] = data
                self._size += len(data)
            while self._size > ROOM:
                self._size -= len(self._contents.popitem(last=False)[1])

    def get(self, wanted: Iterable[str]) -> dict[str, bytes]:
        """Those that are kept."""
        found = {}
        with self._lock:
            for sha256 in wanted:
                data = self._contents.get(sha256)
                if data is not None:
                    self._contents.move_to_end(sha256)
                    found[sha256] = data
        return found


class _Lists:
    def __init__(self) -> None:
        self._lock = Lock()
        self._lists: OrderedDict[UUID, tuple[int, datetime, Mapping[str, Existing]]] = OrderedDict()
        self._size = 0

    def put(self, project: Project, files: Mapping[str, Existing]) -> None:
        """Keeps the files of the revision that a locked project is at, or that a save just made."""
        with self._lock:
            self._forget(project.pk)
            self._lists[project.pk] = (project.revision, project.updated_at, files)
            self._size += len(files)
            while self._size > FILES:
                self._forget(next(iter(self._lists)))

    def get(self, project: Project) -> dict[str, Existing] | None:
        """The files of this very revision, if they are kept."""
        with self._lock:
            revision, at, files = self._lists.get(project.pk, (0, None, {}))
            if revision != project.revision or at != project.updated_at:
                return None
            self._lists.move_to_end(project.pk)
        return dict(files)

    def _forget(self, project_id: UUID) -> None:
        self._size -= len(self._lists.pop(project_id, (0, None, {}))[2])


_lists: Final = _Lists()
files: Final = _lists.get
put_files: Final = _lists.put
_kept: Final = _Kept()
put: Final = _kept.put


def contents(wanted: Iterable[str]) -> dict[str, bytes]:
    """The contents of these hashes, in at most one query."""
    hashes = set(wanted)
    found = _kept.get(hashes)
    if missing := hashes - found.keys():
        for sha256, data in Blob.objects.filter(sha256__in=missing).values_list("sha256", "data"):
            found[sha256] = bytes(data)
            _kept.put(sha256, found[sha256])
    return found
