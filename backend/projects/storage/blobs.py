"""Where the bytes of a blob are: in the database, or in the object store.

An object is uploaded and verified before the transaction that names it, so no locks wait for the store. A
blob that is there already is not uploaded again, unless the collection has marked it: it may be gone soon.
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

from backend.core.objects.errors import ObjectMissingError
from backend.core.objects.store import as_file, new_key, the_store, written_store
from backend.core.problems import StudioError
from backend.projects.models import Blob
from backend.projects.storage.changes import Stored

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping

    from backend.projects.storage.changes import Source

FOLDER: Final = "blobs/"


@contextmanager
def placed(
    contents: Iterable[Source | Stored | None], may_write: Callable[[], object]
) -> Iterator[Mapping[str, str]]:
    """Uploads the large ones of these contents; the block commits the rows that name them.

    Without an object store, it does nothing.

    Args:
        contents: the contents of a change.
        may_write: raises an error if the user may not write; called before anything is uploaded.

    Yields the names of the new objects, by the hashes of the contents.
    """
    new = (one for one in contents if one is not None and not isinstance(one, Stored))
    large = {one.sha256: one for one in new if written_store(one.size)}
    if not large:
        yield {}
        return
    may_write()
    known = Blob.objects.filter(sha256__in=list(large), marked_at=None).values_list("sha256", flat=True)
    uploaded: dict[str, str] = {}
    for sha256 in sorted(large.keys() - set(known)):
        key = new_key(FOLDER, sha256)
        the_store().put(key, as_file(large[sha256].data), large[sha256].size, sha256)
        uploaded[sha256] = key
    try:
        yield uploaded
    except StudioError:
        # The change was refused, so nothing names them. After any other error it may have been committed.
        the_store().delete(uploaded.values())
        raise


def bytes_of(sha256: str, data: bytes | memoryview | None, stored_at: str | None) -> bytes:
    """Returns the bytes of a blob, given its columns.

    Raises:
        StoreError: they are in the object store, and it cannot be used, or does not have them.
    """
    if data is not None:
        return bytes(data)
    try:
        return the_store().get(stored_at or "", sha256)
    except ObjectMissingError:
        # It may have been moved since the row was read.
        row = Blob.objects.filter(sha256=sha256).values_list("data", "stored_at").first()
        if row is None or row == (None, stored_at):
            raise
        return bytes(row[0]) if row[0] is not None else the_store().get(row[1] or "", sha256)
