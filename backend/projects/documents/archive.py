"""Reads zips from untrusted sources."""

from __future__ import annotations

import stat
import zipfile
import zlib
from pathlib import PurePosixPath
from typing import IO, TYPE_CHECKING, Final, NamedTuple

from backend.config.environment import environment
from backend.core.problems import InvalidInputError
from backend.projects.errors import ArchiveError, QuotaExceededError
from backend.projects.storage import names
from backend.projects.storage.manifest import MANIFEST

if TYPE_CHECKING:
    from collections.abc import Iterator

_CHUNK: Final = 256 * 1024
XML_SUFFIXES: Final = (".xml", ".btproj")
_JUNK: Final = ("__MACOSX/", "__pycache__/")


def unpack(data: IO[bytes]) -> dict[str, bytes]:
    """Returns the files of an untrusted zip, by their paths in the new project.

    Sizes in headers are not trusted: reading stops at the quota. If all files are in one folder, that folder
    is removed.

    Raises:
        ArchiveError: the data are not a zip, or have entries that are not plain files.
        InvalidInputError: the path of an entry is invalid, for example because it leaves the project.
        QuotaExceededError: the zip holds more than a project may.
    """
    try:
        with zipfile.ZipFile(data) as archive:
            files = dict(_entries(archive))
    except (
        zipfile.BadZipFile,
        zlib.error,
        EOFError,
        NotImplementedError,  # zipfile raises it for an unknown compression
        RuntimeError,
        UnicodeError,
    ) as error:
        raise ArchiveError(f"This is not a zip that can be read: {error}.", field="file") from error
    if not files:
        raise ArchiveError("The zip holds no files.", field="file")
    return _without_common_folder(files)


def _entries(archive: zipfile.ZipFile) -> Iterator[tuple[str, bytes]]:
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
        content = _read(archive, entry, min(left, limits.max_file_bytes))
        left -= len(content)
        yield path, content


def _read(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, limit: int) -> bytes:
    content = bytearray()
    with archive.open(entry) as stream:
        while chunk := stream.read(_CHUNK):
            content += chunk
            if len(content) > limit:
                raise QuotaExceededError(
                    f"“{names.shown(entry.filename)}” unpacks to more than a project may hold.", field="file"
                )
    return bytes(content)


def _is_junk(name: str) -> bool:
    return (
        names.is_of_tool(name)
        or name.startswith(_JUNK)
        or "/__pycache__/" in name
        or name.rpartition("/")[2] == ".DS_Store"
    )


def _without_common_folder(files: dict[str, bytes]) -> dict[str, bytes]:
    if MANIFEST in files:
        return files
    folder, slash, _ = next(iter(files)).partition("/")
    if not slash or not all(path.startswith(folder + "/") for path in files):
        return files
    return {path.removeprefix(folder + "/"): content for path, content in files.items()}


class Upload(NamedTuple):
    """An imported project.

    Attributes:
        files: the contents by path.
        is_ours: whether the upload is a project of BT Studio; the translator opens others.
        name: the name of the new project, if the content has none.
    """

    files: dict[str, bytes]
    is_ours: bool
    name: str


def _named(name: PurePosixPath) -> str:
    """Returns the path of a single imported file; its name, if allowed, is also that of the project."""
    suffix = name.suffix.lower()
    try:
        return names.file_path(f"{name.stem}{suffix}")
    except InvalidInputError:
        return f"import{suffix}"


def read_upload(data: IO[bytes], filename: str) -> Upload:
    """Returns the files of an upload: a zip of BT Studio, JdeRobot or Groot2, or one XML file.

    Raises:
        ArchiveError, InvalidInputError, QuotaExceededError: for the same reasons as `unpack`.
    """
    name = PurePosixPath(filename)
    if name.suffix.lower() in XML_SUFFIXES:
        content = data.read(environment().max_file_bytes + 1)
        if len(content) > environment().max_file_bytes:
            raise QuotaExceededError(f"“{names.shown(filename)}” is larger than a file may be.", field="file")
        return Upload({_named(name): content}, is_ours=False, name=name.stem)
    files = unpack(data)
    return Upload(files, MANIFEST in files, name.stem)
