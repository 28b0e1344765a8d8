"""Unpacks an uploaded file into a folder: plain files alone, below it alone."""

from __future__ import annotations

import errno
import stat
from pathlib import Path, PurePosixPath
from typing import IO, TYPE_CHECKING, Final

from translator.foreign import is_of_tool
from translator.unzip import DAMAGED, ArchiveTooLargeError, chunks, is_zip, open_zip

if TYPE_CHECKING:
    import zipfile

MOST_BYTES: Final = 512 << 20
"""Bytes of all files of an upload together."""
_ARCHIVES: Final = (".zip", ".tar", ".gz", ".tgz", ".bz2", ".xz", ".7z")
_JUNK: Final = frozenset({"__MACOSX", "__pycache__", ".DS_Store"})


class UploadError(Exception):
    """The upload cannot be read; the text is a sentence.

    Args:
        code: `bad_archive` or `quota_exceeded`.
        message: the sentence.
    """

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.code = code


class Notes(list[tuple[str, str]]):
    """The paths that were left out, each with the reason."""


def unpack(data: IO[bytes], name: str, folder: Path) -> Notes:
    """Writes the files of a zip, or a single file, into an empty folder; returns what is left out.

    Raises:
        UploadError: it cannot be read, or is too large.
        OSError: the disk is full.
    """
    notes = Notes()
    try:
        if is_zip(data):
            with open_zip(data) as archive:
                _extract(archive, folder, notes)
        elif name.lower().endswith(".zip"):
            raise UploadError("bad_archive", "This is not a zip that can be read: it does not begin as one.")
        else:
            raw = data.read(MOST_BYTES + 1)
            if len(raw) > MOST_BYTES:
                raise ArchiveTooLargeError(f"it has more than {MOST_BYTES >> 20} MB")
            (folder / _single(name)).write_bytes(raw)
    except ArchiveTooLargeError as error:
        raise UploadError("quota_exceeded", f"The upload holds more than is read: {error}.") from error
    except OSError as error:
        if error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
            raise
        raise UploadError("bad_archive", f"This is not a zip that can be read: {_words(error)}.") from error
    except DAMAGED as error:
        raise UploadError("bad_archive", f"This is not a zip that can be read: {error}.") from error
    return notes


def _extract(archive: zipfile.ZipFile, folder: Path, notes: Notes) -> None:
    left = MOST_BYTES
    for entry in archive.infolist():
        if entry.is_dir() or is_of_tool(entry.filename) or not _JUNK.isdisjoint(entry.filename.split("/")):
            continue
        path = _below(entry.filename)
        if stat.S_IFMT(entry.external_attr >> 16) not in {0, stat.S_IFREG}:
            notes.append((entry.filename, "links and devices are not followed"))
            continue
        if entry.flag_bits & 0x1:
            raise UploadError("bad_archive", "The zip is encrypted: make one without a password.")
        if path.suffix.lower() in _ARCHIVES:
            notes.append((entry.filename, "an archive inside of the archive is not opened"))
            continue
        target = folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        if target.exists():
            raise UploadError("bad_archive", f"The zip holds {entry.filename!r} twice.")
        with target.open("xb") as out:
            for chunk in chunks(archive, entry, left):
                left -= len(chunk)
                out.write(chunk)


def _below(name: str) -> PurePosixPath:
    """Returns the path of an entry, which must lie below the folder."""
    path = PurePosixPath(name)
    if path.is_absolute() or ".." in path.parts or "\\" in name or "\0" in name:
        raise UploadError("bad_archive", f"The path {name!r} of an entry leads out of the zip.")
    return path


def _single(name: str) -> str:
    """Returns the name of a single file."""
    clean = "".join(part for part in name.replace("\\", "/").rpartition("/")[2] if part.isprintable())
    if not clean or clean in (".", ".."):
        raise UploadError("bad_archive", "The file has no name.")
    return clean[-200:]


def _words(error: OSError) -> str:
    return (error.strerror or str(error)).lower()
