"""Computes the effect of a change set on a project's files; does no I/O.

For each file a client sends the revision on which its edit is based: the file's own revision, or that of the
whole project when the file was read. Revisions only grow, so both show whether the file has changed since.
The revision 0 means that the file must not exist yet.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

from backend.core.problems import InvalidInputError
from backend.projects.storage import names

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


class Source(Protocol):
    """Bytes with the hash by which they are stored; they may be read from a file each time."""

    @property
    def sha256(self) -> str:
        """The hash."""

    @property
    def size(self) -> int:
        """The number of bytes."""

    @property
    def data(self) -> bytes:
        """The bytes."""


@dataclass(frozen=True, slots=True)
class Stored:
    """A content that a current or old file of some project has, so that its bytes need not be written."""

    sha256: str
    size: int


@dataclass(frozen=True, slots=True)
class Content:
    """Bytes in memory with the hash by which they are stored."""

    data: bytes = field(repr=False)
    sha256: str = ""
    size: int = 0

    @classmethod
    def of(cls, data: bytes) -> Content:
        """Returns the bytes with their hash."""
        return cls(data, hashlib.sha256(data).hexdigest(), len(data))


@dataclass(frozen=True, slots=True)
class FileChange:
    """A requested change of one file: new content, a new path, both, or its removal."""

    path: str
    base_revision: int
    content: Source | Stored | None = None
    delete: bool = False
    rename_to: str = ""


@dataclass(frozen=True, slots=True)
class Existing:
    """A file in its current state."""

    path: str
    revision: int
    sha256: str
    size: int


@dataclass(frozen=True, slots=True)
class Written:
    """A file after the change. If `content` is None, its bytes are those of the blob `sha256`."""

    path: str
    sha256: str
    size: int
    content: Source | None
    renamed_from: str = ""


@dataclass(frozen=True, slots=True)
class Conflict:
    """A file whose base revision is stale; `theirs` is the current file, or None if the file was removed."""

    change: FileChange
    path: str
    theirs: Existing | None


@dataclass(frozen=True, slots=True)
class Plan:
    """The writes of a change set; empty if the files already have the requested state."""

    written: tuple[Written, ...] = ()
    removed: tuple[str, ...] = ()
    conflicts: tuple[Conflict, ...] = ()

    @property
    def is_empty(self) -> bool:
        """Whether the files already have the requested state."""
        return not self.written and not self.removed


def plan(current: Mapping[str, Existing], wanted: Sequence[FileChange]) -> Plan:
    """Computes the effect of a change set on the current files, by path.

    Args:
        current: the files that exist.
        wanted: the changes; paths are already checked by `names.file_path`.

    Raises:
        InvalidInputError: the request is contradictory, or gives two files the same name.
    """
    _refuse_duplicates(wanted)
    by_key = {names.key(existing.path): existing for existing in current.values()}
    leaving = {c.path for c in wanted if c.delete or (c.rename_to and c.rename_to != c.path)}
    removed: list[str] = []
    written: list[Written] = []
    conflicts: list[Conflict] = []
    for change in wanted:
        existing = current.get(change.path)
        if conflict := _conflict(change, existing, by_key, leaving):
            conflicts.append(conflict)
        elif change.delete:
            removed.extend([change.path] if existing else [])
        elif change.rename_to and change.rename_to != change.path:
            assert existing is not None  # noqa: S101 - else it is a conflict
            removed.append(change.path)
            content = change.content or Stored(existing.sha256, existing.size)
            written.append(_written(change.rename_to, content, renamed_from=change.path))
        elif change.content and (existing is None or existing.sha256 != change.content.sha256):
            written.append(_written(change.path, change.content))
    if conflicts:
        return Plan(conflicts=tuple(conflicts))
    taken = {w.path for w in written}
    result = Plan(tuple(written), tuple(path for path in removed if path not in taken))
    _refuse_collisions(current, Plan(tuple(written), tuple(removed)))
    return result


def _written(path: str, content: Source | Stored, *, renamed_from: str = "") -> Written:
    source = None if isinstance(content, Stored) else content
    return Written(path, content.sha256, content.size, source, renamed_from)


def _conflict(
    change: FileChange, existing: Existing | None, by_key: Mapping[str, Existing], leaving: set[str]
) -> Conflict | None:
    if existing is None:
        # Deleting a file that no longer exists is not a conflict; every other change needs the file that the
        # client saw.
        if change.base_revision > 0 and not change.delete:
            return Conflict(change, change.path, None)
    elif not _is_same(change, existing) and existing.revision > change.base_revision:
        return Conflict(change, change.path, existing)
    if change.rename_to and change.rename_to != change.path:
        target = by_key.get(names.key(change.rename_to))
        if target is not None and target.path not in leaving:
            return Conflict(change, change.rename_to, target)
    return None


def _is_same(change: FileChange, existing: Existing) -> bool:
    """Returns whether the file already has the requested state: then a repeated save is no conflict."""
    return change.content is not None and not change.rename_to and change.content.sha256 == existing.sha256


def _refuse_duplicates(wanted: Sequence[FileChange]) -> None:
    seen: set[str] = set()
    for change in wanted:
        if change.path in seen:
            raise InvalidInputError(f"“{names.shown(change.path)}” is changed twice.", field="files")
        seen.add(change.path)
        if change.delete and (change.content is not None or change.rename_to):
            raise InvalidInputError("A file is either deleted or changed.", field="files")
        if not change.delete and change.content is None and not change.rename_to:
            raise InvalidInputError(
                f"Nothing is said about “{names.shown(change.path)}”.",
                hint="Give content, content_base64, rename_to or delete.",
                field="files",
            )
        if change.rename_to and change.base_revision == 0:
            raise InvalidInputError("A file that is renamed exists, so its base is not 0.", field="files")


def _refuse_collisions(current: Mapping[str, Existing], result: Plan) -> None:
    """Refuses two paths that some file systems cannot distinguish, and a file with the path of a folder."""
    paths = [path for path in current if path not in set(result.removed)]
    paths += [w.path for w in result.written if w.path not in current or w.path in result.removed]
    owners: dict[str, str] = {}
    for path in paths:
        other = owners.setdefault(names.key(path), path)
        if other is not path:
            raise InvalidInputError(
                f"“{names.shown(path)}” and “{names.shown(other)}” are the same name if case is ignored.",
                field="files",
            )
    for key, path in owners.items():
        for index, character in enumerate(key):
            if character == "/" and key[:index] in owners:
                raise InvalidInputError(
                    f"“{names.shown(owners[key[:index]])}” is a file, and “{names.shown(path)}” is in it.",
                    field="files",
                )
