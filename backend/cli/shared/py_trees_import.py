"""Imports a Python file that builds a tree with py_trees: it runs in a child with limits, never here."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from backend.cli.shared.errors import BAD_ARGUMENTS, CliError

if TYPE_CHECKING:
    from pathlib import Path

    from translator import Project


def py_trees_project(file: Path, main: str) -> Project:
    """Returns the project of the tree that a file builds.

    Args:
        file: the file.
        main: the variable or the function with the tree; "" if it is to be found.

    Raises:
        CliError: the file builds no tree, or there is none.
        TranslatorError: the tree is too large for a project.
    """
    from executor.expansion.py_trees_apart import BuildError
    from executor.uploads.trees import tree_project

    if not file.is_file():
        raise CliError(f"{file}:1:1: there is no such file", status=BAD_ARGUMENTS)
    try:
        project, why = tree_project(file, main)
    except BuildError as error:
        raise CliError(f"{error.file}:{error.line}:1: {error}") from None
    if why:
        print(f"note: {file}:1:1: the tree is one block, since {why}", file=sys.stderr)
    return project
