"""Moves recordings to the object store, and back. Each is read at either place meanwhile."""

from __future__ import annotations

import hashlib
import tempfile
from typing import IO, TYPE_CHECKING

from django.db import transaction

from backend.config.environment import environment
from backend.core.objects.errors import damaged
from backend.core.objects.store import new_key
from backend.runs import queries
from backend.runs.models import Run, RunPart
from backend.runs.objects import FOLDER
from backend.runs.writes import store_parts

if TYPE_CHECKING:
    from collections.abc import Iterator

    from django.db.models import QuerySet

    from backend.core.objects.store import ObjectStore

__all__ = ["movable", "move_back", "move_out", "moved"]


def movable() -> QuerySet[Run]:
    """Returns the runs in the database whose recordings belong in the store."""
    return Run.objects.filter(stored_at=None, size__gt=environment().object_store_from_bytes)


def moved() -> QuerySet[Run]:
    """Returns the runs whose recordings are in the store."""
    return Run.objects.filter(stored_at__isnull=False)


def move_out(bucket: ObjectStore) -> Iterator[int]:
    """Moves all recordings that belong in the store there; yields the size of each, in bytes."""
    for run in movable().order_by("id").defer("thumbnail"):
        with tempfile.TemporaryFile() as file:
            try:
                for part in queries.parts(run, 0, run.size):
                    file.write(part)
            except RunPart.DoesNotExist:  # the run was deleted meanwhile
                continue
            key = new_key(FOLDER, run.sha256)
            bucket.put(key, file, run.size, run.sha256)
        with transaction.atomic():
            is_done = movable().filter(pk=run.pk).update(stored_at=key)
            if is_done:
                RunPart.objects.filter(run=run).delete()
        if is_done:
            yield run.size
        else:
            bucket.delete([key])


def move_back(bucket: ObjectStore) -> Iterator[int]:
    """Moves all recordings that are in the store to the database; yields the size of each, in bytes."""
    for run in moved().order_by("id").defer("thumbnail"):
        key = str(run.stored_at)
        with tempfile.TemporaryFile() as file:
            if not _fetch(bucket, run, key, file):
                continue
            with transaction.atomic():
                is_done = moved().filter(pk=run.pk, stored_at=key).update(stored_at=None)
                if is_done:
                    store_parts(run, file)
        if is_done:
            bucket.delete([key])
            yield run.size


def _fetch(bucket: ObjectStore, run: Run, key: str, file: IO[bytes]) -> bool:
    """Fetches a recording; returns False if the run is gone."""
    if not moved().filter(pk=run.pk, stored_at=key).exists():
        return False
    digest = hashlib.sha256()
    for part in bucket.read(key):
        digest.update(part)
        file.write(part)
    if digest.hexdigest() != run.sha256:
        raise damaged(key, bucket.place)
    return True
