"""Files that are there while a request is: together bounded, and never the last room of the disk.

None of them has a name, so that nothing is left of one whatever happens. The workers of one server share the
bound equally, and the keys.
"""

from __future__ import annotations

import errno
import io
import os
import shutil
import tempfile
import threading
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from django.core.files.uploadedfile import UploadedFile
from django.core.files.uploadhandler import FileUploadHandler

from backend.config.environment import environment
from backend.core.problems import StudioError
from backend.core.processes.siblings import siblings

if TYPE_CHECKING:
    from pathlib import Path

    from _typeshed import ReadableBuffer

    from backend.core.processes.siblings import Place


class NoRoomError(StudioError):
    """All users' large bodies, uploads and downloads together take what they may."""

    status = 503
    code = "busy"
    title = "Busy"
    retry_after_s = 15


class AlreadyThereError(StudioError):
    """Of some files one user has one at a time."""

    status = 429
    code = "throttled"
    title = "Too many requests"
    retry_after_s = 15


class Scratch:
    """The temporary files of this process."""

    def __init__(self, folder: Path, most: int, reserve: int) -> None:
        self.folder, self._most, self._reserve = folder, most, reserve
        self._lock = threading.Lock()
        self._used = 0

    @property
    def used(self) -> int:
        """Returns the number of bytes that are taken."""
        with self._lock:
            return self._used

    def file(self, *, expected: int = 0, key: str = "") -> ScratchFile:
        """A new file.

        Args:
            expected: how many bytes it will have, as far as that is known. They are not taken yet: a slow
                sender would keep others out.
            key: there is only one file of a key at a time.

        Raises:
            NoRoomError, AlreadyThereError: not now.
            OSError: the disk is full, or as good as full (ENOSPC).
        """
        self.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        with self._lock:
            self._require(expected)
            place = siblings.take(key, 1) if key else None
            if key and place is None:
                sentence = "A large file of this kind is on its way to you already."
                raise AlreadyThereError(sentence, hint="Wait until it has arrived.")
            try:
                return ScratchFile(self, place)
            except OSError:
                if place is not None:
                    place.give_back()
                raise

    def take(self, size: int) -> None:
        """Counts bytes before they are written."""
        with self._lock:
            self._require(size)
            self._used += size

    def give_back(self, size: int, place: Place | None) -> None:
        """Counts them no longer."""
        with self._lock:
            self._used -= size
            if place is not None:
                place.give_back()

    def _require(self, size: int) -> None:
        if self._used + size > self._most:
            raise NoRoomError(
                "The large files that are on their way take all the room that there is for them.",
                hint="Try again in a minute.",
            )
        if shutil.disk_usage(self.folder).free - size < self._reserve:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


class ScratchFile(io.FileIO):
    """A file that counts what it takes."""

    def __init__(self, scratch: Scratch, place: Place | None) -> None:
        self._taken, self._place, self._scratch = 0, place, scratch
        descriptor, name = tempfile.mkstemp(dir=scratch.folder)
        os.unlink(name)  # noqa: PTH108 - a name without a Path
        super().__init__(descriptor, "r+")

    def write(self, data: ReadableBuffer) -> int:
        """Writes at the end, or over what is there."""
        end = self.tell() + memoryview(data).nbytes
        # Where nothing is left to count, the disk is still looked at: others fill it, too.
        more = max(0, end - self._taken)
        self._scratch.take(more)
        self._taken += more
        return super().write(data)

    def close(self) -> None:
        """Ends the file, which has no name, and gives back its room."""
        if not self.closed:
            super().close()
            self._scratch.give_back(self._taken, self._place)


@lru_cache(maxsize=1)
def scratch() -> Scratch:
    """The temporary files of this process."""
    settings = environment()
    most = settings.max_temporary_bytes // (siblings.family.size if siblings.family else 1)
    return Scratch(settings.data_dir / "uploads", most, settings.min_free_bytes)


class ScratchUploads(FileUploadHandler):
    """Django's hook: files of forms are temporary files like any other."""

    def new_file(self, *args: Any, **kwargs: Any) -> None:
        """A file of a form begins."""
        super().new_file(*args, **kwargs)
        self.file = scratch().file()

    def receive_data_chunk(self, raw_data: bytes, start: int) -> None:
        """More of it."""
        view = memoryview(raw_data)
        try:
            while view:
                view = view[self.file.write(view) :]
        except BaseException:
            self.file.close()  # Django closes only what has come to its end
            raise

    def file_complete(self, file_size: int) -> UploadedFile[Any]:
        """All of it."""
        self.file.seek(0)
        return UploadedFile(self.file, self.file_name, self.content_type, file_size, self.charset)

    def upload_interrupted(self) -> None:
        """There is no more of it."""
        if hasattr(self, "file"):
            self.file.close()
