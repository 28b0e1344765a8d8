"""Templates of new projects: the folders of `examples/`, and an empty one."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from backend.config.environment import environment
from backend.core.problems import InvalidInputError
from backend.projects.storage.conditions import conditions
from backend.projects.storage.manifest import MANIFEST, write
from translator.nav2.distributions import DEFAULT

if TYPE_CHECKING:
    from pathlib import Path

EMPTY: Final = "empty"
_IGNORED: Final = frozenset({"__pycache__", ".git", ".ruff_cache", ".mypy_cache"})


@dataclass(frozen=True, slots=True)
class Template:
    """A template in the form in which the start page shows it."""

    id: str
    name: str
    description: str
    universe: str
    root_diagram: dict[str, Any] | None
    conditions: list[str]


def templates() -> list[Template]:
    """Returns the templates: the empty project first, then the examples by name."""
    folder = environment().templates_dir
    found = (
        sorted(path.name for path in folder.iterdir() if (path / MANIFEST).is_file())
        if folder.is_dir()
        else []
    )
    return [_describe(template_id) for template_id in (EMPTY, *found)]


def files_of(template_id: str) -> dict[str, bytes]:
    """Returns the files of a new project with this template.

    Raises:
        InvalidInputError: there is no such template; the hint lists those that exist.
    """
    if template_id == EMPTY:
        return _empty_project()
    folder = environment().templates_dir / template_id
    known = {path.name for path in environment().templates_dir.glob("*") if (path / MANIFEST).is_file()}
    if template_id not in known:
        listed = ", ".join([EMPTY, *sorted(known)])
        raise InvalidInputError("There is no such template.", hint=f"Templates: {listed}.", field="template")
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if _counts(path, folder)
    }


def _counts(path: Path, folder: Path) -> bool:
    return path.is_file() and not path.is_symlink() and not _IGNORED & set(path.relative_to(folder).parts)


def _empty_project() -> dict[str, bytes]:
    manifest = {
        "format": "bt-studio/project",
        "version": 1,
        "name": "Untitled",
        "description": "",
        "main_tree": "MainTree",
        "tick_hz": 20,
        "universe": "walled_room",
        "ros_distro": DEFAULT,
        "on_finish": "stop",
        "on_error": "stop",
        "license": "Apache-2.0",
        "maintainer": {"name": "", "email": ""},
    }
    diagram = {
        "format": "bt-studio/diagram",
        "version": 1,
        "id": "MainTree",
        "root": None,
        "nodes": {},
        "drafts": [],
        "layout": "vertical",
    }
    return {MANIFEST: write(manifest), "trees/MainTree.json": write(diagram)}


def _describe(template_id: str) -> Template:
    files = files_of(template_id)
    manifest = json.loads(files[MANIFEST])
    diagram = files.get(f"trees/{manifest.get('main_tree', 'MainTree')}.json")
    tree = json.loads(diagram) if diagram else None
    name = "Empty project" if template_id == EMPTY else manifest["name"]
    return Template(
        id=template_id,
        name=name,
        description=manifest.get("description", ""),
        universe=manifest.get("universe", ""),
        root_diagram=tree,
        conditions=conditions(tree, files.get),
    )
