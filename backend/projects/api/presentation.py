"""Converts rows of the database to the JSON of the API."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, NamedTuple

from backend.projects.documents import checking
from backend.projects.storage import queries
from backend.projects.storage.conditions import conditions
from backend.projects.storage.manifest import MANIFEST, read

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from backend.projects.models import ChangeSet, Draft, Project
    from backend.projects.storage.changes import Existing
    from backend.projects.storage.queries import ListedFile, StoredFile

WHOLE: Final = ("trees/", MANIFEST, "enums.json")
"""Beginnings of the paths of files that always come with an opened project; trees have limits."""
LARGEST_SENT: Final = 256 * 1024
"""The largest other file, in bytes, that comes with an opened project."""
SENT_BYTES: Final = 16 * 1024 * 1024
"""Bytes of all other files that come with an opened project."""


def summary(
    project: Project, root_diagram: dict[str, Any] | None, conditions: Sequence[str]
) -> dict[str, Any]:
    """Returns a project in the form of a list."""
    return {
        "id": str(project.id),
        "name": project.name,
        "description": project.description,
        "main_tree": project.main_tree,
        "universe": project.universe,
        "revision": project.revision,
        "size": project.size,
        "created_at": project.created_at.isoformat(),
        "updated_at": project.updated_at.isoformat(),
        "archived_at": project.archived_at and project.archived_at.isoformat(),
        "deleted_at": project.deleted_at and project.deleted_at.isoformat(),
        "root_diagram": root_diagram,
        "conditions": conditions,
        "role": project.role.label,
        "owner": project.owner.username,
    }


def file_info(existing: Existing) -> dict[str, Any]:
    """Returns a file without its content."""
    return {
        "path": existing.path,
        "revision": existing.revision,
        "size": existing.size,
        "sha256": existing.sha256,
    }


class Opened(NamedTuple):
    """The data of an opened project, before it is checked."""

    rows: dict[str, Any]
    listed: Sequence[ListedFile]
    loaded: Mapping[str, StoredFile]

    def checked_files(self) -> dict[str, bytes]:
        """Returns the files as a check needs them, also those that are left out of the answer.

        Raises:
            QuotaExceededError: they are too large to be checked.
        """
        checked = [file for file in self.listed if file.path.startswith(checking.CHECKED)]
        checking.require_checkable(file.size for file in checked)
        missing = [file for file in checked if file.path not in self.loaded]
        files = {**self.loaded, **queries.fetched(missing)}
        return {file.path: files[file.path].data if file.path in files else b"" for file in self.listed}


def opened(project: Project) -> Opened:
    """Returns all data of an opened project that come from the database.

    Trees and settings come whole. Other files come if they are small, and all together not too large; the
    client fetches the rest when it needs them.
    """
    listed = queries.listed_files(project)
    loaded = queries.fetched(_sent(listed))
    main = loaded.get(f"trees/{project.main_tree}.json")
    diagram = queries.root_diagram(main.data) if main is not None else None
    types = conditions(diagram, lambda path: loaded[path].data if path in loaded else None)
    rows = summary(project, diagram, types) | {
        "settings": dict(read(loaded[MANIFEST].data).document),
        "files": [_file(each, loaded.get(each.path)) for each in listed],
    }
    return Opened(rows, listed, loaded)


def _sent(listed: Sequence[ListedFile]) -> list[ListedFile]:
    """Returns the files whose contents come with an opened project."""
    sent, left = [], SENT_BYTES
    for file in listed:
        if not file.path.startswith(WHOLE):
            if file.size > LARGEST_SENT or file.size > left:
                continue
            left -= file.size
        sent.append(file)
    return sent


def _file(listed: ListedFile, loaded: StoredFile | None) -> dict[str, Any]:
    return {
        "path": listed.path,
        "revision": listed.revision,
        "size": listed.size,
        "sha256": listed.sha256,
        "updated_at": listed.updated_at.isoformat(),
        "content": None if loaded is None else loaded.text,
        "left_out": loaded is None,
    }


def changed(project: Project) -> dict[str, Any]:
    """Returns a project after a change set, before it is checked."""
    files = queries.existing_files(project)
    return {"revision": project.revision, "files": [file_info(files[path]) for path in sorted(files)]}


def revision(change: ChangeSet) -> dict[str, Any]:
    """Returns one entry of a project's history."""
    renamed = {row.renamed_from for row in change.files.all() if row.renamed_from}
    return {
        "number": change.number,
        "message": change.message,
        "label": change.label,
        "author": change.author.username if change.author else "",
        "created_at": change.created_at.isoformat(),
        "files": [
            {
                "path": row.path,
                "change": "renamed" if row.renamed_from else "written" if row.blob_id else "deleted",
                "renamed_from": row.renamed_from,
            }
            for row in sorted(change.files.all(), key=lambda row: row.path)
            if row.blob_id or row.path not in renamed
        ],
    }


def draft(row: Draft) -> dict[str, Any]:
    """Returns a draft: text that a user typed and did not save."""
    return {
        "path": row.path,
        "base_revision": row.base_revision,
        "content": row.content,
        "updated_at": row.updated_at.isoformat(),
    }
