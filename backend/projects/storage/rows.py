"""The database's side of a save: what it reads, and how a change set becomes rows.

All statements are the ORM's. On PostgreSQL two of a save are written out instead (`at_once`), since the ORM
would need eight and builds each of them again; tests compare what both read and store.
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
    from collections.abc import Sequence
    from uuid import UUID

ROWS: Final = 200
"""At most so many rows in one statement; databases bound the number of parameters."""


class Writing(NamedTuple):
    """The rows that a change set writes."""

    change: ChangeSet
    blobs: Sequence[tuple[str, int, bytes]]
    """Hash, size and bytes of contents."""
    revisions: Sequence[tuple[str, str | None, str]]
    """What the change made of each file: path, blob, and what it was renamed from."""
    files: Sequence[tuple[str, str, str]]
    """The current files: path, its key, blob."""
    drafts: Sequence[str]
    """Files of which the author's drafts are done with."""


def project(project_id: UUID, *, lock: bool = False) -> Project | None:
    """A project that is not deleted.

    With `lock`, nobody else writes to it until the transaction ends, and no blob is collected.
    """
    if not lock:
        return Project.objects.filter(pk=project_id, deleted_at=None).first()
    return at_once.locked(project_id) if at_once.is_here() else locked(project_id)


def locked(project_id: UUID) -> Project | None:
    """The project with its locks, by the ORM."""
    transaction_lock(BLOBS, shared=True)
    return Project.objects.select_for_update().filter(pk=project_id, deleted_at=None).first()


def existing(project: Project) -> dict[str, Existing]:
    """The current files without their bytes."""
    found = CurrentFile.objects.filter(project=project)
    rows = found.values_list("path", "revision", "blob_id", "blob__size")
    return {row[0]: Existing(*row) for row in rows}


def root_trees(projects: Sequence[UUID], largest: int) -> dict[UUID, str]:
    """The blob of the main tree of each of these projects, where it has one that is not larger."""
    path = Concat(Value("trees/"), F("project__main_tree"), Value(".json"))
    found = CurrentFile.objects.filter(project__in=projects, path=path, blob__size__lte=largest)
    return dict(found.values_list("project_id", "blob_id"))


def taken_by_others(project: Project) -> int:
    """Bytes of all other projects of the owner."""
    others = Project.objects.filter(owner_id=project.owner_id, deleted_at=None).exclude(pk=project.pk)
    return int(others.aggregate(total=Sum("size"))["total"] or 0)


def write(writing: Writing) -> None:
    """Stores a change set with its files; then the change has its key."""
    if at_once.is_here() and at_once.has_room(writing):
        at_once.write(writing)
    else:
        store(writing)


def store(writing: Writing) -> None:
    """The same by the ORM, for SQLite and for changes of many files."""
    change = writing.change
    forget_drafts(change.project, change.author_id, writing.drafts)
    change.save(force_insert=True)
    # In one order, so that two saves of the same blobs never wait for each other.
    blobs = [Blob(sha256=sha256, size=size, data=data) for sha256, size, data in sorted(writing.blobs)]
    Blob.objects.bulk_create(blobs, ROWS, ignore_conflicts=True)
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
    """Removes what this user typed into these files and had not saved."""
    for start in range(0, len(paths), ROWS):
        drafts = Draft.objects.filter(
            project=project, author_id=author_id, path__in=paths[start : start + ROWS]
        )
        drafts.delete()
