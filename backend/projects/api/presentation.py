"""Converts rows of the database to the JSON of the API."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from backend.projects.storage import queries
from backend.projects.storage.conditions import conditions
from backend.projects.storage.manifest import MANIFEST, read

if TYPE_CHECKING:
    from collections.abc import Sequence

    from backend.projects.models import ChangeSet, Draft, Project
    from backend.projects.storage.changes import Existing
    from backend.projects.storage.queries import StoredFile


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


def file(stored: StoredFile) -> dict[str, Any]:
    """Returns a file with its content."""
    return {
        "path": stored.path,
        "revision": stored.revision,
        "size": len(stored.data),
        "sha256": stored.sha256,
        "updated_at": stored.updated_at.isoformat(),
        "content": stored.text,
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
    contents: dict[str, bytes]


def opened(project: Project) -> Opened:
    """Returns all data of an opened project that come from the database."""
    files = queries.current_files(project)
    main = files.get(f"trees/{project.main_tree}.json")
    diagram = queries.root_diagram(main.data) if main is not None else None
    types = conditions(diagram, lambda path: files[path].data if path in files else None)
    rows = summary(project, diagram, types) | {
        "settings": dict(read(files[MANIFEST].data).document),
        "files": [file(stored) for stored in files.values()],
    }
    return Opened(rows, {path: stored.data for path, stored in files.items()})


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
