"""Collects what is in the object store and is not needed: blobs without references, and objects without rows.

A blob that nothing references is noted, is marked 24 h later, and is then deleted. The row goes first, in a
transaction that locks it and looks for references again; its object goes after the commit. So a process that
is killed at any moment leaves no row without its object, and at most an object without a row, which a later
sweep deletes. `blobs.placed` uploads the content of a marked blob again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from django.db import transaction
from django.db.models import Exists, OuterRef, Q
from django.utils import timezone

from backend.core.locks import transaction_lock
from backend.core.objects.sweep import UNNAMED_FOR, sweep
from backend.projects.models import Blob, CurrentFile, FileRevision
from backend.projects.storage.at_once import BLOBS
from backend.projects.storage.blobs import FOLDER

if TYPE_CHECKING:
    from collections.abc import Callable
    from datetime import datetime

    from django.db.models import QuerySet

    from backend.core.objects.store import ObjectStore

UNREFERENCED_FOR: Final = UNNAMED_FOR
AT_ONCE: Final = 100
"""The largest number of blobs that one transaction deletes: saves wait for it."""


class Collected(NamedTuple):
    """The result of a collection."""

    marked: int
    deleted: int
    swept: int
    """Objects that no row named."""


def collect(
    bucket: ObjectStore,
    *,
    now: datetime | None = None,
    told: Callable[[int], None] = lambda _: None,
) -> Collected:
    """Notes, marks and deletes; `told` gets the number of objects that were looked at."""
    now = now or timezone.now()
    note(now)
    marked = mark(now)
    deleted = delete(bucket)
    return Collected(marked, deleted, sweep(bucket, FOLDER, named, now=now, told=told))


def note(now: datetime) -> None:
    """Notes which blobs are not referenced, and forgets it of those that are referenced again."""
    stored = _stored()
    stored.filter(_unreferenced(), unreferenced_at=None).update(unreferenced_at=now)
    again = stored.filter(~_unreferenced(), unreferenced_at__isnull=False)
    again.update(unreferenced_at=None, marked_at=None)


def mark(now: datetime) -> int:
    """Marks the blobs that were not referenced for 24 h; returns their number."""
    due = _stored().filter(marked_at=None, unreferenced_at__lte=now - UNREFERENCED_FOR)
    return due.update(marked_at=now)


def delete(bucket: ObjectStore) -> int:
    """Deletes the marked blobs that are still not referenced; returns their number."""
    deleted = 0
    after = ""
    while True:
        marked = _stored().filter(marked_at__isnull=False, sha256__gt=after).order_by("sha256")
        chosen = list(marked.values_list("sha256", flat=True)[:AT_ONCE])
        if not chosen:
            return deleted
        after = chosen[-1]
        keys = delete_rows(chosen)
        bucket.delete(keys)
        deleted += len(keys)


@transaction.atomic
def delete_rows(chosen: list[str]) -> list[str]:
    """Deletes these rows if they are marked and not referenced; returns the objects that they named.

    The lock waits for the saves that may have found one of them, and the rows are read after it.
    """
    transaction_lock(BLOBS)
    rows = Blob.objects.select_for_update().filter(sha256__in=chosen, marked_at__isnull=False)
    locked = list(rows.order_by("sha256").values_list("sha256", flat=True))
    unreferenced = Blob.objects.filter(_unreferenced(), sha256__in=locked, stored_at__isnull=False)
    keys = [str(key) for key in unreferenced.values_list("stored_at", flat=True)]
    Blob.objects.filter(stored_at__in=keys).delete()
    return keys


def named(keys: list[str]) -> set[str]:
    """Returns those of these objects that are the content of a blob."""
    return {str(key) for key in Blob.objects.filter(stored_at__in=keys).values_list("stored_at", flat=True)}


def _stored() -> QuerySet[Blob]:
    return Blob.objects.filter(stored_at__isnull=False)


def _unreferenced() -> Q:
    uses = (model.objects.filter(blob=OuterRef("pk")) for model in (FileRevision, CurrentFile))
    revision, current = (Exists(found) for found in uses)
    return Q(~revision & ~current)
