"""Reads the tree that BehaviorTree.CPP wrote into a log, `WriteTreeToXML` with its metadata. Pure."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from executor.recorder.outside.errors import OutsideError
from tree_gardener.document import parse_document
from tree_gardener.errors import LoadError

if TYPE_CHECKING:
    from tree_gardener.document import Element

__all__ = ["MOST_NODES", "MOST_XML_BYTES", "LoggedTree", "flat_tree", "tree_of_xml"]

MOST_XML_BYTES: Final = 8 << 20
MOST_NODES: Final = 20_000
_EXPLICIT: Final = frozenset({"Action", "Condition", "Control", "Decorator"})
_HINT: Final = "Does BehaviorTree.CPP 4 read the log itself?"
_COLUMNS: Final = ("uid", "parent", "type", "kind", "name", "path", "node_id", "tree_id", "ports_json")


@dataclass(frozen=True)
class LoggedTree:
    """A tree of a log.

    Attributes:
        columns: the lists of a message `Tree`.
        numbers: our uid of each node, by its number in the log.
        xml: the text it was read from, or nothing.
    """

    columns: dict[str, list[Any]]
    numbers: dict[int, int]
    xml: bytes = b""


def tree_of_xml(xml: bytes, name: str, place: int) -> LoggedTree:
    """Returns the tree of a log.

    Args:
        xml: the document.
        name: the name of the log in errors.
        place: the offset or row of the document in the log.

    Raises:
        OutsideError: it is no such document, or too large.
    """
    if len(xml) > MOST_XML_BYTES:
        text = f"the tree has {len(xml)} bytes"
        raise OutsideError("too_large", name, place, text, f"At most {MOST_XML_BYTES} are read.")
    try:
        root = parse_document(xml, name).root
    except LoadError as error:
        found = error.diagnostics[0]
        text = f"line {found.line} of its tree: {found.message}"
        raise OutsideError("damaged", name, place, text, found.hint or _HINT) from error
    return _Reader(root, name, place).read(xml)


def flat_tree(names: dict[int, str]) -> LoggedTree:
    """Returns a tree for a log with only the names of nodes: the first one is the parent of all others."""
    columns: dict[str, list[Any]] = {column: [] for column in _COLUMNS}
    numbers: dict[int, int] = {}
    for number, name in names.items():
        uid = numbers[number] = len(numbers) + 1
        kind = "Control" if uid == 1 else "Action"
        path = name if uid == 1 else f"{name}::{uid}"
        row = (uid, 0 if uid == 1 else 1, name, kind, name, path, "", "", "{}")
        for column, value in zip(_COLUMNS, row, strict=True):
            columns[column].append(value)
    return LoggedTree(columns, numbers)


class _Reader:
    def __init__(self, root: Element, name: str, place: int) -> None:
        self._name, self._place, self._root = name, place, root
        self._columns: dict[str, list[Any]] = {column: [] for column in _COLUMNS}
        self._numbers: dict[int, int] = {}
        self._bodies = [each for each in root.children if each.tag == "BehaviorTree"]
        self._by_path = {
            body.attributes["_fullpath"]: body for body in self._bodies if "_fullpath" in body.attributes
        }
        self._by_id = {body.attributes.get("ID", ""): body for body in reversed(self._bodies)}
        self._kinds = {
            model.attributes.get("ID", ""): model.tag
            for models in root.children
            if models.tag == "TreeNodesModel"
            for model in models.children
        }

    def read(self, xml: bytes) -> LoggedTree:
        main = self._by_path.get("") or self._by_id.get(self._root.attributes.get("main_tree_to_execute", ""))
        body = main or next(iter(self._bodies), None)
        if self._root.tag != "root" or body is None or not body.children:
            raise self._error("its document has no tree")
        # (element, our uid of its parent, its tree, path of its SubTree)
        open_ = [(body.children[0], 0, body.attributes.get("ID", ""), "")]
        while open_:
            element, parent, tree_id, scope = open_.pop()
            uid, path = self._add(element, parent, tree_id, scope)
            if element.tag == "SubTree":
                inner = self._by_path.get(element.attributes.get("_fullpath", ""))
                inner = inner or self._by_id.get(element.attributes.get("ID", ""))
                children = inner.children[:1] if inner is not None else []
                tree_id, scope = element.attributes.get("ID", ""), path
            else:
                children = element.children
            open_.extend((child, uid, tree_id, scope) for child in reversed(children))
        return LoggedTree(self._columns, self._numbers, xml)

    def _add(self, element: Element, parent: int, tree_id: str, scope: str) -> tuple[int, str]:
        """Adds a node; returns its uid and its path."""
        uid = len(self._columns["uid"]) + 1
        if uid > MOST_NODES:
            raise self._error(f"its tree has more than {MOST_NODES} nodes")
        attributes = element.attributes
        kind_of = element.tag if element.tag in _EXPLICIT else ""
        type_ = attributes.get("ID", element.tag) if kind_of else element.tag
        path = attributes.get("_fullpath", "")
        default = path.rpartition("/")[2] or attributes.get("ID") or type_
        node_name = attributes.get("name", default)
        logged = self._number(attributes.get("_uid", str(uid)))
        local = f"{node_name}::{logged}" if node_name == type_ else node_name
        path = path or (f"{scope}/{local}" if scope else local)
        kind = "SubTree" if type_ == "SubTree" else kind_of or self._kinds.get(type_, "Action")
        hidden = {"name", "ID"} if kind_of or type_ == "SubTree" else {"name"}
        ports = {
            key: text for key, text in attributes.items() if key not in hidden and not key.startswith("_")
        }
        coded = json.dumps(ports, ensure_ascii=False, sort_keys=True, separators=(",", ":"))
        node_id = attributes.get("_bts_id", "")
        row = (uid, parent, type_, kind, node_name, path, node_id, tree_id, coded)
        for column, value in zip(_COLUMNS, row, strict=True):
            self._columns[column].append(value)
        if self._numbers.setdefault(logged, uid) != uid:
            raise self._error(f"two nodes of its tree have the number {logged}")
        return uid, path

    def _number(self, text: str) -> int:
        if not (text.isascii() and text.isdigit() and len(text) <= 9):
            raise self._error(f"a node of its tree has the number {text[:20]!r}")
        return int(text)

    def _error(self, message: str) -> OutsideError:
        return OutsideError("damaged", self._name, self._place, message, _HINT)
