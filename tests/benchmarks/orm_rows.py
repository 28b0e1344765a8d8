"""The statements of `backend.projects.storage.rows` by Django's ORM, to compare what they cost."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from django.db.models import F, Sum, Value
from django.db.models.functions import Concat

from backend.core.locks import transaction_lock
from backend.projects.models import Blob, CurrentFile, Draft, FileRevision, Project
from backend.projects.storage.changes import Existing
from backend.projects.storage.rows import BLOBS, ROWS

if TYPE_CHECKING:
    from collections.abc import Sequence
    from uuid import UUID

    from backend.projects.storage.rows import Writing


def project(project_id: UUID, *, lock: bool = False) -> Project | None:
    found = Project.objects.filter(pk=project_id, deleted_at=None)
    if lock:
        transaction_lock(BLOBS, shared=True)
        found = found.select_for_update()
    return next(iter(found), None)


def existing(of: Project) -> dict[str, Existing]:
    found = CurrentFile.objects.filter(project=of)
    rows = found.values_list("path", "revision", "blob_id", "blob__size")
    return {row[0]: Existing(*row) for row in rows}


def root_trees(projects: Sequence[UUID], largest: int) -> dict[UUID, str]:
    path = Concat(Value("trees/"), F("project__main_tree"), Value(".json"))
    found = CurrentFile.objects.filter(project__in=projects, path=path, blob__size__lte=largest)
    return dict(found.values_list("project_id", "blob_id"))


def taken_by_others(of: Project) -> int:
    others = Project.objects.filter(owner_id=of.owner_id, deleted_at=None).exclude(pk=of.pk)
    return int(others.aggregate(total=Sum("size"))["total"] or 0)


def write(writing: Writing) -> None:
    change = writing.change
    forget_drafts(change.project, change.author_id, writing.drafts)
    change.save(force_insert=True)
    blobs = [Blob(sha256=sha256, size=size, data=data) for sha256, size, data in sorted(writing.blobs)]
    Blob.objects.bulk_create(blobs, ROWS, ignore_conflicts=True)
    FileRevision.objects.bulk_create(
        [
            FileRevision(change=change, path=path, blob_id=blob, renamed_from=before)
            for path, blob, before in writing.revisions
        ],
        ROWS,
    )
    CurrentFile.objects.bulk_create(
        [
            CurrentFile(
                project=change.project,
                path=path,
                path_key=key,
                blob_id=blob,
                revision=change.number,
                updated_at=change.created_at,
            )
            for path, key, blob in writing.files
        ],
        ROWS,
        update_conflicts=True,
        unique_fields=["project", "path_key"],
        update_fields=["path", "revision", "updated_at", "blob"],
    )
    change.project.save(update_fields=["revision", "size", "updated_at"])


def forget_drafts(of: Project, author_id: int | None, paths: Sequence[str]) -> Any:
    Draft.objects.filter(project=of, author_id=author_id, path__in=paths).delete()
