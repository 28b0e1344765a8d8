"""Deletes objects that nothing names: of uploads that were not committed, and of rows that are gone."""

from __future__ import annotations

from datetime import timedelta
from itertools import islice
from typing import TYPE_CHECKING, Final

from django.utils import timezone

if TYPE_CHECKING:
    from collections.abc import Callable
    from datetime import datetime

    from backend.core.objects.store import ObjectStore

UNNAMED_FOR: Final = timedelta(hours=24)
"""An object that is younger may be of an upload whose commit is still to come."""
AT_ONCE: Final = 500


def sweep(
    bucket: ObjectStore,
    folder: str,
    named: Callable[[list[str]], set[str]],
    *,
    now: datetime | None = None,
    told: Callable[[int], None] = lambda _: None,
) -> int:
    """Deletes the objects of a folder that are older than a day and that no row names.

    Names are never used twice, so a row cannot begin to name such an object any more.

    Args:
        bucket: the store.
        folder: the folder.
        named: returns those of these objects that a row names.
        now: the time.
        told: is called with the number of objects that were looked at.

    Returns the number of deleted objects.
    """
    limit = (now or timezone.now()) - UNNAMED_FOR
    deleted = looked = 0
    listed = bucket.listed(folder)
    while found := list(islice(listed, AT_ONCE)):
        keys = [one.key for one in found if one.written_at < limit]
        known = named(keys)
        lost = [key for key in keys if key not in known]
        if lost:
            bucket.delete(lost)
        deleted, looked = deleted + len(lost), looked + len(found)
        told(looked)
    return deleted
