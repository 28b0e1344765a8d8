"""Converts one tree to an XML document and back, for an editor that shows text and drawing side by side.

The text keeps the comments and blanks of its author: changes of the tree are patched into it. Nodes of a
changed text keep their ids, even if the text contains none.
"""

from __future__ import annotations

import codecs
from collections import defaultdict, deque
from dataclasses import dataclass, replace
from itertools import count
from typing import TYPE_CHECKING

from translator.diagnostic import Diagnostic, Place, TranslatorError, diagnostic
from translator.limits import oversize
from translator.project import Project
from translator.settings import Settings
from translator.xml.attributes import ID
from translator.xml.patch import patch_document
from translator.xml.read import Document, TreeSource, read_document
from translator.xml.write import tree_lines

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from translator.tree import Node, Tree


@dataclass(frozen=True, slots=True)
class NodeRange:
    """The range of a node in a text: its start tag, and the whole element.

    Offsets are in UTF-16, as in editors.
    """

    node: str
    start: int
    open_end: int
    end: int


@dataclass(frozen=True, slots=True)
class TreeText:
    """The XML of one tree, and its nodes in the order of the text."""

    xml: str
    ranges: tuple[NodeRange, ...]

    @property
    def ids(self) -> list[str]:
        """The ids of the nodes in the order of the text, which may contain other ids or none."""
        return [found.node for found in self.ranges]


@dataclass(frozen=True, slots=True)
class ReadTree:
    """A text that was read: its tree, the ranges of the nodes, and the findings."""

    tree: Tree
    text: TreeText
    diagnostics: tuple[Diagnostic, ...]


def write_tree_text(tree: Tree, *, base: str = "", ids: Sequence[str] = ()) -> TreeText:
    """Returns the tree as XML.

    Args:
        tree: The current tree; its drafts are left out.
        base: The text of an earlier state of the tree, whose comments and blanks are kept; if "", a new text
            is made.
        ids: The nodes of `base` in the order of the text.

    Raises:
        TranslatorError: If `base` cannot be read.
    """
    _require_size(tree)
    project = _project_of(tree)
    if base:
        document = _read(base, tree)
        _take_ids(document, ids)
        patched = patch_document(document, project, added=[], main=None)
        xml = document.source.decoded(patched)
    else:
        lines = ['<root BTCPP_format="4">', *tree_lines(tree, project, depth=1), "</root>", ""]
        xml = "\n".join(lines)
    document = _read(xml, tree)
    _take_ids(document, [node.id for node in tree.walk()])
    return TreeText(xml, tuple(_ranges(document)))


def read_tree_text(xml: str, now: Tree) -> ReadTree:
    """Reads a text that was edited.

    Args:
        xml: A document with one tree, v4 or v3.
        now: The tree before the edit; parts that the text does not contain (drafts, ports) are copied from
            it.

    Raises:
        TranslatorError: If the text is not XML, or not a single tree of this ID.
    """
    document = _read(xml, now)
    source = document.trees[0]
    if len(source.element.children) > 1:
        place = Place(document.file, tree=now.id, line=source.element.line, column=source.element.column)
        raise TranslatorError([diagnostic("BT0739", place, count=len(source.element.children))])
    errors = [found for found in document.diagnostics if found.is_error]
    if errors:
        raise TranslatorError(errors)
    _take_ids(document, _matched(source, now))
    found = document.trees[0].tree
    drafts = {node.id: node for draft in now.drafts for node in now.walk(draft)}
    _require_size(found)
    tree = replace(
        found,
        id=now.id,
        nodes={**found.nodes, **drafts},
        drafts=now.drafts,
        ports=found.ports or now.ports,
        file=now.file,
    )
    told = [item for item in document.diagnostics if item.code != "BT0714"]
    return ReadTree(tree, TreeText(xml, tuple(_ranges(document))), tuple(told))


def _require_size(tree: Tree) -> None:
    if found := oversize([tree], Place(f"{tree.id}.xml", tree=tree.id, line=1, column=1)):
        raise TranslatorError(found)


def _project_of(tree: Tree) -> Project:
    return Project(Settings(name=tree.id[:80] or "Tree", main_tree=tree.id), {tree.id: tree}, {})


