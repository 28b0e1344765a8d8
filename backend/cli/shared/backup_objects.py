"""The objects of the store in a backup: `objects/<name>` each, verified when written and when read.

A restored object gets a new name. Where no store is set then, the bytes go to the database.
"""

from __future__ import annotations

import hashlib
import re
import tempfile
from typing import IO, TYPE_CHECKING, Any, Final, NamedTuple

from backend.cli.shared.backup_error import BackupError
from backend.core.objects.errors import ObjectMissingError
from backend.core.objects.store import PART_BYTES, new_key, the_store, written_store
from backend.projects.models import Blob
from backend.projects.storage import blobs
from backend.runs import objects as runs
from backend.runs.models import Run
from backend.runs.writes import store_parts

if TYPE_CHECKING:
    import zipfile
    from collections.abc import Callable, Iterator

    from django.db.models import Model

_KEY: Final = re.compile(r"(blobs|runs)/[0-9a-f]{64}/[0-9a-f]{32}")
_FOLDERS: Final[dict[type[Model], str]] = {Blob: blobs.FOLDER, Run: runs.FOLDER}
_LEAVE_OUT: Final = "or write the backup without what is there: --without-objects"


class Copied(NamedTuple):
    """The number and bytes of the objects in a backup."""

    number: int
    size: int


def number_of_objects() -> int:
    """Returns how many objects rows name."""
    return sum(model._base_manager.filter(stored_at__isnull=False).count() for model in _FOLDERS)


def copy_objects(archive: zipfile.ZipFile, told: Callable[[str], None]) -> Copied:
    """Copies all objects that rows name to a backup.

    Raises:
        BackupError: one is missing or damaged, or moved while the backup was written.
        StoreError: the store cannot be used.
    """
    total, number, size = number_of_objects(), 0, 0
    if total:
        the_store().require_bucket()
    for key, expected, sha256 in _named():
        digest, found = hashlib.sha256(), 0
        try:
            with archive.open(_member(key), "w", force_zip64=True) as member:
                for part in the_store().read(key):
                    member.write(part)
                    digest.update(part)
                    found += len(part)
        except ObjectMissingError as error:
            raise BackupError(
                f"{error.detail} If it was moved just now, write the backup again; else bring it back, "
                f"{_LEAVE_OUT}."
            ) from error
        if (found, digest.hexdigest()) != (expected, sha256):
            raise BackupError(
                f"The object {key} in {the_store().place} is not what was stored: bring it back, "
                f"{_LEAVE_OUT}."
            )
        number, size = number + 1, size + found
        told(f"{number} of {total} objects, {size:,} bytes")
    told("")
    return Copied(number, size)


def _named() -> Iterator[tuple[str, int, str]]:
    for model in _FOLDERS:
        rows = model._base_manager.filter(stored_at__isnull=False).order_by("pk")
        yield from rows.values_list("stored_at", "size", "sha256").iterator()


def _member(key: str) -> str:
    return f"objects/{key}"


class Returning:
    """Brings the objects of one backup back.

    Args:
        archive: the backup.
        described: what its manifest says of objects.
    """

    def __init__(self, archive: zipfile.ZipFile, described: dict[str, Any]) -> None:
        self._archive = archive
        self._is_copied = described.get("copied") is True
        self._parts: list[tuple[Run, str]] = []

    def settle(self, row: Model) -> None:
        """Stores the object that a row names, before the row is written.

        Raises:
            BackupError: the object is missing or damaged.
            StoreError: the store cannot be used.
        """
        if not isinstance(row, Blob | Run) or row.stored_at is None:
            return
        key = row.stored_at
        if not _KEY.fullmatch(key) or not key.startswith(_FOLDERS[type(row)]):
            raise BackupError("The backup is damaged: a row names no object.")
        if not self._is_copied:
            self._require_there(key, row.size)
            return
        bucket = written_store(row.size)
        if bucket is None and isinstance(row, Run):
            row.stored_at = None
            self._parts.append((row, _member(key)))
            return
        with tempfile.TemporaryFile() as file:
            self._read(_member(key), row, file)
            if bucket is not None:
                row.stored_at = new_key(_FOLDERS[type(row)], row.sha256)
                bucket.put(row.stored_at, file, row.size, row.sha256)
            elif isinstance(row, Blob):
                file.seek(0)
                row.stored_at, row.data = None, file.read()

    def finish(self) -> None:
        """Stores the recordings that go to the database, once the rows of all tables are there."""
        for run, member in self._parts:
            with tempfile.TemporaryFile() as file:
                self._read(member, run, file)
                store_parts(run, file)

    def _require_there(self, key: str, size: int) -> None:
        try:
            is_there = the_store().size(key) == size
        except ObjectMissingError:
            is_there = False
        if not is_there:
            raise BackupError(
                f"The backup was written without objects, and {key} is not in {the_store().place}: "
                "copy the bucket there first."
            )

    def _read(self, name: str, row: Blob | Run, file: IO[bytes]) -> None:
        digest = hashlib.sha256()
        with self._archive.open(name) as member:
            while file.tell() <= row.size and (part := member.read(PART_BYTES)):
                digest.update(part)
                file.write(part)
        if (file.tell(), digest.hexdigest()) != (row.size, row.sha256):
            raise BackupError(f"The backup is damaged: {name} is not what was written.")
