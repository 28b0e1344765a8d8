"""Moves the contents of blobs to the object store, and back. Each is read at either place meanwhile.

Each blob is a transaction of its own, so that a move that is interrupted continues where it was.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from django.db import transaction

from backend.config.environment import environment
from backend.core.locks import transaction_lock
from backend.core.objects.store import as_file, new_key
from backend.projects.models import Blob
from backend.projects.storage.at_once import BLOBS
from backend.projects.storage.blobs import FOLDER

if TYPE_CHECKING:
    from collections.abc import Iterator

    from django.db.models import QuerySet

    from backend.core.objects.store import ObjectStore


def movable() -> QuerySet[Blob]:
    """Returns the blobs in the database that belong in the store."""
    return Blob.objects.filter(stored_at=None, size__gt=environment().object_store_from_bytes)


def moved() -> QuerySet[Blob]:
    """Returns the blobs in the store."""
    return Blob.objects.filter(stored_at__isnull=False)


def move_out(bucket: ObjectStore) -> Iterator[int]:
    """Moves all that belongs in the store there; yields the size of each, in bytes."""
    for sha256 in list(movable().order_by("sha256").values_list("sha256", flat=True)):
        row = movable().filter(sha256=sha256).values_list("size", "data").first()
        if row is None:  # it is not referenced any more, or somebody else moved it
            continue
        size, key = row[0], new_key(FOLDER, sha256)
        bucket.put(key, as_file(bytes(row[1] or b"")), size, sha256)
        with transaction.atomic():
            transaction_lock(BLOBS, shared=True)
            is_done = movable().filter(sha256=sha256).update(stored_at=key, data=None)
        if is_done:
            yield size
        else:
            bucket.delete([key])


def move_back(bucket: ObjectStore) -> Iterator[int]:
    """Moves all that is in the store to the database; yields the size of each, in bytes."""
    nothing = {"stored_at": None, "unreferenced_at": None, "marked_at": None}
    for sha256, key in list(moved().order_by("sha256").values_list("sha256", "stored_at")):
        here = moved().filter(sha256=sha256, stored_at=key)
        if not here.exists():
            continue
        data = bucket.get(str(key), sha256)
        with transaction.atomic():
            transaction_lock(BLOBS, shared=True)
            is_done = here.update(data=data, **nothing)
        if is_done:
            bucket.delete([str(key)])  # not before: a row names its object until it has the bytes
            yield len(data)
