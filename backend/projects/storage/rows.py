"""Reads and writes the rows of a save.

All functions of this module can use the ORM. On PostgreSQL, a save uses two SQL statements instead
(`at_once`), since the ORM would need eight, and builds the SQL again at each use. Tests compare the results
of both ways.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from django.db.models import F, Sum, Value
from django.db.models.functions import Concat

from backend.core.locks import transaction_lock
from backend.projects.models import Blob, ChangeSet, CurrentFile, Draft, FileRevision, Project
from backend.projects.storage import at_once
from backend.projects.storage.at_once import BLOBS
from backend.projects.storage.changes import Existing

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from uuid import UUID

    from backend.projects.storage.changes import Source

ROWS: Final = 200
"""The largest number of rows in one statement, since databases limit the number of parameters."""
PART_BYTES: Final = 8 * 1024 * 1024
"""Bytes of the contents that are written at once; one may be larger."""


class Writing(NamedTuple):
    """The rows that a change set writes."""

    change: ChangeSet
    blobs: Sequence[Source]
    """The contents that are stored in the database."""
    revisions: Sequence[tuple[str, str | None, str]]
    """Path, blob and earlier path of each changed file."""
    files: Sequence[tuple[str, str, str]]
    """Path, key of the path, and blob of each current file."""
    drafts: Sequence[str]
    """Paths of files whose drafts by the author are now saved, and are therefore deleted."""
    stored: Sequence[tuple[str, int, str]] = ()
    """Hash, size and object of each content that was uploaded for this change."""


def project(project_id: UUID, *, lock: bool = False) -> Project | None:
    """Returns a project that is not deleted, or None.

    With `lock`, no other transaction writes to the project until this one ends, and no blob is
    garbage-collected.
    """
    if not lock:
        return Project.objects.filter(pk=project_id, deleted_at=None).first()
    return at_once.locked(project_id) if at_once.is_here() else locked(project_id)


def locked(project_id: UUID) -> Project | None:
    """Returns the project by the ORM, and takes its locks; None if it does not exist."""
    transaction_lock(BLOBS, shared=True)
    return Project.objects.select_for_update().filter(pk=project_id, deleted_at=None).first()


def existing(project: Project) -> dict[str, Existing]:
    """Returns the current files by path, without their bytes."""
    found = CurrentFile.objects.filter(project=project)
    rows = found.values_list("path", "revision", "blob_id", "blob__size")
    return {row[0]: Existing(*row) for row in rows}


def root_trees(projects: Sequence[UUID], largest: int) -> dict[UUID, tuple[str, int]]:
    """Returns blob and size of the main tree of each of these projects, if it has at most `largest` bytes."""
    path = Concat(Value("trees/"), F("project__main_tree"), Value(".json"))
    found = CurrentFile.objects.filter(project__in=projects, path=path, blob__size__lte=largest)
    rows = found.values_list("project_id", "blob_id", "blob__size")
    return {project: (blob, size) for project, blob, size in rows}


def action_blobs(
    projects: Sequence[UUID], paths: Sequence[str], largest: int
) -> dict[tuple[UUID, str], tuple[str, int]]:
    """Returns blob and size of these projects' files at these paths, if they have at most `largest` bytes."""
    found = CurrentFile.objects.filter(project__in=projects, path__in=paths[:ROWS], blob__size__lte=largest)
    rows = found.values_list("project_id", "path", "blob_id", "blob__size")
    return {(project, path): (blob, size) for project, path, blob, size in rows}


def taken_by_others(project: Project) -> int:
    """Returns the bytes of all other projects of the owner."""
    known = at_once.taken_by_others(project)
    return summed_others(project) if known is None else known


def summed_others(project: Project) -> int:
    """Returns the bytes of all other projects of the owner, by the ORM."""
    others = Project.objects.filter(owner_id=project.owner_id, deleted_at=None).exclude(pk=project.pk)
    return int(others.aggregate(total=Sum("size"))["total"] or 0)


def write(writing: Writing) -> None:
    """Stores a change set with its files, and sets the key of the change."""
    if at_once.is_here() and at_once.has_room(writing) and not writing.stored:
        at_once.write(writing)
    else:
        store(writing)


def store(writing: Writing) -> None:
    """Stores a change set with its files by the ORM, for SQLite and for changes of many files."""
    change = writing.change
    forget_drafts(change.project, change.author_id, writing.drafts)
    change.save(force_insert=True)
    for part in _parts(writing):
        Blob.objects.bulk_create(part, ROWS, ignore_conflicts=True)
    for sha256, _, key in sorted(writing.stored):
        _replace_marked(sha256, key)
    revisions = [
        FileRevision(change=change, path=path, blob_id=blob, renamed_from=before)
        for path, blob, before in writing.revisions
    ]
    FileRevision.objects.bulk_create(revisions, ROWS)
    CurrentFile.objects.bulk_create(
        [_current(change, *file) for file in writing.files],
        ROWS,
        update_conflicts=True,
        unique_fields=["project", "path_key"],
        update_fields=["path", "revision", "updated_at", "blob"],
    )
    change.project.save(update_fields=["revision", "size", "updated_at"])


def _parts(writing: Writing) -> Iterator[list[Blob]]:
    """Yields the blobs of a change in parts that are not too large for the memory.

    They come in one order, so that two saves of the same blobs cannot deadlock.
    """
    objects = {sha256: (size, key) for sha256, size, key in writing.stored}
    contents = {content.sha256: content for content in writing.blobs}
    part: list[Blob] = []
    left = PART_BYTES
    for sha256 in sorted({*objects, *contents}):
        if sha256 in objects:
            size, key = objects[sha256]
            blob = Blob(sha256=sha256, size=size, stored_at=key)
        else:
            left -= contents[sha256].size
            if left < 0 and part:
                yield part
                part, left = [], PART_BYTES - contents[sha256].size
            blob = Blob(sha256=sha256, size=contents[sha256].size, data=contents[sha256].data)
        part.append(blob)
    if part:
        yield part


def _replace_marked(sha256: str, key: str) -> None:
    """Gives a blob that the collection has marked the object that was uploaded for this change."""
    marked = Blob.objects.filter(sha256=sha256, marked_at__isnull=False)
    marked.update(stored_at=key, data=None, marked_at=None, unreferenced_at=None)


def _current(change: ChangeSet, path: str, key: str, blob: str) -> CurrentFile:
    return CurrentFile(
        project=change.project,
        path=path,
        path_key=key,
        blob_id=blob,
        revision=change.number,
        updated_at=change.created_at,
    )


def forget_drafts(project: Project, author_id: int | None, paths: Sequence[str]) -> None:
    """Deletes the drafts of this user for these files."""
    for start in range(0, len(paths), ROWS):
        drafts = Draft.objects.filter(
            project=project, author_id=author_id, path__in=paths[start : start + ROWS]
        )
        drafts.delete()