def _read(xml: str, tree: Tree) -> Document:
    """Reads a text of one tree of this ID."""
    # A text has no encoding, even if its first line names one.
    document = read_document(codecs.BOM_UTF8 + xml.encode("utf-8", "replace"), file=f"{tree.id}.xml")
    place = Place(document.file, tree=tree.id, line=1, column=1)
    if len(document.trees) != 1:
        raise TranslatorError([diagnostic("BT0738", place, count=len(document.trees))])
    source = document.trees[0]
    named = source.element.attributes.get("ID", "")
    if named and named != tree.id:
        at = replace(place, line=source.element.line, column=source.element.column)
        raise TranslatorError([diagnostic("BT0737", at, found=named, id=tree.id)])
    source.tree = replace(source.tree, id=tree.id)
    return document


def _take_ids(document: Document, ids: Sequence[str]) -> None:
    """Sets the ids of the tree's nodes, in the order of the text."""
    source = document.trees[0]
    names = dict(zip(source.elements, ids, strict=False))
    if len(names) != len(source.elements) or len(set(names.values())) != len(names):
        return  # ids that are not of this text
    nodes = {
        names[key]: replace(node, id=names[key], children=tuple(names[child] for child in node.children))
        for key, node in source.tree.nodes.items()
    }
    source.tree = replace(
        source.tree,
        root=source.tree.root and names[source.tree.root],
        nodes=nodes,
        drafts=tuple(names[draft] for draft in source.tree.drafts),
    )
    source.elements = {names[key]: element for key, element in source.elements.items()}
    source.upgraded = {names[key] for key in source.upgraded}


_KEYS: tuple[Callable[[Node], tuple[object, ...]], ...] = (
    lambda node: (node.type, node.tree, node.name, *sorted(node.ports.items()), *node.conditions.items()),
    lambda node: (node.type, node.tree, node.name),
    lambda node: (node.type, node.tree),
    lambda node: (bool(node.children),),
)


def _matched(source: TreeSource, now: Tree) -> list[str]:
    """Returns an id for each node of a text: its own, that of the matching earlier node, or a new one."""
    taken = {node.id for draft in now.drafts for node in now.walk(draft)}
    before = {node.id for node in now.walk()}
    ids: dict[str, str] = {}
    for key, element in source.elements.items():
        if element.attributes.get(ID, "") == key and key not in taken:
            ids[key] = key
            taken.add(key)
    free = before - taken
    pairs: list[tuple[list[str], list[str]]] = [
        ([now.root] if now.root else [], [source.tree.root] if source.tree.root else [])
    ]
    while pairs:
        old, new = pairs.pop()
        _pair([now.nodes[key] for key in old], [source.tree.nodes[key] for key in new], ids, free)
        for key in new:
            if ids.get(key) in before:
                pairs.append((list(now.nodes[ids[key]].children), list(source.tree.nodes[key].children)))
    taken |= set(ids.values()) | before
    fresh = (name for number in count(1) if (name := f"n{number}") not in taken)
    return [ids[key] if key in ids else next(fresh) for key in source.elements]


def _pair(old: list[Node], new: list[Node], ids: dict[str, str], free: set[str]) -> None:
    """Matches children of one parent: first equal nodes, then nodes of the same kind."""
    for key_of in _KEYS:
        candidates: dict[tuple[object, ...], deque[str]] = defaultdict(deque)
        for node in old:
            if node.id in free:
                candidates[key_of(node)].append(node.id)
        for node in new:
            if node.id not in ids and (found := candidates.get(key_of(node))):
                ids[node.id] = found.popleft()
                free.discard(ids[node.id])


def _ranges(document: Document) -> Iterator[NodeRange]:
    """Yields the ranges of the nodes."""
    elements = document.trees[0].elements
    offsets = {at for each in elements.values() for at in (each.start, each.open_end, each.end)}
    data = document.source.data
    counted = {at: at for at in offsets}
    if not data.isascii():
        position = count = 0
        for at in sorted(offsets):
            count += len(data[position:at].decode().encode("utf-16-le")) // 2
            position = at
            counted[at] = count
    for node, element in elements.items():
        yield NodeRange(node, counted[element.start], counted[element.open_end], counted[element.end])
