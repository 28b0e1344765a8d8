"""All functions that read projects. The number of queries of each does not grow with the project."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final, Literal, NamedTuple, TypeVar

from django.db.models import (
    Count,
    Exists,
    F,
    Max,
    OuterRef,
    Q,
    QuerySet,
    Subquery,
    prefetch_related_objects,
)
from django.db.models.functions import Lower

from backend import __version__
from backend.core.problems import NotFoundError
from backend.core.readers import reserve
from backend.projects.choices import Role
from backend.projects.models import ChangeSet, CurrentFile, Draft, FileRevision, Project
from backend.projects.storage import access, cache, names, rows
from backend.projects.storage.access import Need
from backend.projects.storage.conditions import all_paths, conditions

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from datetime import datetime
    from uuid import UUID

    from backend.accounts.models import User
    from backend.projects.storage.changes import Existing

LARGEST_DRAWN: Final = 256 * 1024
"""The largest main tree, in bytes, that is drawn on a project's card.

Larger trees would make the list take seconds.
"""

LARGEST_SOURCE: Final = 64 * 1024
"""The largest action, in bytes, that is read to see whether a block of a card is a condition."""
DRAWN: Final = 4 * 1024 * 1024
"""Bytes of all trees, and of all actions, that are read for one list; further projects have no picture."""

LISTED_FILES: Final = 10_000
"""The largest number of files on one page of a history."""
LARGEST_COMPARED: Final = 1024 * 1024
"""The largest file, in bytes, whose differences are shown line by line."""
COMPARED: Final = 16 * 1024 * 1024
"""Bytes of all files, of both states, whose differences are shown line by line."""
_Key = TypeVar("_Key")
Sort = Literal["name", "-name", "updated_at", "-updated_at", "created_at", "-created_at"]
Shelf = Literal["current", "archived", "deleted"]


@dataclass(frozen=True, slots=True)
class StoredFile:
    """A file with its bytes."""

    path: str
    revision: int
    sha256: str
    updated_at: datetime
    data: bytes = field(repr=False)

    @property
    def text(self) -> str | None:
        """The content as text, or None if it is not text."""
        return as_text(self.data)


class ListedFile(NamedTuple):
    """A file without its bytes."""

    path: str
    revision: int
    sha256: str
    updated_at: datetime
    size: int


def as_text(data: bytes) -> str | None:
    """Returns the bytes as text; None if they are not UTF-8 or contain NUL."""
    if b"\0" in data:
        return None
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return None


def etag(project: Project) -> str:
    """Returns the ETag of a project.

    It changes with every revision, and with all other data of the answer.
    """
    shelf = "archived" if project.archived_at else "current"
    return f'"{project.revision}-{shelf}-{project.role.label}-{__version__}"'


def revision_etag(change: ChangeSet) -> str:
    """Returns the ETag of a revision.

    It changes with the label, since nothing else of a revision can change.
    """
    return f'"{change.number}-{hashlib.sha256(change.label.encode()).hexdigest()[:16]}"'


def draft_etag(draft: Draft | None) -> str:
    """Returns the ETag of a draft.

    It changes with every save; a draft that does not exist has an ETag too.
    """
    return f'"{draft.updated_at.isoformat()}"' if draft is not None else '"none"'


def project(project_id: UUID, *, user: User, need: Need, lock: bool = False) -> Project:
    """Returns the project if the user's role suffices.

    With `lock`, locks it until the end of the transaction.

    Raises:
        NotFoundError: the project does not exist, or the user may not know of it.
        RoleTooLowError: the user may see the project, but the role does not suffice.
    """
    found = rows.project(project_id, lock=lock)
    if found is not None:
        access.find_role(found, user)
    return access.gate(found, user=user, need=need)


def project_named(name: str, *, user: User) -> Project:
    """Returns the user's own project of this name."""
    found = Project.objects.filter(owner=user, name_key=names.key(name), deleted_at=None).first()
    if found is None:
        raise NotFoundError(f"There is no project named “{names.shown(name)}”.")
    return found


def deleted_project(project_id: UUID, *, user: User) -> Project:
    """Returns the owner's project, deleted or not; locks it until the end of the transaction."""
    rows = Project.objects.select_related("owner").select_for_update(of=("self",)).filter(id=project_id)
    found = access.with_role(rows, user).first()
    if found is not None and found.deleted_at is not None and found.owner_id != user.pk:
        found = None  # to everybody but its owner, a deleted project does not exist
    return access.gate(found, user=user, need=Need.MANAGE)


