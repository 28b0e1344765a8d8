"""The statements of a save, written out.

Django's ORM puts each statement together anew whenever it is used. For these that cost more processor time
than everything else that a save does, so they are plain SQL, in the dialect that SQLite and PostgreSQL share.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from django.db import connection

from backend.projects.changes import Existing
from backend.projects.models import Blob, ChangeSet, CurrentFile, Draft, FileRevision, Project

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from uuid import UUID

    from django.db.models import Model

ROWS: Final = 200
"""At most so many rows in one statement; databases bound the number of parameters."""


def _table(model: type[Model]) -> str:
    return connection.ops.quote_name(model._meta.db_table)


def _value(model: type[Model], field: str, value: object) -> Any:
    """As the database takes it: SQLite has neither times nor UUIDs."""
    return model._meta.get_field(field).get_db_prep_save(value, connection)  # type: ignore[union-attr]


@lru_cache(maxsize=256)
def _insert_sql(model: type[Model], fields: tuple[str, ...], rows: int, then: str) -> str:
    columns = ", ".join(str(model._meta.get_field(field).column) for field in fields)  # type: ignore[union-attr]
    places = ", ".join(["(" + ", ".join(["%s"] * len(fields)) + ")"] * rows)
    return f"INSERT INTO {_table(model)} ({columns}) VALUES {places} {then}"  # noqa: S608 - names of ours alone


def _insert(
    model: type[Model], fields: tuple[str, ...], rows: Sequence[Sequence[object]], then: str = ""
) -> int | None:
    """Inserts rows; what `then` returns of the first, if anything."""
    found = None
    with connection.cursor() as cursor:
        for start in range(0, len(rows), ROWS):
            some = rows[start : start + ROWS]
            values = [_value(model, f, v) for row in some for f, v in zip(fields, row, strict=True)]
            cursor.execute(_insert_sql(model, fields, len(some), then), values)
            found = cursor.fetchone()[0] if then.startswith("RETURNING") else None
    return found


def project(project_id: UUID, *, lock: bool = False) -> Project | None:
    """A project that is not deleted; with `lock`, nobody else writes to it until the transaction ends."""
    ending = " FOR UPDATE" if lock and connection.features.has_select_for_update else ""
    sql = f"SELECT * FROM {_table(Project)} WHERE id = %s AND deleted_at IS NULL{ending}"  # noqa: S608
    return next(iter(Project.objects.raw(sql, [_value(Project, "id", project_id)])), None)


def existing(project: Project) -> dict[str, Existing]:
    """The current files without their bytes."""
    sql = (
        "SELECT file.path, file.revision, file.blob_id, blob.size "  # noqa: S608
        f"FROM {_table(CurrentFile)} file JOIN {_table(Blob)} blob ON blob.sha256 = file.blob_id "
        "WHERE file.project_id = %s"
    )
    with connection.cursor() as cursor:
        cursor.execute(sql, [_value(Project, "id", project.pk)])
        return {row[0]: Existing(*row) for row in cursor.fetchall()}


def forget_drafts(project: Project, author_id: int, paths: Sequence[str]) -> None:
    """Removes what this user typed into these files and had not saved."""
    project_id = _value(Project, "id", project.pk)
    with connection.cursor() as cursor:
        for start in range(0, len(paths), ROWS):
            some = paths[start : start + ROWS]
            places = ", ".join(["%s"] * len(some))
            sql = (
                f"DELETE FROM {_table(Draft)} WHERE project_id = %s AND author_id = %s AND path IN ({places})"  # noqa: S608
            )
            cursor.execute(sql, [project_id, author_id, *some])


def add_change(change: ChangeSet) -> None:
    """Stores a change set, and gives it its key."""
    fields = ("project", "number", "author", "message", "label", "created_at")
    row = [getattr(change, ChangeSet._meta.get_field(field).attname) for field in fields]  # type: ignore[union-attr]
    change.pk = _insert(ChangeSet, fields, [row], "RETURNING id")


def add_blobs(blobs: Iterable[tuple[str, int, bytes]]) -> None:
    """Stores contents (hash, size, bytes) that are not stored yet."""
    # In one order, so that two saves of the same blobs never wait for each other.
    _insert(Blob, ("sha256", "size", "data"), sorted(blobs), "ON CONFLICT DO NOTHING")


def add_revisions(change: ChangeSet, files: Iterable[tuple[str, str | None, str]]) -> None:
    """Stores what the change made of each file: path, blob, and what it was renamed from."""
    rows = [(change.pk, *file) for file in files]
    _insert(FileRevision, ("change", "path", "blob", "renamed_from"), rows)


_NEWER: Final = (
    "ON CONFLICT (project_id, path_key) DO UPDATE SET path = EXCLUDED.path, revision = EXCLUDED.revision, "
    "updated_at = EXCLUDED.updated_at, blob_id = EXCLUDED.blob_id"
)


def put_current(project: Project, change: ChangeSet, files: Iterable[tuple[str, str, str]]) -> None:
    """Makes the current files of the project: path, its key, blob."""
    fields = ("project", "path", "path_key", "blob", "revision", "updated_at")
    rows = [(project.pk, *file, change.number, change.created_at) for file in files]
    _insert(CurrentFile, fields, rows, _NEWER)


def advance(project: Project) -> None:
    """Stores revision, size and time of a project."""
    sql = f"UPDATE {_table(Project)} SET revision = %s, size = %s, updated_at = %s WHERE id = %s"  # noqa: S608
    fields = ("revision", "size", "updated_at", "id")
    with connection.cursor() as cursor:
        cursor.execute(sql, [_value(Project, field, getattr(project, field)) for field in fields])
