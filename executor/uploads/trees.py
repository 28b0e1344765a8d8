"""Makes a project of a Python file that builds a tree with py_trees; the file runs in its own child."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING, Any, Final

from executor.expansion.py_trees_apart import BuildError, build_apart
from translator.archive import read_file
from translator.diagnostic import TranslatorError
from translator.py_trees_tree import project_of_py_trees

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from translator import Project

_MOST_NAME: Final = 200
_MOST_MESSAGE: Final = 2_000


def tree_project(file: Path, main: str) -> tuple[Project, str]:
    """Returns the project of the tree that a file builds, and why the tree is one block, or "".

    Args:
        file: the file; modules beside it that it imports come along.
        main: the variable or the function with the tree; "" if it is to be found.

    Raises:
        BuildError: the file builds no tree, or several.
        TranslatorError: the tree is too large for a project.
    """
    made = build_apart(file, main)
    if deeper := [path for path in made["files"] if "/" in path]:
        text = f"it imports {deeper[0]} (only modules beside the file can be taken along)"
        raise BuildError(text, file)
    folder = file.resolve().parent
    beside = {path: (folder / path).resolve() for path in made["files"]}
    sources = {path: read_file(real) for path, real in beside.items() if real.parent == folder}
    return project_of_py_trees(made, sources, file=file.name)


def make_tree(file: Path, main: str) -> dict[str, Any]:
    """Returns the answer about one file: the files of its project, or why there is none."""
    try:
        project, why = tree_project(file, main)
    except BuildError as error:
        return _refusal(error, error.file, error.line, error.choices)
    except TranslatorError as error:
        return _refusal(error, file)
    files = [
        {"path": path, "base64": base64.b64encode(data).decode()} for path, data in project.files.items()
    ]
    return {"files": files, "one_block": why[:_MOST_MESSAGE]}


def _refusal(error: Exception, file: Path, line: int = 1, choices: Sequence[str] = ()) -> dict[str, Any]:
    """Returns why there is no tree; the file's own code may have written any of it, so long texts are cut."""
    found = {"file": file.name[:_MOST_NAME], "line": line, "message": str(error)[:_MOST_MESSAGE]}
    return {"no_tree": found | {"choices": [choice for choice in choices if len(choice) <= _MOST_NAME]}}
