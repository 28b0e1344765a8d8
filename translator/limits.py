"""Limits of a project: one table, `limits.json`, for all code that reads, checks or stores projects.

The table has the defaults of the web server's settings; `frontend/src/generated/limits.ts` and
`docs/reference/limits.md` are generated from it. A project that already exceeds a limit can be opened, made
smaller and downloaded; it is not translated, and cannot grow.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from translator.diagnostic import Diagnostic, Place, diagnostic

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from translator.tree import Tree

TABLE_PATH: Final = Path(__file__).with_name("limits.json")


class Limit(NamedTuple):
    """One row of the table."""

    name: str
    value: int
    what: str


class StatedLimit(NamedTuple):
    """A limit that other code has as a constant, `module:name`; a test compares both."""

    name: str
    value: int
    what: str
    constant: str


_FILE: Final = json.loads(TABLE_PATH.read_text(encoding="utf-8"))
TABLE: Final[Mapping[str, Limit]] = {row["name"]: Limit(**row) for row in _FILE["limits"]}
RECORDINGS: Final = tuple(StatedLimit(**row) for row in _FILE["recordings"])
WORLDS: Final = tuple(StatedLimit(**row) for row in _FILE["worlds"])

NODES_PER_TREE: Final = TABLE["nodes_per_tree"].value
NODES_PER_PROJECT: Final = TABLE["nodes_per_project"].value
TREES_PER_PROJECT: Final = TABLE["trees_per_project"].value
LEVELS_PER_TREE: Final = TABLE["levels_per_tree"].value
DIAGRAM_BYTES_PER_PROJECT: Final = TABLE["diagram_bytes_per_project"].value
FILE_BYTES: Final = TABLE["file_bytes"].value
PROJECT_BYTES: Final = TABLE["project_bytes"].value
FILES_PER_PROJECT: Final = TABLE["files_per_project"].value
ARCHIVED_FILE_BYTES: Final = TABLE["archived_file_bytes"].value
ARCHIVE_DIRECTORY_BYTES: Final = TABLE["archive_directory_bytes"].value
ARCHIVE_ENTRIES: Final = TABLE["archive_entries"].value
ACTION_BYTES: Final = TABLE["action_bytes"].value
XML_BYTES: Final = TABLE["xml_bytes"].value
XML_ELEMENTS: Final = TABLE["xml_elements"].value
XML_LEVELS: Final = TABLE["xml_levels"].value
XML_ATTRIBUTES: Final = TABLE["xml_attributes"].value
XML_INCLUDES: Final = TABLE["xml_includes"].value
XML_REPAIRS: Final = TABLE["xml_repairs"].value
YAML_BYTES: Final = TABLE["yaml_bytes"].value
YAML_VALUES: Final = TABLE["yaml_values"].value
YAML_LEVELS: Final = TABLE["yaml_levels"].value
TREE_TEXT_CHARACTERS: Final = TABLE["tree_text_characters"].value
NAME_CHARACTERS: Final = TABLE["name_characters"].value
DESCRIPTION_CHARACTERS: Final = TABLE["description_characters"].value
SCRIPT_CHARACTERS: Final = TABLE["script_characters"].value

OVERSIZE: Final = frozenset({"BT0017", "BT0018", "BT0019"})
"""The codes of the findings of `oversize`."""


def megabytes(value: int) -> str:
    """Returns a number of bytes as text for a message."""
    return f"{value // 2**20} MB"


def oversize(trees: Iterable[Tree], place: Place) -> list[Diagnostic]:
    """Returns findings about trees that are too large.

    Those about all trees together have the place `place`.
    """
    found: list[Diagnostic] = []
    count = total = 0
    for tree in trees:
        count, total = count + 1, total + len(tree.nodes)
        if len(tree.nodes) > NODES_PER_TREE:
            at = Place(tree.file or place.file, tree=tree.id, line=1)
            found.append(diagnostic("BT0017", at, count=len(tree.nodes), limit=NODES_PER_TREE))
    if total > NODES_PER_PROJECT:
        found.append(diagnostic("BT0018", place, count=total, limit=NODES_PER_PROJECT))
    if count > TREES_PER_PROJECT:
        limit = f"{TREES_PER_PROJECT} trees"
        found.append(diagnostic("BT0019", place, size=f"{count} trees", limit=limit))
    return found
