"""Writes all data of a server to one file, and reads it into any database of this version or the next ones.

A backup is a zip: `manifest.json`, and one `tables/<model>.jsonl` for each table, with one row in each line.
The database is read in one transaction, so the backup is the state of one moment, also while people work.
Data that have a meaning only while a server runs are omitted: sign-ins, executors, a drain, leases, stored
answers for repeated requests. What is in the object store follows (`backup_objects`).
"""

from __future__ import annotations

import hashlib
import io
import json
import zipfile
from datetime import UTC, datetime
from typing import IO, TYPE_CHECKING, Any, Final

from django.apps import apps
from django.core import serializers
from django.core.exceptions import FieldDoesNotExist
from django.core.management.color import no_style
from django.core.serializers.json import DjangoJSONEncoder
from django.db import DatabaseError, connection, transaction

from backend import __version__
from backend.cli.shared.backup_age import applied_migrations, require_readable
from backend.cli.shared.backup_error import BackupError
from backend.cli.shared.backup_objects import Returning, copy_objects, number_of_objects
from translator.unzip import DAMAGED, ArchiveTooLargeError, Limits, chunks, open_zip

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from django.db.models import Model

FORMAT: Final = "bt-studio/backup"
VERSION: Final = 1
MANIFEST: Final = "manifest.json"
LEFT_OUT: Final = frozenset(
    {
        "admin.logentry",
        "auth.permission",
        "contenttypes.contenttype",
        "executor_sessions.drain",
        "executor_sessions.lease",
        "executor_sessions.session",
        "executor_sessions.warmexecutor",
        "projects.idempotencykey",
        "sessions.session",
    }
)
ROWS_AT_ONCE: Final = 50
MAX_LINE_BYTES: Final = 512 * 1024 * 1024
MAX_MANIFEST_BYTES: Final = 64 * 1024 * 1024
LIMITS: Final = Limits(directory_bytes=512 * 1024 * 1024, entries=2_000_000)
"""A backup has an entry for each object of the store; 2 million of them take about 1.5 GB when it is read."""


def write_backup(
    target: IO[bytes], *, has_objects: bool = True, told: Callable[[str], None] = lambda _: None
) -> dict[str, int]:
    """Writes a backup; returns the number of rows of each table.

    Args:
        target: the file.
        has_objects: whether it also gets what is in the object store.
        told: is called with the progress.

    Raises:
        BackupError: an object is missing or damaged, or there are too many for one file.
        StoreError: the object store cannot be used.
    """
    tables: dict[str, dict[str, Any]] = {}
    if has_objects and number_of_objects() + len(_models()) >= LIMITS.entries:
        raise BackupError(
            f"There are more than {LIMITS.entries} objects in the store, too many for one file: keep a "
            "backup of the bucket, and write this one with --without-objects."
        )
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive, _snapshot():
        for model in _models():
            name = model._meta.label_lower
            digest, rows = hashlib.sha256(), 0
            with archive.open(_member(name), "w", force_zip64=True) as member:
                for line in _lines(model):
                    member.write(line)
                    digest.update(line)
                    rows += 1
            tables[name] = {"rows": rows, "sha256": digest.hexdigest()}
        copied = copy_objects(archive, told) if has_objects else None
        manifest = {
            "format": FORMAT,
            "version": VERSION,
            "bt_studio": __version__,
            "made_at": datetime.now(UTC).isoformat(timespec="seconds"),
            "migrations": applied_migrations(),
            "tables": tables,
            "objects": {
                "copied": copied is not None,
                "number": copied.number if copied is not None else number_of_objects(),
            },
        }
        archive.writestr(MANIFEST, json.dumps(manifest, indent=1))
    return {name: table["rows"] for name, table in tables.items()}


def read_backup(source: IO[bytes]) -> dict[str, int]:
    """Reads a backup into an empty database, completely or not at all.

    Returns the number of rows of each table.

    Raises:
        BackupError: the backup is damaged, or of a later version or one that is too old, or the database is
            not empty.
    """
    try:
        with open_zip(source, LIMITS) as archive:
            manifest = _manifest(archive)
            for name, table in manifest["tables"].items():
                _check(archive, name, table)
            return _load(archive, manifest)
    except (serializers.base.DeserializationError, FieldDoesNotExist, DatabaseError) as error:
        raise BackupError(f"The backup does not have the rows of this version: {error}.") from error
    except (ArchiveTooLargeError, KeyError, TypeError, *DAMAGED) as error:
        raise BackupError(f"This is no readable backup: {error}.") from error


class _ExactEncoder(DjangoJSONEncoder):
    """Encodes times with their microseconds, which Django's encoder leaves out."""

    def default(self, o: Any) -> Any:
        return o.isoformat() if isinstance(o, datetime) else super().default(o)


