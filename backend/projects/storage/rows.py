"""The statements of a save, written out.

Django's ORM builds each statement again whenever it is used. For these that cost more processor time
than everything else that a save does, so they are plain SQL, in the dialect that SQLite and PostgreSQL share.
PostgreSQL gets all that a save writes in one statement: each further one costs more, on both sides, than it
does.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from django.db import connection
from django.db.models import IntegerField

from backend.core.instances import columns, instance
from backend.core.locks import lock_number
from backend.projects.models import Blob, ChangeSet, CurrentFile, Draft, FileRevision, Project
from backend.projects.storage.changes import Existing

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from uuid import UUID

    from django.db.models import Field, Model

BLOBS: Final = "blobs"
"""The lock that keeps blobs from being collected while a save is about to use them."""
ROWS: Final = 200
"""At most so many rows in one statement; databases bound the number of parameters."""
AT_ONCE: Final = 20
"""Changes of so many files are one statement; each number of files is another one to plan."""

Parameters = list[Any]


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


def _table(model: type[Model]) -> str:
    return connection.ops.quote_name(model._meta.db_table)


def _field(model: type[Model], name: str) -> Field[Any, Any]:
    return model._meta.get_field(name)  # type: ignore[return-value]


@lru_cache(maxsize=128)
def _to_database(vendor: str, model: type[Model], name: str) -> Callable[[Any], Any]:
    """Turns a field's value into what the database takes: SQLite has neither times nor UUIDs."""
    field = _field(model, name)
    if vendor == "postgresql" and not isinstance(getattr(field, "target_field", field), IntegerField):
        return lambda value: value
    return lambda value: field.get_db_prep_save(value, connection)


def _values(model: type[Model], names: tuple[str, ...], rows: Sequence[Sequence[object]]) -> Parameters:
    vendor = connection.vendor
    convert = [_to_database(vendor, model, name) for name in names]
    return [one(value) for row in rows for one, value in zip(convert, row, strict=True)]


def _id(project: Project) -> Any:
    return _to_database(connection.vendor, Project, "id")(project.pk)


def _places(columns: int, rows: int, first: str = "%s") -> str:
    row = "(" + ", ".join([first] + ["%s"] * (columns - 1)) + ")"
    return ", ".join([row] * rows)


@lru_cache(maxsize=256)
def _insert_sql(
    model: type[Model], names: tuple[str, ...], rows: int, then: str = "", first: str = "%s"
) -> str:
    columns = ", ".join(str(_field(model, name).column) for name in names)
    places = _places(len(names), rows, first)
    return f"INSERT INTO {_table(model)} ({columns}) VALUES {places} {then}"  # noqa: S608 - names of ours alone


# --- reading ------------------------------------------------------------------------------------------


@lru_cache(maxsize=4)
def _project_sql(vendor: str, *, lock: bool) -> str:
    locks = lock and vendor == "postgresql"
    blobs = f", pg_advisory_xact_lock_shared({lock_number(BLOBS)})" if locks else ""
    ending = " FOR UPDATE" if locks else ""
    where = f"WHERE id = %s AND deleted_at IS NULL{ending}"
    return f"SELECT {columns(Project)}{blobs} FROM {_table(Project)} {where}"  # noqa: S608 - names of ours alone


def project(project_id: UUID, *, lock: bool = False) -> Project | None:
    """A project that is not deleted.

    With `lock`, nobody else writes to it until the transaction ends, and no blob is collected.
    """
    vendor = connection.vendor
    with connection.cursor() as cursor:
        cursor.execute(_project_sql(vendor, lock=lock), [_to_database(vendor, Project, "id")(project_id)])
        row = cursor.fetchone()
    return None if row is None else instance(Project, row)


def existing(project: Project) -> dict[str, Existing]:
    """The current files without their bytes."""
    sql = (
        "SELECT file.path, file.revision, file.blob_id, blob.size "  # noqa: S608
        f"FROM {_table(CurrentFile)} file JOIN {_table(Blob)} blob ON blob.sha256 = file.blob_id "
        "WHERE file.project_id = %s"
    )
    with connection.cursor() as cursor:
        cursor.execute(sql, [_id(project)])
        return {row[0]: Existing(*row) for row in cursor.fetchall()}


def root_trees(projects: Sequence[UUID], largest: int) -> dict[UUID, str]:
    """The blob of the main tree of each of these projects, where it has one that is not larger."""
    file, owner, blob = _table(CurrentFile), _table(Project), _table(Blob)
    convert = _to_database(connection.vendor, Project, "id")
    found: dict[UUID, str] = {}
    for some in _portions(projects):
        of = {convert(key): key for key in some}
        places = ", ".join(["%s"] * len(some))
        sql = (
            f"SELECT {file}.project_id, {file}.blob_id FROM {file} "  # noqa: S608 - names of ours alone
            f"JOIN {owner} ON {owner}.id = {file}.project_id "
            f"JOIN {blob} ON {blob}.sha256 = {file}.blob_id AND {blob}.size <= %s "
            f"WHERE {file}.project_id IN ({places}) "
            f"AND {file}.path = 'trees/' || {owner}.main_tree || '.json'"
        )
        with connection.cursor() as cursor:
            cursor.execute(sql, [largest, *of])
            found |= {of[row[0]]: row[1] for row in cursor.fetchall()}
    return found


