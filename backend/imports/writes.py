"""Writes an imported robot or universe into a project, as one revision."""

from __future__ import annotations

from itertools import count
from typing import TYPE_CHECKING, Final, NamedTuple

from backend.imports.errors import PartTakenError
from backend.projects.storage import queries, writes
from backend.projects.storage.access import Need
from backend.projects.storage.changes import Content, FileChange
from backend.projects.storage.manifest import MANIFEST, read, write

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from uuid import UUID

    from backend.accounts.models import User
    from backend.projects.models import Project
    from backend.projects.storage.changes import Existing, Source


_YAML: Final = ".yaml"


class Part(NamedTuple):
    """A robot or a universe that is written."""

    kind: str
    name: str
    is_used: bool
    replaces: bool


class Written(NamedTuple):
    """The project with the part, the revision before, and the paths that were written and removed."""

    project: Project
    previous: int
    paths: list[str]
    removed: list[str]


def prefixes(kind: str, name: str) -> tuple[str, ...]:
    """Returns the beginnings of the paths of a robot or universe."""
    return (f"robots/{name}/",) if kind == "robot" else (f"universes/{name}.yaml", f"assets/{name}/")


class FreeNames:
    """Names that no robot, or no universe, of a project has.

    Args:
        kind: `robot` or `universe`.
        paths: the paths of the project.
    """

    def __init__(self, kind: str, paths: Iterable[str]) -> None:
        self._taken = {name.casefold() for path in paths for name in _names(kind, path)}
        self._numbers: dict[str, int] = {}

    def like(self, name: str) -> str:
        """Returns this name, or one with a number."""
        if name.casefold() not in self._taken:
            return name
        stem = name[:55]
        key = stem.casefold()
        if key not in self._numbers:
            self._numbers[key] = next(n for n in count(2) if f"{key}_{n}" not in self._taken)
        return f"{stem}_{self._numbers[key]}"


def _names(kind: str, path: str) -> list[str]:
    """Returns the name of the robot or universe to which a path of a project belongs."""
    top, *below = path.split("/")
    folder = {"robot": "robots", "universe": "assets"}[kind]
    if top.casefold() == folder and len(below) > 1:
        return below[:1]
    is_universe = kind == "universe" and top.casefold() == "universes" and len(below) == 1
    return [below[0][: -len(_YAML)]] if is_universe and below[0].casefold().endswith(_YAML) else []


def require_free(kind: str, name: str, paths: Iterable[str]) -> None:
    """Raises PartTakenError if the project has a robot or universe of this name."""
    free = FreeNames(kind, paths).like(name)
    if free != name:
        what = "robot" if kind == "robot" else "universe"
        hint = f"Choose another name, such as {free}, or replace it."
        raise PartTakenError(
            f"The project has a {what} “{name}” already.", hint=hint, field="name", name=free
        )


def write_part(
    project_id: UUID, part: Part, files: Mapping[str, Source], *, acting_user: User, if_match: str
) -> Written:
    """Writes the files of a robot or universe completely or not at all.

    Raises:
        PartTakenError: the name exists, and is not to be replaced.
        RevisionConflictError, PreconditionFailedError, QuotaExceededError: as `save_files`.
    """
    project = queries.project(project_id, user=acting_user, need=Need.WRITE)
    before = project.revision
    existing = queries.existing_files(project)
    if not part.replaces:
        require_free(part.kind, part.name, existing)
    beginnings = prefixes(part.kind, part.name)
    removed = sorted(path for path in existing if path.startswith(beginnings) and path not in files)
    wanted = [FileChange(path, existing[path].revision, delete=True) for path in removed]
    wanted += [
        FileChange(path, existing[path].revision if path in existing else 0, content)
        for path, content in sorted(files.items())
    ]
    if part.is_used:
        wanted.append(_used(project, part, existing))
    message = f"Import the {part.kind} {part.name}"
    saved = writes.save_files(project_id, wanted, acting_user=acting_user, message=message, if_match=if_match)
    return Written(saved, before, sorted(files), removed)


def _used(project: Project, part: Part, existing: Mapping[str, Existing]) -> FileChange:
    raw = queries.current_files(project, [MANIFEST])[MANIFEST].data
    document = dict(read(raw).document) | {part.kind: part.name}
    return FileChange(MANIFEST, existing[MANIFEST].revision, Content.of(write(document)))
