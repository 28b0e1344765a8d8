"""The answer of the child about an upload. It has read a stranger's files, so all of it is checked."""

from __future__ import annotations

import base64
import binascii
import errno
from contextlib import contextmanager
from functools import partial
from pathlib import PurePosixPath
from typing import IO, TYPE_CHECKING, Annotated, Any, Final, Literal

import msgspec
from msgspec import Meta

from backend.config.environment import environment
from backend.imports.errors import ImportChoiceError, ImportRefusedError
from backend.projects.errors import ArchiveError, QuotaExceededError
from backend.projects.storage import names
from translator.unzip import DAMAGED, ArchiveTooLargeError, chunks, is_zip, open_zip

if TYPE_CHECKING:
    import zipfile
    from collections.abc import Iterator, Sequence

    from backend.projects.storage.spools import Spool, Spooled

PART: Final = 1024 * 1024
_Text = Annotated[str, Meta(max_length=20_000)]
_Name = Annotated[str, Meta(pattern=r"^[A-Za-z0-9_-]{1,60}\Z")]
_TOO_MUCH: Final = "Reading it takes more time or memory than an import may take."


class Argument(msgspec.Struct):
    """An argument of macros."""

    name: _Text
    default: _Text | None


class Item(msgspec.Struct):
    """A robot, a world or a map in an upload."""

    kind: Literal["robot", "universe"]
    source: Literal["urdf", "xacro", "sdf", "map"]
    path: _Text
    name: _Name
    is_main: bool
    arguments: Annotated[list[Argument], Meta(max_length=1_000)]


class Line(msgspec.Struct):
    """A line of a report."""

    file: _Text
    line: int | None
    text: _Text


class Found(msgspec.Struct):
    """A reason why it cannot be imported."""

    file: _Text
    line: int
    message: _Text
    hint: _Text


class File(msgspec.Struct):
    """A file for the project: its bytes, or the path of the same file in the upload."""

    path: _Text
    base64: str | None = None
    source: _Text | None = None


class Report(msgspec.Struct):
    """The lines about parts that were taken, assumed and left out."""

    taken: list[Line]
    assumed: list[Line]
    left_out: list[Line]


class Drive(msgspec.Struct):
    """A test drive: 1 m and 360° commanded."""

    way_m: float
    aside_m: float
    turn_deg: float
    fits: bool


class _Error(msgspec.Struct):
    code: _Text
    message: str
    items: list[Item] = []
    diagnostics: list[Found] = []


class _Answer(msgspec.Struct):
    error: _Error | None = None
    items: Annotated[list[Item], Meta(max_length=500)] = []
    left_out: list[Line] = []
    name: _Name | None = None
    path: _Text = ""
    files: Annotated[list[File], Meta(max_length=20_000)] = []
    report: Report = msgspec.field(default_factory=lambda: Report([], [], []))
    test_drive: Drive | None = None
    can_simplify: bool = False
    things: int | None = None


def read(answer: bytes) -> _Answer:
    """Returns the answer of the child.

    Raises:
        ArchiveError, QuotaExceededError, ImportChoiceError, ImportRefusedError: it says that it cannot.
        OSError: the disk is full.
    """
    try:
        found = msgspec.json.decode(answer, type=_Answer)
    except (msgspec.DecodeError, UnicodeError) as error:
        raise ImportRefusedError(_TOO_MUCH, hint="Import a part of it.", diagnostics=[]) from error
    if found.error is not None:
        _refuse(found.error)
    return found


def _refuse(error: _Error) -> None:
    if error.code == "bad_archive":
        raise ArchiveError(error.message, field="file")
    if error.code in ("quota_exceeded", "too_large"):
        raise QuotaExceededError(error.message, hint="Import a part of it.", field="file")
    if error.code == "disk_full":
        if not environment().has_containers:
            raise OSError(errno.ENOSPC, "no space left for the upload")
        text = "The upload holds more than can be unpacked on this server."
        raise QuotaExceededError(text, hint="Import a part of it.", field="file")
    if error.code == "choice":
        text = (
            "It is not clear which file is meant." if error.items else "There is nothing of this kind in it."
        )
        items = [msgspec.to_builtins(item) for item in error.items]
        raise ImportChoiceError(text, hint=error.message[:1_000], field="main", items=items)
    found: list[dict[str, Any]] = [msgspec.to_builtins(each) for each in error.diagnostics[:200]]
    text = error.message
    if found:
        text = f"{found[0]['file']}:{found[0]['line']}: {found[0]['message']}"
    raise ImportRefusedError(text[:2_000], hint=found[0]["hint"] if found else "", diagnostics=found)


def contents(
    files: Sequence[File], upload: IO[bytes], prefixes: Sequence[str], spool: Spool
) -> dict[str, Spooled]:
    """Returns the contents of the files, by their paths in the project.

    Args:
        files: the files of the answer.
        upload: the uploaded file.
        prefixes: the beginnings of the paths that an import may write.
        spool: the file with the contents.

    Raises:
        ImportRefusedError: a path leads elsewhere, or a content is missing.
        QuotaExceededError: they are larger than a project may be.
    """
    made: dict[str, Spooled] = {}
    sources: dict[str, list[str]] = {}
    for file in files:
        path = names.writable_path(file.path)
        if not path.startswith(tuple(prefixes)):
            raise ImportRefusedError("The import would write outside of its folder.", diagnostics=[])
        if file.source is not None:
            sources.setdefault(file.source, []).append(path)
            continue
        try:
            data = base64.b64decode(file.base64 or "", validate=True)
        except (binascii.Error, ValueError) as error:
            raise ImportRefusedError(_TOO_MUCH, diagnostics=[]) from error
        made[path] = spool.add([data])
    left = environment().max_project_bytes - sum(content.size for content in made.values())
    for source, content in _of_upload(upload, sources, left, spool).items():
        made |= dict.fromkeys(sources[source], content)
    return made


def _of_upload(
    upload: IO[bytes], sources: dict[str, list[str]], most: int, spool: Spool
) -> dict[str, Spooled]:
    if not sources:
        return {}
    if not is_zip(upload):
        return _of_file(upload, sources, most, spool)
    found: dict[str, Spooled] = {}
    with _said():
        archive = open_zip(upload)
    with archive:
        entries = {PurePosixPath(entry.filename).as_posix(): entry for entry in archive.infolist()}
        for source, paths in sources.items():
            if source not in entries:
                raise ImportRefusedError(_TOO_MUCH, diagnostics=[])
            found[source] = spool.add(_parts(archive, entries[source], most))
            most -= found[source].size * len(paths)
    return found


def _parts(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, most: int) -> Iterator[bytes]:
    with _said():  # but not what is wrong with the disk to which they are written
        yield from chunks(archive, entry, most)


@contextmanager
def _said() -> Iterator[None]:
    """Reports what is wrong with a zip."""
    try:
        yield
    except ArchiveTooLargeError as error:
        raise _too_large() from error
    except DAMAGED as error:
        raise ArchiveError(f"This is not a zip that can be read: {error}.", field="file") from error


def _of_file(upload: IO[bytes], sources: dict[str, list[str]], most: int, spool: Spool) -> dict[str, Spooled]:
    """Returns the content of a single file, which is the source of all."""
    if upload.seek(0, 2) * sum(map(len, sources.values())) > most:
        raise _too_large()
    upload.seek(0)
    return dict.fromkeys(sources, spool.add(iter(partial(upload.read, PART), b"")))


def _too_large() -> QuotaExceededError:
    text = "What would be imported is larger than a project may be."
    return QuotaExceededError(text, hint="Import a part of it.", field="file")