def taken_by_others(project: Project) -> int:
    """Bytes of all other projects of the owner."""
    sql = f"SELECT SUM(size) FROM {_table(Project)} WHERE owner_id = %s AND deleted_at IS NULL AND id <> %s"  # noqa: S608
    with connection.cursor() as cursor:
        cursor.execute(sql, [project.owner_id, _id(project)])
        return int(cursor.fetchone()[0] or 0)


# --- writing ------------------------------------------------------------------------------------------

_CHANGE: Final = ("project", "number", "author", "message", "label", "created_at")
_BLOB: Final = ("sha256", "size", "data")
_REVISION: Final = ("change", "path", "blob", "renamed_from")
_FILE: Final = ("project", "path", "path_key", "blob", "revision", "updated_at")
_PROJECT: Final = ("revision", "size", "updated_at", "id")
_NEW: Final = "ON CONFLICT DO NOTHING"
_NEWER: Final = (
    "ON CONFLICT (project_id, path_key) DO UPDATE SET path = EXCLUDED.path, revision = EXCLUDED.revision, "
    "updated_at = EXCLUDED.updated_at, blob_id = EXCLUDED.blob_id"
)


def write(writing: Writing) -> None:
    """Stores a change set with its files; then the change has its key."""
    # In one order, so that two saves of the same blobs never wait for each other.
    writing = writing._replace(blobs=sorted(writing.blobs))
    largest = max(len(writing.drafts), len(writing.revisions))
    if connection.vendor == "postgresql" and largest <= AT_ONCE:
        _write_at_once(writing)
    else:
        _write_one_by_one(writing)


def advance(project: Project) -> None:
    """Stores revision, size and time of a project."""
    values = _values(Project, _PROJECT, [[getattr(project, name) for name in _PROJECT]])
    with connection.cursor() as cursor:
        cursor.execute(_advance_sql(), values)


def forget_drafts(project: Project, author_id: int | None, paths: Sequence[str]) -> None:
    """Removes what this user typed into these files and had not saved."""
    with connection.cursor() as cursor:
        for some in _portions(paths):
            cursor.execute(_forget_sql(len(some)), [_id(project), author_id, *some])


def _change_values(change: ChangeSet) -> Parameters:
    row = [getattr(change, _field(ChangeSet, name).attname) for name in _CHANGE]
    return _values(ChangeSet, _CHANGE, [row])


def _file_rows(writing: Writing) -> list[tuple[object, ...]]:
    change = writing.change
    return [(change.project_id, *file, change.number, change.created_at) for file in writing.files]


def _portions(rows: Sequence[Any]) -> list[Sequence[Any]]:
    return [rows[start : start + ROWS] for start in range(0, len(rows), ROWS)]


def _write_one_by_one(writing: Writing) -> None:
    change = writing.change
    forget_drafts(change.project, change.author_id, writing.drafts)
    with connection.cursor() as cursor:
        cursor.execute(_insert_sql(ChangeSet, _CHANGE, 1, "RETURNING id"), _change_values(change))
        change.pk = cursor.fetchone()[0]
        revisions = [(change.pk, *row) for row in writing.revisions]
        for model, names, rows, then in (
            (Blob, _BLOB, writing.blobs, _NEW),
            (FileRevision, _REVISION, revisions, ""),
            (CurrentFile, _FILE, _file_rows(writing), _NEWER),
        ):
            for some in _portions(rows):
                cursor.execute(_insert_sql(model, names, len(some), then), _values(model, names, some))
    advance(change.project)


def _write_at_once(writing: Writing) -> None:
    change = writing.change
    numbers = (len(writing.blobs), len(writing.revisions), len(writing.files), len(writing.drafts))
    values = [
        *_change_values(change),
        *_values(Blob, _BLOB, writing.blobs),
        *_values(FileRevision, _REVISION[1:], writing.revisions),
        *_values(CurrentFile, _FILE, _file_rows(writing)),
        *([change.project_id, change.author_id, *writing.drafts] if writing.drafts else []),
        *_values(Project, _PROJECT, [[getattr(change.project, name) for name in _PROJECT]]),
    ]
    with connection.cursor() as cursor:
        cursor.execute(_at_once_sql(*numbers), values)
        change.pk = cursor.fetchone()[0]


@lru_cache(maxsize=256)
def _at_once_sql(blobs: int, revisions: int, files: int, drafts: int) -> str:
    """All in one: what one part writes the others do not see, and none needs to."""
    key = "(SELECT id FROM change)"
    parts = {
        "change": _insert_sql(ChangeSet, _CHANGE, 1, "RETURNING id"),
        "blobs": _insert_sql(Blob, _BLOB, blobs, _NEW) if blobs else "",
        "revisions": _insert_sql(FileRevision, _REVISION, revisions, first=key),
        "files": _insert_sql(CurrentFile, _FILE, files, _NEWER) if files else "",
        "drafts": _forget_sql(drafts) if drafts else "",
        "project": _advance_sql(),
    }
    listed = ", ".join(f"{name} AS ({sql})" for name, sql in parts.items() if sql)
    return f"WITH {listed} SELECT id FROM change"  # noqa: S608 - names of ours alone


def _advance_sql() -> str:
    return f"UPDATE {_table(Project)} SET revision = %s, size = %s, updated_at = %s WHERE id = %s"  # noqa: S608


def _forget_sql(paths: int) -> str:
    places = ", ".join(["%s"] * paths)
    return f"DELETE FROM {_table(Draft)} WHERE project_id = %s AND author_id = %s AND path IN ({places})"  # noqa: S608
