"""Temporary files of requests. Their total size is limited, so that they never fill the disk.

The files have no names, so none remains after a crash. Folders have; those of a process that was killed are
deleted with the next one. Each worker of a server gets an equal part of the
limit; keys apply to all workers.
"""

from __future__ import annotations

import errno
import fcntl
import io
import os
import shutil
import tempfile
import threading
import time
from contextlib import contextmanager, suppress
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from django.core.files.uploadedfile import UploadedFile
from django.core.files.uploadhandler import FileUploadHandler

from backend.config.environment import environment
from backend.core.problems import ServerBusyError, StudioError
from backend.core.processes.siblings import siblings

if TYPE_CHECKING:
    from collections.abc import Iterator

    from _typeshed import ReadableBuffer

    from backend.core.processes.siblings import Place


MARKED_WITHIN_S: Final = 60.0
"""The age from which a folder is marked as used, if it is."""


class NoRoomError(ServerBusyError):
    """The temporary files of all users together have reached the limit."""

    retry_after_s = 15


class AlreadyThereError(StudioError):
    """The user already has a temporary file with this key; each user may have one at a time."""

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
        """The number of bytes in use."""
        with self._lock:
            return self._used

    def file(self, *, expected: int = 0, key: str = "") -> ScratchFile:
        """Makes a new file.

        Args:
            expected: the size in bytes, as far as known. The bytes are not reserved, since a slow sender
                would then keep others out.
            key: an optional key; only one file of a key exists at a time.

        Raises:
            NoRoomError: the limit is reached.
            AlreadyThereError: a file with this key exists already.
            OSError: the disk is full, or almost full (ENOSPC).
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

    @contextmanager
    def directory(self) -> Iterator[Path]:
        """Makes a folder for a tool that needs names, and deletes it and those of processes that were killed.

        Its files are not counted, since the tool limits them itself.

        Raises:
            OSError: the disk is full.
        """
        self.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        self._sweep()
        with (
            tempfile.TemporaryDirectory(dir=self.folder, ignore_cleanup_errors=True) as made,
            _opened(Path(made)) as mark,
        ):
            fcntl.flock(mark, fcntl.LOCK_EX)  # the end of this process releases it
            yield Path(made)

    def _sweep(self) -> None:
        for left in self.folder.iterdir():
            with suppress(OSError):  # gone by now, in use, or a file
                if time.time() - left.stat().st_mtime < MARKED_WITHIN_S:
                    continue
                with _opened(left) as mark:
                    fcntl.flock(mark, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    shutil.rmtree(left, ignore_errors=True)

    def take(self, size: int) -> None:
        """Adds bytes to the count, before they are written."""
        with self._lock:
            self._require(size)
            self._used += size

    def give_back(self, size: int, place: Place | None) -> None:
        """Subtracts bytes from the count, and releases the place of the key."""
        with self._lock:
            self._used -= size
            if place is not None:
                place.give_back()

    def _require(self, size: int) -> None:
        if self._used + size > self._most:
            raise NoRoomError(
                "The large files that are being sent take all the space that is reserved for them.",
                hint="Try again in a minute.",
            )
        if shutil.disk_usage(self.folder).free - size < self._reserve:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


@contextmanager
def _opened(folder: Path) -> Iterator[int]:
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    try:
        yield descriptor
    finally:
        os.close(descriptor)


class ScratchFile(io.FileIO):
    """A temporary file that counts its bytes against the limit."""

    def __init__(self, scratch: Scratch, place: Place | None) -> None:
        self._taken, self._place, self._scratch = 0, place, scratch
        descriptor, name = tempfile.mkstemp(dir=scratch.folder)
        os.unlink(name)  # noqa: PTH108 - a name without a Path
        super().__init__(descriptor, "r+")

    def write(self, data: ReadableBuffer) -> int:
        """Writes at the current position; only bytes beyond the end count."""
        end = self.tell() + memoryview(data).nbytes
        # The free disk space is checked even if no byte is added: other programs fill the disk, too.
        more = max(0, end - self._taken)
        self._scratch.take(more)
        self._taken += more
        return super().write(data)

    def close(self) -> None:
        """Closes the file, which deletes it, and subtracts its bytes from the count."""
        if not self.closed:
            super().close()
            self._scratch.give_back(self._taken, self._place)


@lru_cache(maxsize=1)
def scratch() -> Scratch:
    """Returns the temporary files of this process."""
    settings = environment()
    most = settings.max_temporary_bytes // (siblings.family.size if siblings.family else 1)
    return Scratch(settings.data_dir / "uploads", most, settings.min_free_bytes)


class ScratchUploads(FileUploadHandler):
    """Writes the files of forms to temporary files, as Django's upload handler."""

    def new_file(self, *args: Any, **kwargs: Any) -> None:
        """Opens a temporary file for the next upload of a form."""
        super().new_file(*args, **kwargs)
        self.file = scratch().file()

    def receive_data_chunk(self, raw_data: bytes, start: int) -> None:
        """Writes the next part of the file."""
        view = memoryview(raw_data)
        try:
            while view:
                view = view[self.file.write(view) :]
        except BaseException:
            self.file.close()  # Django closes only complete files
            raise

    def file_complete(self, file_size: int) -> UploadedFile[Any]:
        """Returns the complete file."""
        self.file.seek(0)
        return UploadedFile(self.file, self.file_name, self.content_type, file_size, self.charset)

    def upload_interrupted(self) -> None:
        """Closes the incomplete file, since the client has disconnected."""
        if hasattr(self, "file"):
            self.file.close()
