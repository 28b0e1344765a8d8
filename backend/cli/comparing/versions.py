"""Opens what `diff` compares: a project, a revision of a stored one, a diagram, an XML file."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from backend.cli.shared import translation as cli

if TYPE_CHECKING:
    from translator.difference.projects import Version

_REVISION = re.compile(r"(.+)@(\d+)")


def open_version(name: str) -> Version:
    """Returns one side of a comparison. `NAME@7` is the seventh revision of a stored project.

    Raises:
        CliError: If there is nothing of this name.
        TranslatorError: If it cannot be read.
    """
    from translator import TranslatorError
    from translator.archive import read_file
    from translator.diagram import restore
    from translator.difference.projects import version_of, version_of_tree
    from translator.jderobot.graph import looks_like_graph
    from translator.settings import PROJECT_FILE
    from translator.xml.includes import SUFFIXES

    path = Path(name)
    if not path.exists() and (found := _REVISION.fullmatch(name)):
        return _revision(found[1], int(found[2]), name)
    if path.is_file() and path.suffix.lower() == ".json":
        raw = read_file(path)
        if not looks_like_graph(raw):
            tree, problems = restore(raw, file=name)
            if tree is None:
                raise TranslatorError(problems)
            return version_of_tree(tree, name)
    project = cli.open_project(name, stubs=False)
    is_xml = path.suffix.lower() in SUFFIXES or (path.is_dir() and not (path / PROJECT_FILE).exists())
    return version_of(
        project, name, is_xml=is_xml and any(each.startswith("imports/") for each in project.files)
    )


def _revision(project: str, number: int, name: str) -> Version:
    from backend.cli.shared.stored import find_project, stored_projects
    from translator import load
    from translator.difference.projects import version_of

    with stored_projects():
        from backend.projects.storage.queries import files_at

        files = files_at(find_project(project), number)
        return version_of(load({path: file.data for path, file in files.items()}), name)
