"""The one door through which zips are opened for reading.

Whatever a zip's end record says, its directory is bounded before an object is made of each entry, and only
compressions that unpack piece by piece are read.
"""

from __future__ import annotations

import zipfile
import zlib
from typing import IO, TYPE_CHECKING, Final, NamedTuple, cast

from translator.limits import ARCHIVE_DIRECTORY_BYTES, ARCHIVE_ENTRIES

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["DAMAGED", "PROJECT", "ArchiveTooLargeError", "Limits", "chunks", "is_zip", "open_zip"]

DAMAGED: Final = (
    zipfile.BadZipFile,
    zlib.error,
    EOFError,
    NotImplementedError,  # an unknown compression
    RuntimeError,  # an encrypted entry
    ValueError,
    OSError,
)
"""What `zipfile` and this module raise for a zip that cannot be read."""
_CHUNK: Final = 256 * 1024
_ENTRY: Final = b"PK\1\2"
_BEGINNINGS: Final = (b"PK\3\4", b"PK\5\6")
# `zipfile` unpacks other compressions without a bound: 1 MB of bzip2 can become 20 GB in one step.
_METHODS: Final = frozenset({zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED})


class ArchiveTooLargeError(Exception):
    """The zip, or what an entry unpacks to, is larger than allowed; the text says in what."""


class Limits(NamedTuple):
    """The largest directory of a zip.

    Attributes:
        directory_bytes: its size.
        entries: the number of its entries, folders included.
    """

    directory_bytes: int
    entries: int


PROJECT: Final = Limits(ARCHIVE_DIRECTORY_BYTES, ARCHIVE_ENTRIES)


def is_zip(data: IO[bytes]) -> bool:
    """Returns whether a file begins as a zip does; the next read is from its beginning."""
    data.seek(0)
    found = data.read(4) in _BEGINNINGS
    data.seek(0)
    return found


def open_zip(data: IO[bytes], limits: Limits = PROJECT) -> zipfile.ZipFile:
    """Opens a zip for reading.

    Raises:
        ArchiveTooLargeError: its directory is larger than the limits.
        zipfile.BadZipFile, NotImplementedError, ValueError, OSError: it cannot be read (`DAMAGED`).
    """
    archive = zipfile.ZipFile(cast("IO[bytes]", _Guarded(data, limits)))
    archive.fp = data
    for entry in archive.infolist():
        if entry.compress_type not in _METHODS:
            archive.close()
            # the kind that `zipfile` raises for a compression that it does not know
            raise NotImplementedError(f"{entry.filename!r} has a compression other than deflate")
    return archive


def chunks(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, limit: int) -> Iterator[bytes]:
    """Yields the content of an entry; the size in the zip's directory may be wrong.

    Raises:
        ArchiveTooLargeError: it unpacks to more than `limit` bytes.
    """
    left = limit
    with archive.open(entry) as source:
        while chunk := source.read(_CHUNK):
            left -= len(chunk)
            if left < 0:
                raise ArchiveTooLargeError(f"{entry.filename!r} unpacks to more than {limit} bytes")
            yield chunk


class _Guarded:
    """The file of a zip while it is opened: no read is larger than its directory may be.

    `zipfile` reads the directory in one step, so there is no need to find its size in the end records, which
    can be written so that two readers find different ones.
    """

    def __init__(self, file: IO[bytes], limits: Limits) -> None:
        self._file, self._limits = file, limits
        self.seek, self.tell = file.seek, file.tell

    def read(self, size: int = -1) -> bytes:
        most = self._limits.directory_bytes
        if size > most:
            raise ArchiveTooLargeError(f"its directory is larger than {most >> 20} MB")
        data = self._file.read(size)
        if data.count(_ENTRY) > self._limits.entries:
            raise ArchiveTooLargeError(f"it has more than {self._limits.entries} entries")
        return data
