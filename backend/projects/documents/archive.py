"""Reads zips from untrusted sources. Their contents are unpacked into a temporary file."""

from __future__ import annotations

import stat
from contextlib import contextmanager
from pathlib import PurePosixPath
from typing import IO, TYPE_CHECKING, Final, NamedTuple

from backend.config.environment import environment
from backend.core.problems import InvalidInputError
from backend.projects.errors import ArchiveError, QuotaExceededError
from backend.projects.storage import names
from backend.projects.storage.manifest import MANIFEST
from backend.projects.storage.spools import Spool
from translator.unzip import DAMAGED, ArchiveTooLargeError, chunks, open_zip

if TYPE_CHECKING:
    import zipfile
    from collections.abc import Iterator

    from backend.projects.storage.spools import Spooled

XML_SUFFIXES: Final = (".xml", ".btproj")
_JUNK: Final = ("__MACOSX/", "__pycache__/")


def unpack(data: IO[bytes], spool: Spool) -> dict[str, Spooled]:
    """Returns the files of an untrusted zip, by their paths in the new project; `spool` has their contents.

    Sizes in headers are not trusted: reading stops at the quota. If all files are in one folder, that folder
    is removed.

    Raises:
        ArchiveError: the data are not a zip, or have entries that are not plain files.
        InvalidInputError: the path of an entry is invalid, for example because it leaves the project.
        QuotaExceededError: the zip holds more than a project may.
        NoRoomError: the temporary files of all users take too much.
        OSError: the disk is full.
    """
    with _said():
        archive = open_zip(data)
    with archive:
        files = dict(_entries(archive, spool))
    if not files:
        raise ArchiveError("The zip holds no files.", field="file")
    return _without_common_folder(files)


@contextmanager
def _said() -> Iterator[None]:
    """Reports what is wrong with a zip."""
    try:
        yield
    except ArchiveTooLargeError as error:
        raise QuotaExceededError(f"The zip holds more than a project may: {error}.", field="file") from error
    except DAMAGED as error:
        raise ArchiveError(f"This is not a zip that can be read: {error}.", field="file") from error


def _entries(archive: zipfile.ZipFile, spool: Spool) -> Iterator[tuple[str, Spooled]]:
    limits = environment()
    entries = [entry for entry in archive.infolist() if not entry.is_dir() and not _is_junk(entry.filename)]
    if len(entries) > limits.max_project_files:
        raise QuotaExceededError(f"The zip holds more than {limits.max_project_files} files.", field="file")
    left = limits.max_project_bytes
    seen: set[str] = set()
    for entry in entries:
        path = names.file_path(entry.filename, field="file")
        if path in seen:
            raise ArchiveError(f"The zip holds “{names.shown(path)}” twice.", field="file")
        seen.add(path)
        kind = stat.S_IFMT(entry.external_attr >> 16)
        if kind not in {0, stat.S_IFREG}:
            raise ArchiveError(f"“{names.shown(path)}” is a link or a device, not a file.", field="file")
        if entry.flag_bits & 0x1:
            raise ArchiveError("The zip is encrypted.", hint="Make one without a password.", field="file")
        content = spool.add(_parts(archive, entry, min(left, limits.max_file_bytes)))
        left -= content.size
        yield path, content


def _parts(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, most: int) -> Iterator[bytes]:
    with _said():  # but not what is wrong with the disk to which they are written
        yield from chunks(archive, entry, most)


def _is_junk(name: str) -> bool:
    return (
        names.is_of_tool(name)
        or name.startswith(_JUNK)
        or "/__pycache__/" in name
        or name.rpartition("/")[2] == ".DS_Store"
    )


def _without_common_folder(files: dict[str, Spooled]) -> dict[str, Spooled]:
    if MANIFEST in files:
        return files
    folder, slash, _ = next(iter(files)).partition("/")
    if not slash or not all(path.startswith(folder + "/") for path in files):
        return files
    return {path.removeprefix(folder + "/"): content for path, content in files.items()}


class Upload(NamedTuple):
    """An imported project.

    Attributes:
        files: the contents by path, until `spool` is closed.
        is_ours: whether the upload is a project of BT Studio; the translator opens others.
        name: the name of the new project, if the content has none.
        spool: the file with the contents.
    """

    files: dict[str, Spooled]
    is_ours: bool
    name: str
    spool: Spool


def _named(name: PurePosixPath) -> str:
    """Returns the path of a single imported file; its name, if allowed, is also that of the project."""
    suffix = name.suffix.lower()
    try:
        return names.file_path(f"{name.stem}{suffix}")
    except InvalidInputError:
        return f"import{suffix}"


def read_upload(data: IO[bytes], filename: str) -> Upload:
    """Returns the files of an upload: a zip of BT Studio, JdeRobot or Groot2, or one XML file.

    The caller closes its spool.

    Raises:
        ArchiveError, InvalidInputError, QuotaExceededError, NoRoomError, OSError: as `unpack`.
    """
    name = PurePosixPath(filename)
    spool = Spool()
    try:
        if name.suffix.lower() not in XML_SUFFIXES:
            files = unpack(data, spool)
            return Upload(files, MANIFEST in files, name.stem, spool)
        content = spool.add([data.read(environment().max_file_bytes + 1)])
        if content.size > environment().max_file_bytes:
            raise QuotaExceededError(f"“{names.shown(filename)}” is larger than a file may be.", field="file")
        return Upload({_named(name): content}, is_ours=False, name=name.stem, spool=spool)
    except BaseException:
        spool.close()
        raise
