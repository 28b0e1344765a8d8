"""The fast path of a save on PostgreSQL.

One statement locks and reads the project, another one writes all rows.

Django's ORM needs eight statements for the same (`rows.locked`, `rows.store`; tests compare both). The ORM
builds the SQL again at each use, and each statement costs a round trip.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from django.db import connection

from backend.core.locks import lock_number
from backend.projects.models import Blob, ChangeSet, CurrentFile, Draft, FileRevision, Project

if TYPE_CHECKING:
    from collections.abc import Sequence
    from uuid import UUID

    from django.db.models import Field, Model

    from backend.projects.storage.rows import Writing

BLOBS: Final = "blobs"
"""The name of the lock that keeps the garbage collection from removing blobs that a save is about to use."""
FILES: Final = 20
"""The largest number of files in one statement; changes of more files use the ORM.

For each number of files, PostgreSQL plans another statement.
"""
BYTES: Final = 16 * 1024 * 1024
"""The largest contents of one statement, which are in memory together."""

_CHANGE: Final = ("project", "number", "author", "message", "label", "created_at")
_BLOB: Final = ("sha256", "size", "data")
_REVISION: Final = ("path", "blob", "renamed_from")
_FILE: Final = ("project", "path", "path_key", "blob", "revision", "updated_at")
_PROJECT: Final = ("revision", "size", "updated_at", "id")
_NEWER: Final = (
    "ON CONFLICT (project_id, path_key) DO UPDATE SET path = EXCLUDED.path, revision = EXCLUDED.revision, "
    "updated_at = EXCLUDED.updated_at, blob_id = EXCLUDED.blob_id"
)
_OTHERS: Final = "bytes_of_others"


def is_here() -> bool:
    """Returns whether the database is PostgreSQL, which these statements require."""
    return connection.vendor == "postgresql"


def has_room(writing: Writing) -> bool:
    """Returns whether the change has few and small enough files for one statement."""
    is_small = sum(content.size for content in writing.blobs) <= BYTES
    return is_small and max(len(writing.drafts), len(writing.revisions)) <= FILES


def locked(project_id: UUID) -> Project | None:
    """Returns a project that is not deleted, or None; takes the locks of the project and of the blobs.

    The statement also reads what `taken_by_others` returns.
    """
    return next(iter(Project.objects.raw(_locked_sql(), [project_id])), None)


def taken_by_others(project: Project) -> int | None:
    """Returns the bytes of the owner's other projects, if `locked` has read them for this project.

    Otherwise None.
    """
    return vars(project).get(_OTHERS)


@lru_cache(maxsize=1)
def _locked_sql() -> str:
    table = _table(Project)
    lock = f"pg_advisory_xact_lock_shared({lock_number(BLOBS)})"
    others = (
        f"SELECT COALESCE(SUM(size), 0)::bigint FROM {table} AS other "  # noqa: S608 - names of ours alone
        "WHERE other.owner_id = own.owner_id AND other.deleted_at IS NULL AND other.id <> own.id"
    )
    return (
        f"SELECT own.*, {lock}, ({others}) AS {_OTHERS} FROM {table} AS own "  # noqa: S608 - as above
        "WHERE own.id = %s AND own.deleted_at IS NULL FOR UPDATE OF own"
    )


def write(writing: Writing) -> None:
    """Stores a change set with its files, and sets the key of the change."""
    change, project = writing.change, writing.change.project
    files = [(project.pk, *file, change.number, change.created_at) for file in writing.files]
    values = [
        *_values(
            ChangeSet, _CHANGE, [[getattr(change, _field(ChangeSet, name).attname) for name in _CHANGE]]
        ),
        # Blobs are written in one order, so that two saves of the same blobs cannot deadlock.
        *_values(Blob, _BLOB, sorted((blob.sha256, blob.size, blob.data) for blob in writing.blobs)),
        *_values(FileRevision, _REVISION, writing.revisions),
        *_values(CurrentFile, _FILE, files),
        *([project.pk, change.author_id, *writing.drafts] if writing.drafts else []),
        *_values(Project, _PROJECT, [[getattr(project, name) for name in _PROJECT]]),
    ]
    numbers = (len(writing.blobs), len(writing.revisions), len(writing.files), len(writing.drafts))
    with connection.cursor() as cursor:
        cursor.execute(_sql(*numbers), values)
        change.pk = cursor.fetchone()[0]


def _values(model: type[Model], names: Sequence[str], rows: Sequence[Sequence[object]]) -> list[Any]:
    fields = [_field(model, name) for name in names]
    return [
        field.get_db_prep_save(value, connection)
        for row in rows
        for field, value in zip(fields, row, strict=True)
    ]


def _field(model: type[Model], name: str) -> Field[Any, Any]:
    return model._meta.get_field(name)  # type: ignore[return-value]


@lru_cache(maxsize=256)
def _sql(blobs: int, revisions: int, files: int, drafts: int) -> str:
    """Returns the SQL statement that writes these numbers of rows.

    PostgreSQL runs all parts of a statement on one snapshot, so none may depend on rows that another part
    writes.
    """
    parts = {
        "change": f"{_insert(ChangeSet, _CHANGE, 1)} RETURNING id",
        "blobs": f"{_insert(Blob, _BLOB, blobs)} ON CONFLICT DO NOTHING" if blobs else "",
        "revisions": _insert(FileRevision, _REVISION, revisions, of="change") if revisions else "",
        "files": f"{_insert(CurrentFile, _FILE, files)} {_NEWER}" if files else "",
        "drafts": (
            f"DELETE FROM {_table(Draft)} "  # noqa: S608 - names of ours alone
            f"WHERE project_id = %s AND author_id = %s AND path IN {_places(drafts)}"
        )
        if drafts
        else "",
        "project": f"UPDATE {_table(Project)} SET revision = %s, size = %s, updated_at = %s WHERE id = %s",  # noqa: S608
    }
    listed = ", ".join(f"{name} AS ({sql})" for name, sql in parts.items() if sql)
    return f"WITH {listed} SELECT id FROM change"  # noqa: S608 - as above


def _insert(model: type[Model], names: Sequence[str], rows: int, *, of: str = "") -> str:
    """Returns the `INSERT` clause for `rows` rows.

    With `of`, the first column of each row is the `id` that the clause `of` selects.
    """
    columns = ", ".join([f"{of}_id"] * bool(of) + [str(_field(model, name).column) for name in names])
    row = _places(len(names), f"(SELECT id FROM {of})" if of else "")  # noqa: S608 - as above
    return f"INSERT INTO {_table(model)} ({columns}) VALUES {', '.join([row] * rows)}"  # noqa: S608 - as above


def _places(number: int, first: str = "") -> str:
    return "(" + ", ".join([first] * bool(first) + ["%s"] * number) + ")"


def _table(model: type[Model]) -> str:
    return connection.ops.quote_name(model._meta.db_table)
