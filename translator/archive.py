"""Reads foreign folders and zips into memory: bounded, and without paths that leave the project."""

from __future__ import annotations

import io
import os
import stat
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

from translator.diagnostic import Diagnostic, Place, TranslatorError, diagnostic
from translator.foreign import is_of_tool
from translator.limits import (
    ARCHIVE_ENTRIES,
    ARCHIVED_FILE_BYTES,
    FILES_PER_PROJECT,
    PROJECT_BYTES,
    megabytes,
)
from translator.unzip import DAMAGED, ArchiveTooLargeError, chunks, open_zip

if TYPE_CHECKING:
    import zipfile
    from collections.abc import Iterator

SKIPPED_FOLDERS = {"__pycache__", "__MACOSX", "node_modules"}


def _error(code: str, file: str, **values: object) -> TranslatorError:
    found: Diagnostic = diagnostic(code, Place(file, line=1, column=1), **values)
    return TranslatorError([found])


def safe_path(name: str) -> str | None:
    """Returns the normalised path of an entry, or None if the path leaves the project."""
    if "\\" in name or "\0" in name or name.startswith("/") or (len(name) > 1 and name[1] == ":"):
        return None
    parts = PurePosixPath(name).parts
    if ".." in parts or not parts or len(name) > 1_000 or any(ord(char) < 32 for char in name):
        return None
    try:
        name.encode("utf-8")
    except UnicodeEncodeError:
        return None
    return "/".join(parts)


def read_zip(raw: bytes, *, file: str = "project.zip") -> dict[str, bytes]:
    """Returns the files of a zip, by path; a single folder that holds all of them is removed.

    Raises:
        TranslatorError: If the data are not a zip, contain links or paths that leave the project, or are too
            large.
    """
    try:
        with open_zip(io.BytesIO(raw)) as archive:
            return without_top_folder(dict(_entries(archive, file)))
    except ArchiveTooLargeError:
        limit = f"{ARCHIVE_ENTRIES} entries or {megabytes(PROJECT_BYTES)}"
        raise _error("BT0922", file, limit=limit) from None
    except DAMAGED:
        raise _error("BT0920", file) from None


def _entries(archive: zipfile.ZipFile, file: str) -> Iterator[tuple[str, bytes]]:
    entries = archive.infolist()
    if len(entries) > FILES_PER_PROJECT:
        raise _error("BT0922", file, limit=f"{FILES_PER_PROJECT} files")
    total = 0
    seen: set[str] = set()
    for entry in entries:
        path = safe_path(entry.filename)
        kind = stat.S_IFMT(entry.external_attr >> 16)
        if path is None or kind not in {0, stat.S_IFREG, stat.S_IFDIR} or path in seen:
            raise _error("BT0921", file, path=entry.filename[:200].encode("utf-8", "replace").decode())
        if entry.is_dir() or is_of_tool(path) or not SKIPPED_FOLDERS.isdisjoint(path.split("/")):
            continue
        seen.add(path)
        data = b"".join(chunks(archive, entry, min(ARCHIVED_FILE_BYTES, PROJECT_BYTES - total)))
        total += len(data)
        yield path, data


def without_top_folder(files: dict[str, bytes]) -> dict[str, bytes]:
    """Removes the folder that contains all files, if there is one, as in a zip of a folder."""
    tops = {path.partition("/")[0] for path in files}
    if len(tops) != 1 or any("/" not in path for path in files):
        return files
    top = tops.pop()
    if top in {"trees", "actions", "code"}:
        return files
    return {path[len(top) + 1 :]: raw for path, raw in files.items()}


def read_folder(folder: Path) -> dict[str, bytes]:
    """Returns the files of a folder, by path; hidden folders and links are left out.

    Raises:
        TranslatorError: If a file cannot be read, or the files are too many or too large.
    """
    files: dict[str, bytes] = {}
    total = 0
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(
            name for name in folders if name not in SKIPPED_FOLDERS and not is_of_tool(f"{name}/")
        )
        for name in sorted(names):
            path = Path(place, name)
            if is_of_tool(name) or path.is_symlink() or not path.is_file():
                continue
            total += path.stat().st_size
            if total > PROJECT_BYTES or len(files) >= FILES_PER_PROJECT:
                raise _error(
                    "BT0922", str(folder), limit=f"{FILES_PER_PROJECT} files or {megabytes(PROJECT_BYTES)}"
                )
            files[path.relative_to(folder).as_posix()] = read_file(path)
    return files


def read_file(path: Path) -> bytes:
    """Returns the bytes of a file.

    Raises:
        TranslatorError: If the file does not exist, or cannot be read.
    """
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise _error("BT0925", str(path)) from None
    except OSError as error:
        raise _error("BT0926", str(path), problem=error.strerror or str(error)) from None
