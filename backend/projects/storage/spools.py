"""Contents that wait in a temporary file until they are stored: a project is never whole in memory."""

from __future__ import annotations

import hashlib
import os
from dataclasses import dataclass
from typing import IO, TYPE_CHECKING

from backend.core.scratch import scratch

if TYPE_CHECKING:
    from collections.abc import Iterable
    from types import TracebackType
    from typing import Self


@dataclass(frozen=True, slots=True)
class Spooled:
    """A content in a temporary file; its bytes are read each time, until the spool is closed."""

    file: IO[bytes]
    start: int
    size: int
    sha256: str

    @property
    def data(self) -> bytes:
        """The bytes."""
        return os.pread(self.file.fileno(), self.size, self.start)


class Spool:
    """A temporary file with contents one after the other; it exists until `close`.

    Args:
        expected: the size of all in bytes, as far as known.

    Raises:
        NoRoomError: the temporary files of all users take too much.
        OSError: the disk is full.
    """

    def __init__(self, *, expected: int = 0) -> None:
        self._file = scratch().file(expected=expected)

    def add(self, parts: Iterable[bytes]) -> Spooled:
        """Adds a content that comes in parts.

        Raises:
            NoRoomError, OSError: as when it was made.
        """
        start, digest, size = self._file.tell(), hashlib.sha256(), 0
        for part in parts:
            digest.update(part)
            size += len(part)
            view = memoryview(part)
            while view:
                view = view[self._file.write(view) :]
        return Spooled(self._file, start, size, digest.hexdigest())

    def close(self) -> None:
        """Removes the file; further calls do nothing."""
        self._file.close()

    def __enter__(self) -> Self:
        """Returns itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None
    ) -> None:
        """Removes the file."""
        self.close()