def projects(
    *, user: User, search: str = "", sort: Sort = "-updated_at", shelf: Shelf = "current"
) -> QuerySet[Project]:
    """Returns the user's own and shared projects whose name or description contains every searched word."""
    if shelf == "deleted":
        rows = Project.objects.filter(owner=user).exclude(deleted_at=None)
    else:
        rows = access.visible(Project.objects.all(), user)
        rows = rows.filter(deleted_at=None, archived_at__isnull=shelf == "current")
    rows = rows.select_related("owner")
    for word in search.split()[:10]:
        rows = rows.filter(Q(name_key__contains=names.key(word)) | Q(description__icontains=word))
    backwards, column = sort.startswith("-"), sort.removeprefix("-")
    order = Lower("name") if column == "name" else F(column)
    return rows.order_by(order.desc() if backwards else order.asc(), "id")


def page(rows: QuerySet[Project], start: int, end: int, *, user: User) -> tuple[list[Project], int]:
    """Returns the projects from `start` to `end`, each with the user's role, and the number of all."""
    found = list(rows[start:end])
    access.find_roles(found, user)
    for row in found:
        row.role = Role(row.rank)  # type: ignore[attr-defined]
    is_last = len(found) < end - start and (found or start == 0)
    total = start + len(found) if is_last else rows.count()
    return [row for row in found if row.role != Role.NONE], total


def root_diagrams(found: Sequence[Project]) -> dict[UUID, dict[str, Any]]:
    """Returns the main tree of each project that has a valid one, up to `DRAWN` bytes of all."""
    ids = [project.id for project in found]
    trees = rows.root_trees(ids, LARGEST_DRAWN)
    blobs = _within({project_id: trees[project_id] for project_id in ids if project_id in trees})
    data = cache.contents(blobs.values())
    diagrams = {project_id: root_diagram(data.get(sha256, b"")) for project_id, sha256 in blobs.items()}
    return {project_id: diagram for project_id, diagram in diagrams.items() if diagram is not None}


def conditions_of(diagrams: Mapping[UUID, dict[str, Any]]) -> dict[UUID, list[str]]:
    """Returns, for each project, the types of its tree that its own code defines as conditions."""
    paths = sorted(all_paths(diagrams.values()))
    blobs = _within(rows.action_blobs(list(diagrams), paths, LARGEST_SOURCE)) if paths else {}
    data = cache.contents(blobs.values())
    files: dict[UUID, dict[str, bytes]] = {project: {} for project in diagrams}
    for (project, path), blob in blobs.items():
        files[project][path] = data[blob]
    return {project: conditions(diagram, files[project].get) for project, diagram in diagrams.items()}


def _within(sized: Mapping[_Key, tuple[str, int]]) -> dict[_Key, str]:
    """Returns the blobs of the first of these files, up to `DRAWN` bytes; equal files count once."""
    left, taken, found = DRAWN, set[str](), dict[_Key, str]()
    for key, (blob, size) in sized.items():
        left -= 0 if blob in taken else size
        if left < 0:
            break
        taken.add(blob)
        found[key] = blob
    return found


def root_diagram(data: bytes) -> dict[str, Any] | None:
    """Returns a tree as JSON, or None if it cannot be read or does not fit on a card."""
    if len(data) > LARGEST_DRAWN:
        return None
    try:
        diagram = json.loads(data)
    except (ValueError, RecursionError):
        return None
    return diagram if isinstance(diagram, dict) else None


def existing_files(project: Project) -> dict[str, Existing]:
    """Returns the current files without their bytes.

    For a project that a write returned, they are those after the write.
    """
    if project.now is not None:
        return dict(project.now)
    return cache.files(project) or rows.existing(project)


def listed_files(project: Project, paths: Sequence[str] | None = None) -> list[ListedFile]:
    """Returns the current files without their bytes, ordered by path: all, or those of `paths`."""
    rows = CurrentFile.objects.filter(project=project)
    if paths is not None:
        rows = rows.filter(path__in=paths)
    columns = ("path", "revision", "blob_id", "updated_at", "blob__size")
    return [ListedFile(*row) for row in rows.order_by("path").values_list(*columns)]


def data_of(files: Sequence[ListedFile | Existing]) -> dict[str, bytes]:
    """Returns the bytes of files by path, in at most one query.

    Raises:
        ReadersBusyError: too many answers are not read yet.
    """
    reserve(sum(file.size for file in files))
    data = cache.contents(file.sha256 for file in files)
    return {file.path: data[file.sha256] for file in files}


def fetched(files: Sequence[ListedFile]) -> dict[str, StoredFile]:
    """Returns files with their bytes, like `data_of`."""
    data = data_of(files)
    return {
        file.path: StoredFile(file.path, file.revision, file.sha256, file.updated_at, data[file.path])
        for file in files
    }


def current_files(project: Project, paths: Sequence[str] | None = None) -> dict[str, StoredFile]:
    """Returns the current files with their bytes, ordered by path: all, or those of `paths`.

    One or two queries are needed.
    """
    return fetched(listed_files(project, paths))


