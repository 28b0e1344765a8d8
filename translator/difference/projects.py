"""Compares two versions of a project: its trees by their nodes, its other files by their bytes."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any, Final, Literal

from translator.diagram import to_diagram
from translator.difference.operations import Operation, compare
from translator.difference.shape import Document, Shape

if TYPE_CHECKING:
    from collections.abc import Mapping

    from translator.project import Project
    from translator.tree import Tree

Change = Literal["added", "removed", "changed"]

FORMAT: Final = "bt-studio/difference"
_OWN_ID = re.compile(rb"\b_bts_id\s*=\s*[\"']([^\"']*)[\"']")


@dataclass(frozen=True, slots=True)
class Version:
    """One side of a comparison.

    `ids` are those that the file itself gives to its nodes; None: all. Readers number the other nodes, so
    that equal numbers mean nothing.
    """

    name: str
    trees: Mapping[str, Document]
    files: Mapping[str, bytes] = field(default_factory=dict)
    ids: frozenset[str] | None = None


@dataclass(frozen=True, slots=True)
class ChangedTree:
    """A tree that differs."""

    tree: str
    change: Change
    older: Document
    newer: Document
    operations: tuple[Operation, ...]


@dataclass(frozen=True, slots=True)
class Difference:
    """The trees and files that differ between two versions."""

    older: Version
    newer: Version
    trees: tuple[ChangedTree, ...]
    files: Mapping[str, Change]

    def to_json(self) -> dict[str, Any]:
        """Returns the output of `--json`."""
        trees = [
            {"tree": each.tree, "change": each.change, "operations": list(each.operations)}
            for each in self.trees
        ]
        files = [{"path": path, "change": change} for path, change in self.files.items()]
        return {"format": FORMAT, "version": 1, "trees": trees, "files": files}


def version_of(project: Project, name: str, *, is_xml: bool = False) -> Version:
    """Returns a project as a side; `is_xml` if its trees were read from XML just now."""
    trees = {tree.id: to_diagram(tree) for tree in project.trees.values()}
    if is_xml:
        imports = [raw for path, raw in project.files.items() if path.startswith("imports/")]
        return Version(name, trees, ids=own_ids(*imports))
    files = {path: raw for path, raw in project.files.items() if not _is_diagram(path)}
    return Version(name, trees, files)


def version_of_tree(tree: Tree, name: str) -> Version:
    """Returns one diagram as a side."""
    return Version(name, {tree.id: to_diagram(tree)})


def own_ids(*sources: bytes) -> frozenset[str]:
    """Returns the node ids that XML files contain."""
    return frozenset(found.decode("utf-8", "replace") for raw in sources for found in _OWN_ID.findall(raw))


def compare_versions(older: Version, newer: Version, *, layout: bool = False) -> Difference:
    """Returns the differences. Two single trees are compared with each other, also under different names."""
    known = [each for each in (older.ids, newer.ids) if each is not None]
    ids = frozenset.intersection(*known) if known else None
    names = {tree: tree for tree in newer.trees}
    if len(older.trees) == len(newer.trees) == 1:
        names = dict(zip(newer.trees, older.trees, strict=True))
    trees = []
    for tree, document in newer.trees.items():
        before = older.trees.get(names[tree])
        operations = compare(before or _empty(tree), document, ids=ids, layout=layout)
        if before is None or operations:
            change: Change = "added" if before is None else "changed"
            trees.append(ChangedTree(tree, change, before or _empty(tree), document, tuple(operations)))
    for tree in older.trees.keys() - set(names.values()):
        document = older.trees[tree]
        operations = compare(document, _empty(tree), layout=layout)
        trees.append(ChangedTree(tree, "removed", document, _empty(tree), tuple(operations)))
    trees.sort(key=lambda each: each.tree)
    return Difference(older, newer, tuple(trees), _files(older.files, newer.files))


def _files(older: Mapping[str, bytes], newer: Mapping[str, bytes]) -> dict[str, Change]:
    found: dict[str, Change] = {}
    for path in sorted({*older, *newer}):
        if path not in older:
            found[path] = "added"
        elif path not in newer:
            found[path] = "removed"
        elif older[path] != newer[path]:
            found[path] = "changed"
    return found


def _is_diagram(path: str) -> bool:
    return PurePosixPath(path).parts[:1] == ("trees",) and path.endswith(".json")


def _empty(tree: str) -> Document:
    return {"id": tree, "root": None, "nodes": {}, "drafts": [], "layout": "vertical"}


def shapes(tree: ChangedTree) -> tuple[Shape, Shape]:
    """Returns both sides of a tree with their links."""
    return Shape(tree.older), Shape(tree.newer)
