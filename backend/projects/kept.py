"""Contents of files that were used lately, so that each save need not fetch the whole project again.

A content is named by its hash, so what is kept is never out of date.
"""

from __future__ import annotations

from collections import OrderedDict
from threading import Lock
from typing import TYPE_CHECKING, Final

from backend.projects.models import Blob

if TYPE_CHECKING:
    from collections.abc import Iterable

LARGEST: Final = 256 * 1024
"""Bytes; larger contents are fetched each time."""
ROOM: Final = 48 * 1024 * 1024
"""Bytes of all contents that this process keeps."""


class _Kept:
    def __init__(self) -> None:
        self._lock = Lock()
        self._contents: OrderedDict[str, bytes] = OrderedDict()
        self._size = 0

    def put(self, sha256: str, data: bytes) -> None:
        """Keeps a content; what was not used for longest goes."""
        if len(data) > LARGEST:
            return
        with self._lock:
            if sha256 not in self._contents:
                self._contents[sha256] = data
                self._size += len(data)
            while self._size > ROOM:
                self._size -= len(self._contents.popitem(last=False)[1])

    def get(self, wanted: Iterable[str]) -> dict[str, bytes]:
        """Those that are kept."""
        found = {}
        with self._lock:
            for sha256 in wanted:
                data = self._contents.get(sha256)
                if data is not None:
                    self._contents.move_to_end(sha256)
                    found[sha256] = data
        return found


_kept: Final = _Kept()
put: Final = _kept.put


def contents(wanted: Iterable[str]) -> dict[str, bytes]:
    """The contents of these hashes, in at most one query."""
    hashes = set(wanted)
    found = _kept.get(hashes)
    if missing := hashes - found.keys():
        for sha256, data in Blob.objects.filter(sha256__in=missing).values_list("sha256", "data"):
            found[sha256] = bytes(data)
            _kept.put(sha256, found[sha256])
    return found
