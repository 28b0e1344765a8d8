"""The app for the executor's manager: the tree, its actions and the engine in one zip."""

from __future__ import annotations

import json
from importlib import resources
from typing import TYPE_CHECKING

from translator.export import require_sound, write_self_contained
from translator.package.engine import engine_files
from translator.package.zip import write_zip
from translator.settings import PROJECT_FILE

if TYPE_CHECKING:
    from translator.project import Project

TREE_FILE = "self_contained_tree.xml"
FOLDERS = ("launch/", "assets/", "trees/")


def to_app_zip(project: Project) -> bytes:
    """Returns the app: `self_contained_tree.xml`, `execute_docker.py`, actions, engine, launch files, assets.

    The diagrams are in it for recordings, which show the tree as it ran.

    Raises:
        TranslatorError: If the project has errors; its `diagnostics` name them.
    """
    return write_zip(sound_app_files(project))


def sound_app_files(project: Project) -> dict[str, bytes]:
    """Returns the files of the app by path.

    Raises:
        TranslatorError: If the project has errors.
    """
    require_sound(project)
    return app_files(project)


def app_files(project: Project) -> dict[str, bytes]:
    """Returns the files of the app by path, for a project that is known to be sound.

    All Python travels along: actions import it, and launch files start it.
    """
    return {**files_beside_engine(project), **engine_files()}


def files_beside_engine(project: Project) -> dict[str, bytes]:
    """Returns the files of the app without the engine, for a process that has loaded it."""
    files = {
        path: raw for path, raw in project.files.items() if path.startswith(FOLDERS) or path.endswith(".py")
    }
    files[PROJECT_FILE] = (
        json.dumps(project.settings.to_json(), ensure_ascii=False, indent=2) + "\n"
    ).encode()
    files[TREE_FILE] = write_self_contained(project).encode()
    template = resources.files("translator.package").joinpath("templates", "execute_docker.py.j2")
    files["execute_docker.py"] = template.read_bytes()
    if "requirements.txt" in project.files:
        files["requirements.txt"] = project.files["requirements.txt"]
    return files


def is_action_source(path: str) -> bool:
    """Returns whether the file is Python of the actions: an action, or a module that actions import."""
    return path.startswith("actions/") and path.endswith(".py")
