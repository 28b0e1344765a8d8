"""Writes an imported file back: unchanged parts byte for byte, changed parts in the file's own style.

Each node of a tree is compared with its element in the file. The bytes of a start tag are kept
unless the node changed; the text between tags (comments, blanks) is kept unless the node's children changed.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from translator.tree import Node, Tree
from translator.xml.attributes import ID, to_attributes
from translator.xml.escape import attribute, single_quoted
from translator.xml.read import EXPLICIT, Document, TreeSource
from translator.xml.write import node_lines, tag_of, tree_lines

if TYPE_CHECKING:
    from translator.project import Project
    from translator.xml.source import Element

_ATTRIBUTE = re.compile(r"(\s+)([^\s=>/]+)(\s*=\s*)(\"[^\"]*\"|'[^']*')")
_TAG = re.compile(r"<([^\s>/]+)")


def patch_document(document: Document, project: Project, *, added: list[Tree], main: str | None) -> bytes:
    """Returns the file with the current state of its trees.

    Args:
        document: The file as it was imported.
        project: The current project.
        added: Trees to append.
        main: The main tree to name in the root, or None to leave it unchanged.
    """
    data = document.source.data
    root = document.source.root
    style = _style(data)
    parts = [data[: root.start], _root_tag(document, main)]
    position = root.open_end
    sources = {id(item.element): item for item in document.trees}
    insertion = _insertion_offset(root)
    new = b"".join(_added_tree(tree, project, style) for tree in added)
    closed = root.end == root.open_end  # <root/>
    for child in root.children:
        if new and child.start == insertion:
            parts.append(_before(data, position, child.start, new))
            new = b""
        else:
            parts.append(data[position : child.start])
        item = sources.get(id(child))
        if item is None:
            parts.append(data[child.start : child.end])
        elif (tree := project.trees.get(item.tree.id)) is None:
            parts[-1] = parts[-1].rstrip(b" \t").removesuffix(b"\n").removesuffix(b"\r")
        else:
            parts.append(_Patch(data, item, tree, project, style).tree())
        position = child.end
    if closed:
        return document.source.encoded(b"".join([*parts, new, b"</root>" if new else b"", data[root.end :]]))
    parts += [new, data[position:]]
    return document.source.encoded(b"".join(parts))


@dataclass(frozen=True, slots=True)
class _Style:
    """The style of a file: its line end and its step of indentation."""

    newline: str
    indent: str


def _style(data: bytes) -> _Style:
    newline = "\r\n" if b"\r\n" in data[:4096] else "\n"
    found = re.search(rb"\n([ \t]+)<", data)
    return _Style(newline, found.group(1).decode() if found else "  ")


def _insertion_offset(root: Element) -> int:
    """Returns the offset for added trees: before the models, otherwise at the end of the document."""
    return next((child.start for child in root.children if child.tag in {"TreeNodesModel", "Code"}), root.end)


def _before(data: bytes, position: int, start: int, new: bytes) -> bytes:
    """Inserts new lines between the text before a tag and the blanks that indent the tag."""
    gap = data[position:start]
    kept = gap.rstrip(b" \t\r\n")
    return kept + new + gap[len(kept) :]


def _added_tree(tree: Tree, project: Project, style: _Style) -> bytes:
    lines = tree_lines(tree, project, depth=1, indent=style.indent)
    return (style.newline + style.newline.join(lines)).encode()


def _root_tag(document: Document, main: str | None) -> bytes:
    root = document.source.root
    text = document.source.data[root.start : root.open_end].decode()
    wanted = dict(root.attributes)
    if not document.is_v4:
        wanted["BTCPP_format"] = "4"
    if main is not None:
        wanted["main_tree_to_execute"] = main
    return _rewritten(text, root.tag, root, wanted).encode() if wanted != root.attributes else text.encode()


class _Patch:
    """Writes one tree of a file."""

    def __init__(self, data: bytes, source: TreeSource, tree: Tree, project: Project, style: _Style) -> None:
        self.data = data
        self.source = source
        self.tree_now = tree
        self.project = project
        self.style = style
        self.gaps: dict[str, bytes] = {}
        self.children_before: dict[int, list[str]] = {}
        self._index(source)

    def _index(self, source: TreeSource) -> None:
        """Stores, for each node, the blanks and comments before it, and the children of its element."""
        names = {id(element): node_id for node_id, element in source.elements.items()}
        for element in source.element.walk():
            position = element.open_end
            ids = []
            for child in element.children:
                node_id = names.get(id(child))
                if node_id is None:  # a <remap>, which is an attribute now
                    continue
                ids.append(node_id)
                self.gaps[node_id] = self.data[position : child.start]
                position = child.end
            self.children_before[id(element)] = ids

    def tree(self) -> bytes:
        element = self.source.element
        now, before = self.tree_now, self.source.tree
        tops = [] if now.root is None else [now.root]
        tops += [draft for draft in before.drafts if draft in now.drafts]
        opening = self.data[element.start : element.open_end].decode()
        if dict(now.attributes) != dict(before.attributes):
            kept = {key: text for key, text in element.attributes.items() if key not in before.attributes}
            opening = _rewritten(opening, element.tag, element, {**kept, **now.attributes})
        if now.root is not None and now.root not in self.source.elements and not self._is_kept(tops):
            return self._replaced_root(opening, element)
        return self._with_children(element, opening, tops, depth=2)

    def _is_kept(self, tops: list[str]) -> bool:
        return any(node.id in self.source.elements for top in tops for node in self.tree_now.walk(top))

    def _replaced_root(self, opening: str, element: Element) -> bytes:
        assert self.tree_now.root is not None  # noqa: S101 - the caller has looked
        lines = node_lines(self.tree_now, self.tree_now.root, self.project, depth=2, indent=self.style.indent)
        newline = self.style.newline
        body = newline.join(lines)
        opening = _opened(opening)
        return f"{opening}{newline}{body}{newline}{self.style.indent}</{element.tag}>".encode()

    def node(self, node: Node, depth: int) -> bytes:
        """Returns the text of a node and its descendants."""
        element = self.source.elements.get(node.id)
        if element is None:
            return self._new_node(node, depth)
        opening = self.data[element.start : element.open_end].decode()
        before = self.source.tree.nodes[node.id]
        if node.id in self.source.upgraded or replace(node, children=()) != replace(before, children=()):
            opening = self._changed_tag(node, before, element, opening)
        return self._with_children(element, opening, list(node.children), depth=depth)

    def _changed_tag(self, node: Node, before: Node, element: Element, opening: str) -> str:
        wanted = to_attributes(node)
        if ID not in element.attributes:
            del wanted[ID]
        tag = element.tag
        if tag in EXPLICIT:
            wanted = {"ID": node.type, **wanted}
        elif node.type != before.type or node.id in self.source.upgraded:
            tag, id_ = tag_of(node, self.project)
            wanted = {**id_, **wanted}
        return _rewritten(opening, tag, element, wanted)

    def _new_node(self, node: Node, depth: int) -> bytes:
        """Returns the text of a node that the file does not have; the file may have its descendants."""
        lead = self.style.indent * (depth - 1)
        single = Tree(self.tree_now.id, node.id, {node.id: replace(node, children=())})
        line = next(iter(node_lines(single, node.id, self.project, depth=0, indent="")))
        if not node.children:
            return line.encode()
        tag = _TAG.match(line)
        assert tag is not None  # noqa: S101 - we wrote it
        parts = [_opened(line).encode()]
        for child in node.children:
            gap = self.style.newline + lead + self.style.indent
            parts += [gap.encode(), self.node(self.tree_now.nodes[child], depth + 1)]
        parts.append(f"{self.style.newline}{lead}</{tag.group(1)}>".encode())
        return b"".join(parts)

    def _with_children(self, element: Element, opening: str, children: list[str], depth: int) -> bytes:
        name = _TAG.match(opening)
        assert name is not None  # noqa: S101 - expat has read it, or we wrote it
        closing = f"</{name.group(1)}>"
        before = self.children_before[id(element)]
        is_single = element.end == element.open_end
        if not children and not before:
            if is_single:
                return opening.encode()
            if element.children:
                return f"{opening[:-1].rstrip()}/>".encode()
            inner = self.data[element.open_end : element.end]
            return opening.encode() + self._tail(inner, element, closing)
        if is_single:
            opening = _opened(opening)
        parts = [opening.encode()]
        for child in children:
            gap = self.gaps.get(child) if child in self.gaps else None
            parts.append(gap if gap is not None else self._gap(depth))
            parts.append(self.node(self.tree_now.nodes[child], depth + 1))
        if is_single:
            return b"".join([*parts, self._gap(depth - 1), closing.encode()])
        last = element.children[-1].end if element.children else element.open_end
        rest = self.data[last : element.end]
        parts.append(self._tail(rest, element, closing))
        if not element.children and children:  # a tag that was <A></A>
            parts.insert(-1, self._gap(depth - 1))
        return b"".join(parts)

    def _gap(self, depth: int) -> bytes:
        return (self.style.newline + self.style.indent * depth).encode()

    @staticmethod
    def _tail(rest: bytes, element: Element, closing: str) -> bytes:
        """Returns the end of an element: its last blanks and comments, and the closing tag."""
        at = rest.rindex(b"</")
        old = rest[at:]
        if _TAG.match(old.decode().replace("</", "<", 1)) and closing[2:-1] == element.tag:
            return rest
        return rest[:at] + closing.encode()


def _opened(tag: str) -> str:
    """Returns the start tag of an element that now has children: `<A x="1"/>` becomes `<A x="1">`."""
    return tag[:-2].rstrip() + ">" if tag.endswith("/>") else tag


def _rewritten(text: str, tag: str, element: Element, wanted: dict[str, str]) -> str:
    """Returns a start tag with other attributes; attributes that stay keep order, quotes and blanks."""
    name = _TAG.match(text)
    assert name is not None  # noqa: S101 - expat has read it
    parts = [f"<{tag}"]
    position = name.end()
    left = dict(wanted)
    quote = '"'
    for match in _ATTRIBUTE.finditer(text, position):
        blank, key, equals, quoted = match.groups()
        position = match.end()
        quote = quoted[0]
        if key not in left:
            continue
        value = left.pop(key)
        written = quoted if element.attributes.get(key) == value else _quoted(value, quote)
        parts.append(f"{blank}{key}{equals}{written}")
    parts += [f" {key}={_quoted(value, quote)}" for key, value in left.items()]
    return "".join(parts) + text[position:]


def _quoted(value: str, quote: str) -> str:
    return f'"{attribute(value)}"' if quote == '"' else f"'{single_quoted(value)}'"
