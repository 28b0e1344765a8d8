"""Merges three versions of a file: a diagram, or BehaviorTree.CPP XML in our side's own style."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

from translator.diagnostic import TranslatorError
from translator.diagram import FORMAT, document_text, restore_document, to_diagram
from translator.difference.operations import compare
from translator.difference.projects import own_ids
from translator.difference.shape import KNOWN
from translator.json_file import parse_json
from translator.merge.align import align
from translator.merge.trees import Conflict, merge_documents
from translator.migrate import PLAIN_VERSION
from translator.project import Project
from translator.settings import Settings
from translator.tree import CONFLICTS, Tree
from translator.xml.patch import patch_document
from translator.xml.read import Document, read_document

if TYPE_CHECKING:
    from collections.abc import Mapping

_COMMENT: Final = re.compile(rb"<!--.*?-->", re.DOTALL)


class NotMergeableError(Exception):
    """The files differ in something that is no tree; a merge of lines can do it."""


@dataclass(frozen=True, slots=True)
class MergedFile:
    """The bytes of the result, and its conflicts with the tree of each."""

    data: bytes
    conflicts: tuple[tuple[str, Conflict], ...] = ()


def merge_files(base: bytes, ours: bytes, theirs: bytes, *, file: str) -> MergedFile:
    """Returns the merge of three versions of a diagram or an XML file. An empty base means: both are new.

    Raises:
        TranslatorError: If one of them cannot be read.
        NotMergeableError: If they are XML and differ in more than trees.
    """
    if theirs in (ours, base):
        return MergedFile(ours)
    if ours == base:
        return MergedFile(theirs)
    if ours.removeprefix(b"\xef\xbb\xbf").lstrip()[:1] == b"<":
        return _merge_xml(base, ours, theirs, file)
    return _merge_diagrams(base, ours, theirs, file)


def _merge_diagrams(base: bytes, ours: bytes, theirs: bytes, file: str) -> MergedFile:
    mine, other = read_diagram(ours, file), read_diagram(theirs, file)
    before = read_diagram(base, file) if base.strip() else _empty(mine)
    merged = merge_documents(before, mine, other)
    tree = str(merged.document.get("id", ""))
    return MergedFile(
        document_text(merged.document).encode(), tuple((tree, each) for each in merged.conflicts)
    )


def read_diagram(raw: bytes, file: str) -> dict[str, Any]:
    """Returns a diagram, repaired as everywhere, with the keys that this version does not know.

    Raises:
        TranslatorError: If it cannot be read.
    """
    document, problem = parse_json(raw, file=file)
    if problem is not None:
        raise TranslatorError([problem])
    tree, found = restore_document(document, file=file)
    if tree is None:
        raise TranslatorError(found)
    result = to_diagram(tree)
    for node, row in result["nodes"].items():
        source = document["nodes"].get(node)
        if isinstance(source, dict):
            row.update((key, source[key]) for key in source.keys() - KNOWN)
    known = {*result, "ports", "attributes", "conflicts"}
    return result | {key: value for key, value in document.items() if key not in known}


def _merge_xml(base: bytes, ours: bytes, theirs: bytes, file: str) -> MergedFile:
    mine, other = (_readable(raw, file) for raw in (ours, theirs))
    before = _readable(base, file) if base.strip() else None
    rest = [_rest(document) for document in (before, mine, other) if document is not None]
    if rest[-1] not in rest[:-1]:
        raise NotMergeableError
    ids = own_ids(ours) & own_ids(theirs) & (own_ids(base) if before is not None else own_ids(ours))
    sides = [_trees(document) for document in (before, mine, other)]
    trees: dict[str, Tree] = {}
    conflicts: list[tuple[str, Conflict]] = []
    for name in dict.fromkeys([*sides[1], *sides[2]]):
        tree, found = _merge_tree(sides[0].get(name), sides[1].get(name), sides[2].get(name), ids)
        conflicts += [(name, each) for each in found]
        if tree is not None:
            trees[name] = tree
    if any(tree.drafts for tree in trees.values()):
        raise NotMergeableError  # XML has no place for a second root
    added = [name for name in trees if name not in sides[1]]
    data = _patched(mine, ours, trees, added)
    if conflicts:
        # A reader numbers nodes without ids again: the conflicts name them by those numbers.
        read = _trees(read_document(data, file=file))
        conflicts = [(name, _numbered(each, trees[name], read[name])) for name, each in conflicts]
        listed = {name: [each for tree, each in conflicts if tree == name] for name, _ in conflicts}
        marked = {name: _with_conflicts(tree, listed.get(name, [])) for name, tree in trees.items()}
        data = _patched(mine, ours, marked, added)
    return MergedFile(data, tuple(conflicts))


def _patched(mine: Document, ours: bytes, trees: Mapping[str, Tree], added: list[str]) -> bytes:
    """Returns our file with the trees in their merged state."""
    main = mine.main or next(iter(trees), "MainTree")
    project = Project(Settings(main_tree=main), trees, {}, {"imports/ours.xml": ours})
    return patch_document(mine, project, added=[trees[name] for name in added], main=None)


def _numbered(conflict: Conflict, tree: Tree, read: Tree) -> Conflict:
    """Returns a conflict with the ids that the nodes of `tree` have when it is read from the file."""
    names = {one.id: other.id for one, other in zip(tree.walk(), read.walk(), strict=False)}
    found = dict(conflict)
    if "field" not in conflict:
        links = {"ring", "base", "ours", "theirs"} & conflict.keys()
        found.update((key, _renamed(conflict[key], names)) for key in links)
    return {**found, "node": names.get(conflict["node"], conflict["node"])}


def _renamed(value: Any, names: Mapping[str, str]) -> Any:
    """Returns a place, a row or a list of nodes with the other ids."""
    if isinstance(value, list):
        return [names.get(each, each) for each in value]
    if not isinstance(value, dict):
        return value
    found = dict(value)
    if value.get("parent"):
        found["parent"] = names.get(value["parent"], value["parent"])
    if "children" in value:
        found["children"] = _renamed(value["children"], names)
    return found


def _merge_tree(
    base: Tree | None, ours: Tree | None, theirs: Tree | None, ids: frozenset[str]
) -> tuple[Tree | None, tuple[Conflict, ...]]:
    """Returns one tree of an XML file, or None if it is deleted."""
    if ours is not None and theirs is not None:
        mine = to_diagram(ours)
        before, other = align(to_diagram(base) if base else _empty(mine), mine, to_diagram(theirs), ids)
        merged = merge_documents(before, mine, other)
        tree, found = restore_document({**merged.document, "conflicts": []}, file=ours.file)
        if tree is None:
            raise TranslatorError(found)
        return tree, merged.conflicts
    kept = ours if ours is not None else theirs
    if base is None or kept is None:
        return kept, ()
    if not compare(to_diagram(base), to_diagram(kept), ids=ids):
        return None, ()
    names = (tree.id if tree is not None else None for tree in (base, ours, theirs))
    return kept, ({"op": "delete", "node": "", **dict(zip(("base", "ours", "theirs"), names, strict=True))},)


def _with_conflicts(tree: Tree, conflicts: list[Conflict]) -> Tree:
    if not conflicts:
        return tree
    text = json.dumps(conflicts, ensure_ascii=False, separators=(",", ":"))
    return replace(tree, attributes={**tree.attributes, CONFLICTS: text})


def _readable(raw: bytes, file: str) -> Document:
    document = read_document(raw, file=file)
    if not document.is_v4 or any(tree.tree.drafts for tree in document.trees):
        raise NotMergeableError
    return document


def _rest(document: Document) -> tuple[bytes, tuple[bytes, ...]]:
    """Returns all of a file that is not in its trees, and the comments in them."""
    data = document.source.data
    parts, comments, position = [], [], 0
    for item in document.trees:
        parts.append(data[position : item.element.start].strip())
        comments += _COMMENT.findall(data[item.element.start : item.element.end])
        position = item.element.end
    return b"".join([*parts, data[position:].strip()]), tuple(comments)


def _trees(document: Document | None) -> Mapping[str, Tree]:
    return {item.tree.id: item.tree for item in document.trees} if document is not None else {}


def _empty(like: Mapping[str, Any]) -> dict[str, Any]:
    return {
        "format": FORMAT, "version": PLAIN_VERSION, "id": like["id"],
        "root": None, "nodes": {}, "drafts": [], "layout": "vertical",
    }  # fmt: skip