class _snapshot(transaction.Atomic):  # noqa: N801 - used as a function
    """A transaction that reads the state of one moment."""

    def __init__(self) -> None:
        super().__init__(using=None, savepoint=True, durable=False)

    def __enter__(self) -> None:
        super().__enter__()
        if connection.vendor == "postgresql" and len(connection.savepoint_ids) == 0:
            with connection.cursor() as cursor:
                cursor.execute("SET TRANSACTION ISOLATION LEVEL REPEATABLE READ, READ ONLY")


def _models() -> list[type[Model]]:
    """Returns the tables of a backup, in an order in which they can be filled."""
    models = [model for model in apps.get_models() if model._meta.label_lower not in LEFT_OUT]
    ordered: list[type[Model]] = serializers.sort_dependencies([(None, models)], allow_cycles=True)
    return ordered


def _lines(model: type[Model]) -> Iterator[bytes]:
    rows = model._base_manager.order_by("pk").iterator(chunk_size=ROWS_AT_ONCE)
    for row in rows:
        yield serializers.serialize("jsonl", [row], cls=_ExactEncoder).strip().encode() + b"\n"


def _member(name: str) -> str:
    return f"tables/{name}.jsonl"


def _manifest(archive: zipfile.ZipFile) -> dict[str, Any]:
    try:
        content = chunks(archive, archive.getinfo(MANIFEST), MAX_MANIFEST_BYTES)
        manifest = json.loads(b"".join(content))
    except (KeyError, ValueError) as error:
        raise BackupError("This is no backup of BT Studio: it has no manifest.") from error
    if not isinstance(manifest, dict) or manifest.get("format") != FORMAT:
        raise BackupError("This is no backup of BT Studio.")
    made_by = manifest.get("bt_studio")
    if manifest.get("version") != VERSION:
        raise BackupError(
            f"The backup was made by BT Studio {made_by} in another format than that of {__version__}: "
            "restore it with that version, and upgrade then."
        )
    is_earlier = require_readable(manifest.get("migrations"), made_by, LEFT_OUT)
    if is_earlier:
        # Before there was an object store, nothing was said of it.
        manifest.setdefault("objects", {"copied": True, "number": 0})
    _require_tables(manifest, is_earlier=is_earlier)
    return manifest


def _require_tables(manifest: dict[str, Any], *, is_earlier: bool) -> None:
    """Checks that a backup has the tables of this version, but for those that an earlier one had not."""
    expected = {model._meta.label_lower for model in _models()}
    found = set(manifest["tables"]) - LEFT_OUT
    is_complete = found <= expected if is_earlier else found == expected
    if not is_complete or not isinstance(manifest.get("objects"), dict):
        raise BackupError("The backup does not have the tables of this version.")


def _check(archive: zipfile.ZipFile, name: str, table: dict[str, Any]) -> None:
    digest = hashlib.sha256()
    with archive.open(_member(name)) as member:
        while chunk := member.read(1 << 20):
            digest.update(chunk)
    if digest.hexdigest() != table["sha256"]:
        raise BackupError(f"The backup is damaged: the table {name} is not what was written.")


def _load(archive: zipfile.ZipFile, manifest: dict[str, Any]) -> dict[str, int]:
    models = _models()
    project = apps.get_model("projects", "Project")
    if project._base_manager.exists():
        raise BackupError(
            "There are projects here already. A backup is restored into an empty server: "
            "another data folder, or an empty database."
        )
    with transaction.atomic():
        connection.check_constraints()
        for model in reversed(models):  # the local user, whom the first start creates
            model._base_manager.all().delete()
        with connection.constraint_checks_disabled():
            returning = Returning(archive, manifest["objects"])
            there = [model for model in models if model._meta.label_lower in manifest["tables"]]
            counts = {model._meta.label_lower: _fill(archive, model, returning) for model in there}
        connection.check_constraints()
        with connection.cursor() as cursor:
            for statement in connection.ops.sequence_reset_sql(no_style(), models):
                cursor.execute(statement)
        returning.finish()
    wrong = [name for name, rows in counts.items() if rows != manifest["tables"][name]["rows"]]
    if wrong:
        raise BackupError(f"The backup is damaged: rows of {', '.join(wrong)} are missing.")
    return counts


def _fill(archive: zipfile.ZipFile, model: type[Model], returning: Returning) -> int:
    rows = 0
    with archive.open(_member(model._meta.label_lower)) as member:
        for line in _read_lines(member):
            for found in serializers.deserialize("jsonl", line):
                if found.object._meta.model is not model:
                    raise BackupError("The backup is damaged: a row is in the wrong table.")
                returning.settle(found.object)
                found.save()
                rows += 1
    return rows


def _read_lines(member: IO[bytes]) -> Iterable[str]:
    lines = io.BufferedReader(member, 1 << 20)  # type: ignore[type-var]
    while line := lines.readline(MAX_LINE_BYTES + 1):
        if len(line) > MAX_LINE_BYTES:
            raise BackupError("The backup is damaged: a row is too long.")
        yield line.decode()
