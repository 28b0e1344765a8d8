"""Unpacks untrusted archives: within limits, and never outside of the target folder."""

from __future__ import annotations

import base64
import binascii
import io
import stat
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Final

from translator.unzip import DAMAGED, ArchiveTooLargeError, chunks, open_zip

if TYPE_CHECKING:
    import zipfile

__all__ = ["ArchiveError", "unpack"]

MAX_FILES: Final = 5000
MAX_FILE_BYTES: Final = 100 << 20
MAX_TOTAL_BYTES: Final = 300 << 20
MAX_PATH_CHARACTERS: Final = 240


class ArchiveError(Exception):
    """The archive is refused; the text says why."""


def unpack(archive_base64: str, folder: Path) -> None:
    """Unpacks a zip, given as base64, into an existing folder.

    Raises:
        ArchiveError: the archive is not a zip, is damaged or too large, or contains a path outside of the
            folder.
    """
    try:
        data = base64.b64decode(archive_base64, validate=True)
    except (binascii.Error, ValueError) as error:
        raise ArchiveError(f"it is not base64: {error}") from error
    try:
        with open_zip(io.BytesIO(data)) as archive:
            _unpack_all(archive, folder)
    except ArchiveTooLargeError as error:
        raise ArchiveError(f"it is too large: {error}") from error
    except DAMAGED as error:
        raise ArchiveError(f"it cannot be unpacked: {error}") from error


def _unpack_all(archive: zipfile.ZipFile, folder: Path) -> None:
    entries = archive.infolist()
    if len(entries) > MAX_FILES:
        raise ArchiveError(f"it has {len(entries)} files, more than {MAX_FILES}")
    left = MAX_TOTAL_BYTES
    seen: set[str] = set()
    for entry in entries:
        path = _safe_path(entry)
        if str(path).casefold() in seen:
            raise ArchiveError(f"it has {entry.filename!r} twice")
        seen.add(str(path).casefold())
        target = folder / path
        if entry.is_dir():
            target.mkdir(parents=True, exist_ok=True)
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        left -= _extract(archive, entry, target, min(MAX_FILE_BYTES, left))


def _safe_path(entry: zipfile.ZipInfo) -> PurePosixPath:
    name = entry.filename
    path = PurePosixPath(name)
    kind = stat.S_IFMT(entry.external_attr >> 16)
    if kind not in {0, stat.S_IFREG, stat.S_IFDIR}:
        raise ArchiveError(f"{name!r} is neither a file nor a folder")
    if entry.flag_bits & 0x1:
        raise ArchiveError(f"{name!r} is encrypted")
    is_odd = "\\" in name or "\0" in name or ":" in name or len(name) > MAX_PATH_CHARACTERS
    if is_odd or path.is_absolute() or ".." in path.parts or not path.parts:
        raise ArchiveError(f"{name!r} is not a path inside the archive")
    return path


def _extract(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, target: Path, limit: int) -> int:
    """Writes one file, and returns the number of bytes written."""
    with target.open("xb") as sink:
        return sum(sink.write(chunk) for chunk in chunks(archive, entry, limit))
