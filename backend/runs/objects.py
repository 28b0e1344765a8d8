"""Recordings in the object store: one object each, uploaded and verified before its row is committed."""

from __future__ import annotations

from contextlib import contextmanager
from typing import IO, TYPE_CHECKING, Final

from backend.core.objects.store import new_key, written_store
from backend.core.problems import StudioError
from backend.runs.models import Run

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["FOLDER", "named", "placed"]

FOLDER: Final = "runs/"


@contextmanager
def placed(file: IO[bytes], size: int, sha256: str) -> Iterator[str | None]:
    """Uploads a large recording; the block commits the row that names it.

    Yields the name of the object; None where the recording goes to the database.
    """
    bucket = written_store(size)
    if bucket is None:
        yield None
        return
    key = new_key(FOLDER, sha256)
    bucket.put(key, file, size, sha256)
    try:
        yield key
    except StudioError:  # refused: nothing names it. After any other error it may have been committed
        bucket.delete([key])
        raise


def named(keys: list[str]) -> set[str]:
    """Returns those of these objects that are the recording of a run."""
    return {str(key) for key in Run.objects.filter(stored_at__in=keys).values_list("stored_at", flat=True)}
