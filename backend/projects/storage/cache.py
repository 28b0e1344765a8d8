"""Caches recently used contents and lists of files, so that a save does not fetch them again.

The key of a content is its hash, so an entry is never out of date. The key of a list of files is the revision
of the project and its time, both of which are in the project's row.
"""

from __future__ import annotations

from threading import Lock
from typing import TYPE_CHECKING, Final, NamedTuple

from cachetools import LRUCache

from backend.projects.models import Blob
from backend.projects.storage.blobs import bytes_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from datetime import datetime
    from uuid import UUID

    from backend.projects.models import Project
    from backend.projects.storage.changes import Existing

LARGEST: Final = 256 * 1024
"""Bytes; larger contents are fetched each time."""
ROOM: Final = 48 * 1024 * 1024
"""Bytes of all contents that this process caches."""
STORED_ROOM: Final = 64 * 1024 * 1024
"""Bytes of all contents of the object store that this process caches: fetching them takes longest."""
FILES: Final = 40_000
"""Number of files in all lists that this process caches; it is larger than that of one project."""


class _List(NamedTuple):
    """The files of a project at one revision."""

    revision: int
    at: datetime
    files: Mapping[str, Existing]


_lock: Final = Lock()
kept_contents: Final[LRUCache[str, bytes]] = LRUCache(ROOM, getsizeof=len)
kept_stored: Final[LRUCache[str, bytes]] = LRUCache(STORED_ROOM, getsizeof=len)
kept_lists: Final[LRUCache[UUID, _List]] = LRUCache(FILES, getsizeof=lambda one: len(one.files))


def put(sha256: str, data: bytes) -> None:
    """Adds a content to the cache."""
    if len(data) <= LARGEST:
        with _lock:
            kept_contents[sha256] = data


def put_stored(sha256: str, data: bytes) -> None:
    """Adds a content of the object store to the cache."""
    if len(data) <= STORED_ROOM:
        with _lock:
            kept_stored[sha256] = data


def contents(wanted: Iterable[str]) -> dict[str, bytes]:
    """Returns the contents with these hashes, in at most one query."""
    hashes = set(wanted)
    with _lock:
        found = {
            sha256: kept[sha256]
            for kept in (kept_stored, kept_contents)
            for sha256 in hashes
            if sha256 in kept
        }
    if missing := hashes - found.keys():
        columns = ("sha256", "data", "stored_at")
        for sha256, data, stored_at in Blob.objects.filter(sha256__in=missing).values_list(*columns):
            found[sha256] = bytes_of(sha256, data, stored_at)
            put(sha256, found[sha256])
            if data is None:
                put_stored(sha256, found[sha256])
    return found


def put_files(project: Project, files: Mapping[str, Existing]) -> None:
    """Caches the files of a locked project.

    They are those of its current revision, or of the one that a save has just made.
    """
    if len(files) <= FILES:
        with _lock:
            kept_lists[project.pk] = _List(project.revision, project.updated_at, files)


def files(project: Project) -> dict[str, Existing] | None:
    """Returns the files of the project's revision, or None if they are not cached."""
    with _lock:
        found = kept_lists.get(project.pk)
    if found is None or (found.revision, found.at) != (project.revision, project.updated_at):
        return None
    return dict(found.files)
