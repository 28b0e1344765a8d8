"""The collection of all objects of the store: of projects and of runs."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING

from backend.core.objects.errors import StoreError
from backend.core.objects.store import store

if TYPE_CHECKING:
    from collections.abc import Callable
    from datetime import datetime

    from backend.core.objects.store import ObjectStore
    from backend.projects.storage.collection import Collected

log = logging.getLogger(__name__)


def collect_daily() -> None:
    """Collects where a store is set. One that does not answer is asked again on the next day."""
    bucket = store()
    if bucket is None:
        return
    try:
        found = collect_objects(bucket)
    except StoreError as error:
        log.warning("no objects were collected: %s %s", error.detail, error.hint)
    else:
        log.info("objects: %d marked, %d deleted, %d without a row", *found)


def collect_objects(
    bucket: ObjectStore,
    *,
    now: datetime | None = None,
    told: Callable[[int], None] = lambda _: None,
) -> Collected:
    """Collects what nothing has needed for a day; `told` gets the number of objects that were looked at."""
    from backend.core.objects.sweep import sweep  # noqa: PLC0415 - models must be loaded
    from backend.projects.storage.collection import collect  # noqa: PLC0415 - as above
    from backend.runs.objects import FOLDER, named  # noqa: PLC0415 - as above

    found = collect(bucket, now=now, told=told)
    of_runs = sweep(bucket, FOLDER, named, now=now, told=told)
    return found._replace(swept=found.swept + of_runs)
