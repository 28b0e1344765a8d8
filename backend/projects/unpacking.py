"""Archives are unpacked by two threads of their own, and no thread of a request waits for them.

Not by the pool of processes: an archive lies in a file, and may be larger than what a worker may hold. What
unpacking costs is bounded by the quota, and zlib lets other threads work meanwhile.
"""

from __future__ import annotations

import threading
from concurrent.futures import Future, ThreadPoolExecutor
from typing import IO, Final

from backend.projects import archive
from backend.workers.errors import BusyError

AT_ONCE: Final = 2
WAITING: Final = 8


class Unpacker:
    """Unpacks what it is given, in turn."""

    def __init__(self, at_once: int, waiting: int) -> None:
        self._threads = ThreadPoolExecutor(at_once, "unpacking")
        self._most, self._count, self._lock = at_once + waiting, 0, threading.Lock()

    def ask(self, data: IO[bytes], filename: str) -> Future[archive.Upload]:
        """Begins to read what a user brings, as soon as a thread is free; the file stays open until then.

        Raises:
            BusyError: too many archives wait already.
        """
        with self._lock:
            if self._count >= self._most:
                raise BusyError(
                    "The server has too many archives to unpack.", hint="Try again in a few seconds."
                )
            self._count += 1
        work = self._threads.submit(archive.read_upload, data, filename)
        work.add_done_callback(self._done)
        return work

    def _done(self, _: Future[archive.Upload]) -> None:
        with self._lock:
            self._count -= 1


unpacker: Final = Unpacker(AT_ONCE, WAITING)