def contents(project: Project, only: tuple[str, ...] = ("",)) -> dict[str, bytes]:
    """Returns the bytes of the current files by path, as the translator expects them.

    Args:
        project: the project.
        only: beginnings of paths; other files are there without their bytes.
    """
    files = existing_files(project)
    data = data_of([file for path, file in files.items() if path.startswith(only)])
    return {path: data.get(path, b"") for path in sorted(files)}


def change_set(project: Project, number: int) -> ChangeSet:
    """Returns one revision of the project."""
    found = ChangeSet.objects.filter(project=project, number=number).first()
    if found is None:
        raise NotFoundError(f"The project has no revision {number}.")
    return found


def history(
    project: Project, *, path: str = "", before: int | None = None, limit: int = 100
) -> tuple[list[ChangeSet], int | None]:
    """Returns change sets with their files, the newest first: all, or those that changed the file `path`.

    A page ends before `limit` if its change sets have too many files. The second value is the number before
    which the next page begins, if there is one.
    """
    rows = ChangeSet.objects.filter(project=project).select_related("author")
    if path:
        rows = rows.filter(Exists(FileRevision.objects.filter(change=OuterRef("pk"), path=path)))
    if before is not None:
        rows = rows.filter(number__lt=before)
    files = FileRevision.objects.filter(change=OuterRef("pk")).order_by().values("change")
    number = files.annotate(number=Count("id")).values("number")
    found = list(rows.annotate(files_number=Subquery(number)).order_by("-number")[: limit + 1])
    page: list[Any] = found[:limit]
    left = LISTED_FILES
    for index, change in enumerate(page):
        left -= change.files_number or 0
        if left < 0 and index:
            page = page[:index]
            break
    prefetch_related_objects(page, "files")
    return page, page[-1].number if len(page) < len(found) else None


def listed_at(project: Project, number: int, paths: Sequence[str] | None = None) -> dict[str, ListedFile]:
    """Returns the files as they were after change set `number`, without their bytes."""
    change_set(project, number)
    rows = FileRevision.objects.filter(change__project=project, change__number__lte=number)
    if paths is not None:
        rows = rows.filter(path__in=paths)
    newest = rows.values("path").annotate(newest=Max("change__number")).values_list("path", "newest")
    wanted = dict(newest)
    found = FileRevision.objects.filter(
        change__project=project,
        change__number__in=set(wanted.values()),
        path__in=wanted,
        blob__isnull=False,
    ).order_by("path")
    columns = ("path", "change__number", "blob_id", "change__created_at", "blob__size")
    listed = (ListedFile(*row) for row in found.values_list(*columns))
    return {file.path: file for file in listed if wanted[file.path] == file.revision}


def files_at(project: Project, number: int, paths: Sequence[str] | None = None) -> Mapping[str, StoredFile]:
    """Returns the files as they were after change set `number`."""
    return fetched(list(listed_at(project, number, paths).values()))


def differing(
    older: Mapping[str, ListedFile], newer: Mapping[str, ListedFile]
) -> tuple[dict[str, str | None], dict[str, str | None]]:
    """Returns the files that differ, for each state, as text.

    None stands for a file that is not text, or is too large to be compared.
    """
    paths = sorted(
        path
        for path in {*older, *newer}
        if path not in older or path not in newer or older[path].sha256 != newer[path].sha256
    )
    left, compared = COMPARED, list[ListedFile]()
    for path in paths:
        versions = [state[path] for state in (older, newer) if path in state]
        size = sum(file.size for file in versions)
        if all(file.size <= LARGEST_COMPARED for file in versions) and size <= left:
            left -= size
            compared += versions
    reserve(COMPARED - left)
    data = cache.contents(file.sha256 for file in compared)
    older_texts, newer_texts = (
        {path: as_text(data.get(state[path].sha256, b"\0")) for path in paths if path in state}
        for state in (older, newer)
    )
    return older_texts, newer_texts


def file_at(project: Project, number: int, path: str) -> StoredFile:
    """Returns one file as it was after change set `number`."""
    file = files_at(project, number, [path]).get(path)
    if file is None:
        raise NotFoundError(f"Revision {number} has no file “{names.shown(path)}”.")
    return file


def drafts(project: Project, *, user: User) -> list[Draft]:
    """Returns the drafts of this user in the project; drafts are unsaved texts."""
    return list(Draft.objects.filter(project=project, author=user).order_by("path"))


def current_file(project: Project, path: str) -> StoredFile:
    """Returns one current file with its bytes."""
    file = current_files(project, [path]).get(path)
    if file is None:
        raise NotFoundError(f"The project has no file “{names.shown(path)}”.")
    return file


def object_of(project: Project, path: str) -> str | None:
    """Returns the object of the store that has a current file; None if there is none."""
    found = CurrentFile.objects.filter(project=project, path=path)
    return found.values_list("blob__stored_at", flat=True).first()
