"""The JSON of diagrams: functions that read and repair it, and functions that write it.

`restore` repairs what it can and reports each repair, so that no diagram is lost to a small error;
`to_diagram` and `diagram_text` are deterministic: the same tree gives the same bytes.
"""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any

from translator.catalog import PortModel
from translator.diagnostic import Diagnostic, Place, diagnostic
from translator.json_file import parse_json
from translator.migrate import CURRENT_VERSION, PLAIN_VERSION, migrate
from translator.text import clean, is_clean, is_valid_id, safe_name
from translator.tree import AUTOREMAP, CONDITIONS, EMPTY, SUBTREE, Node, Tree

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

FORMAT = "bt-studio/diagram"
DIRECTIONS = ("input", "output", "inout")


def restore(raw: bytes | str, *, file: str) -> tuple[Tree | None, tuple[Diagnostic, ...]]:
    """Reads a diagram; returns the tree, or None if nothing can be restored, and the findings."""
    document, problem = parse_json(raw, file=file)
    if problem is not None:
        return None, (problem,)
    return restore_document(document, file=file)


def restore_document(document: Any, *, file: str) -> tuple[Tree | None, tuple[Diagnostic, ...]]:
    """Reads a diagram as `restore` does, from a parsed document."""
    reader = _Reader(file)
    tree = reader.read(document)
    return tree, tuple(reader.found)


class _Reader:
    """Reads one document, and collects the repairs that it needs."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.tree_id = ""
        self.found: list[Diagnostic] = []

    def report(self, code: str, node: str = "", port: str = "", **values: object) -> None:
        place = Place(self.file, tree=self.tree_id, node=node, port=port)
        self.found.append(diagnostic(code, place, **values))

    def read(self, document: Any) -> Tree | None:
        if not isinstance(document, dict):
            self.report("BT0004", kind=_json_kind(document))
            return None
        if document.get("format", FORMAT) != FORMAT:
            self.report("BT0005", found=str(document["format"])[:80], expected=FORMAT)
            return None
        version = document.get("version", 0)
        if type(version) is not int or not 0 <= version <= CURRENT_VERSION:
            self.report("BT0006", version=str(version)[:40], newest=CURRENT_VERSION)
            return None
        document = migrate(document, version)
        rows = document.get("nodes", {})
        if not isinstance(rows, dict):
            self.report("BT0007", kind=_json_kind(rows))
            return None
        self.tree_id = self.read_id(document)
        nodes = {}
        for key, row in rows.items():
            node = self.read_node(key, row)
            if node is not None:
                nodes[node.id] = node
        return self.assemble(document, nodes)

    def read_id(self, document: dict[str, Any]) -> str:
        from_file = PurePosixPath(self.file).stem or "MainTree"
        tree_id = document.get("id")
        if not isinstance(tree_id, str) or not tree_id:
            self.report("BT0010", id=from_file)
            return from_file
        return clean(tree_id)

    def read_node(self, key: str, row: Any) -> Node | None:
        node_id = clean(key) or "unnamed"
        if not isinstance(row, dict) or not isinstance(row.get("type"), str) or not row["type"]:
            self.report("BT0011", node_id)
            return None
        if node_id != key:
            self.report("BT0012", node_id, field="id")
        ports = self.texts(node_id, row, "ports")
        attributes = self.texts(node_id, row, "attributes")
        if (
            row["type"] == SUBTREE and AUTOREMAP in ports
        ):  # editors may put `_autoremap` among the ports, since it is set like one
            attributes = {**attributes, AUTOREMAP: ports[AUTOREMAP]}
            ports = {name: text for name, text in ports.items() if name != AUTOREMAP}
        return Node(
            id=node_id,
            type=self.text(node_id, row, "type"),
            name=self.text(node_id, row, "name"),
            tree=self.text(node_id, row, "tree") if row["type"] == SUBTREE else "",
            ports=ports,
            conditions=self.conditions(node_id, row),
            attributes=attributes,
            children=self.children(node_id, row),
            position=self.position(node_id, row),
            comment=self.text(node_id, row, "comment"),
            color=self.text(node_id, row, "color"),
            disabled=self.flag(node_id, row, "disabled"),
            collapsed=self.flag(node_id, row, "collapsed"),
            silenced=self.texts(node_id, row, "silenced"),
            has_empty_name=row.get("name") == "",
        )

    def text(self, node_id: str, row: dict[str, Any], field: str) -> str:
        value = row.get(field)
        if value is None:
            return ""
        if not isinstance(value, str):
            self.report("BT0013", node_id, field=field)
            return ""
        if not is_clean(value):
            self.report("BT0012", node_id, field=field)
            return clean(value)
        return value

    def flag(self, node_id: str, row: dict[str, Any], field: str) -> bool:
        value = row.get(field, False)
        if not isinstance(value, bool):
            self.report("BT0013", node_id, field=field)
            return False
        return value

    def texts(self, node_id: str, row: dict[str, Any], field: str) -> Mapping[str, str]:
        rows = row.get(field)
        if not rows:
            return EMPTY
        if not isinstance(rows, dict):
            self.report("BT0013", node_id, field=field)
            return EMPTY
        result = {}
        for key, value in rows.items():
            text = _as_text(value)
            if text is None:
                self.report("BT0013", node_id, port=key, field=f"{field}.{key}")
                continue
            if not isinstance(value, str) or not is_clean(text) or not is_clean(key):
                self.report("BT0012", node_id, port=clean(key), field=f"{field}.{clean(key)}")
            result[clean(key)] = clean(text)
        return result

    def conditions(self, node_id: str, row: dict[str, Any]) -> Mapping[str, str]:
        conditions = self.texts(node_id, row, "conditions")
        unknown = [key for key in conditions if key not in CONDITIONS]
        for key in unknown:
            self.report("BT0014", node_id, key=key, known=", ".join(CONDITIONS))
        return {key: text for key, text in conditions.items() if key in CONDITIONS} if unknown else conditions

    def children(self, node_id: str, row: dict[str, Any]) -> tuple[str, ...]:
        children = row.get("children")
        if children is None:
            return ()
        if not isinstance(children, list):
            self.report("BT0013", node_id, field="children")
            return ()
        kept = tuple(clean(child) for child in children if isinstance(child, str))
        if len(kept) != len(children):
            self.report("BT0013", node_id, field="children")
        return kept

    def position(self, node_id: str, row: dict[str, Any]) -> tuple[float, float] | None:
        value = row.get("position")
        if value is None:
            return None
        numbers = value if isinstance(value, list) and len(value) == 2 else []
        if len(numbers) == 2 and all(_is_number(number) for number in numbers):
            return (numbers[0], numbers[1])
        self.report("BT0013", node_id, field="position")
        return None

    def assemble(self, document: dict[str, Any], nodes: dict[str, Node]) -> Tree:
        nodes = self.linked(nodes)
        parented = {child: node.id for node in nodes.values() for child in node.children}
        root = document.get("root")
        if root is not None and (not isinstance(root, str) or root not in nodes):
            self.report("BT0020", root=clean(str(root)[:80]))
            root = None
        drafts = self.drafts(document, nodes, parented, root)
        if root in parented:  # the root hangs below another node: cut it free there
            self.cut(nodes, parented[root], root)
        self.without_cycles(nodes, parented, [root, *drafts])
        drafts += self.lost(nodes, [root, *drafts])
        return Tree(
            id=self.tree_id,
            root=root,
            nodes=nodes,
            drafts=tuple(drafts),
            layout=self.layout(document),
            ports=self.model(document),
            attributes=self.texts("", document, "attributes"),
            file=self.file,
            conflicts=self.conflicts(document),
        )

    def linked(self, nodes: dict[str, Node]) -> dict[str, Node]:
        """Removes children that do not exist, and second parents."""
        seen: set[str] = set()
        for node in list(nodes.values()):
            kept = []
            for child in node.children:
                if child not in nodes:
                    self.report("BT0021", node.id, child=child)
                elif child in seen or child == node.id:
                    self.report("BT0022", node.id, child=child)
                else:
                    seen.add(child)
                    kept.append(child)
            if len(kept) != len(node.children):
                nodes[node.id] = replace(node, children=tuple(kept))
        return nodes

    def cut(self, nodes: dict[str, Node], parent: str, child: str) -> None:
        self.report("BT0022", parent, child=child)
        kept = tuple(other for other in nodes[parent].children if other != child)
        nodes[parent] = replace(nodes[parent], children=kept)

    def drafts(
        self, document: dict[str, Any], nodes: dict[str, Node], parented: Mapping[str, str], root: str | None
    ) -> list[str]:
        listed = document.get("drafts", [])
        if not isinstance(listed, list):
            self.report("BT0013", field="drafts")
            listed = []
        drafts = []
        for draft in dict.fromkeys(item for item in listed if isinstance(item, str)):
            if draft in nodes and draft not in parented and draft != root:
                drafts.append(draft)
            else:
                self.report("BT0023", draft=clean(draft))
        return drafts

    def without_cycles(
        self, nodes: dict[str, Node], parented: Mapping[str, str], starts: list[str | None]
    ) -> None:
        """Cuts cycles. Since each node has one parent, a cycle cannot be reached from outside."""
        cleared = _reach(nodes, starts)
        for node_id, node in list(nodes.items()):
            if node_id in cleared:
                continue
            trail = {node_id}
            stack = list(node.children)
            while stack:
                child = stack.pop()
                if child == node_id:
                    self.cut(nodes, parented[node_id], node_id)
                    break
                if child not in trail and child not in cleared:
                    trail.add(child)
                    stack.extend(nodes[child].children)
            cleared |= trail

    def lost(self, nodes: dict[str, Node], starts: list[str | None]) -> list[str]:
        """Returns the starts of pieces that belong neither to the root nor to a draft; they become drafts."""
        parented = {child for node in nodes.values() for child in node.children}
        known = set(starts)
        lost = [key for key in nodes if key not in parented and key not in known]
        for node_id in lost:
            self.report("BT0024", node_id, type=nodes[node_id].type)
        return lost

    def conflicts(self, document: dict[str, Any]) -> tuple[dict[str, Any], ...]:
        """Returns the open conflicts of a merge; entries of unknown form are kept, so that none is lost."""
        listed = document.get("conflicts") or []
        rows = listed if isinstance(listed, list) else [listed]
        return tuple(row if isinstance(row, dict) else {"op": "", "node": ""} for row in rows)

    def layout(self, document: dict[str, Any]) -> str:
        layout = self.text("", document, "layout")
        return "" if layout == "vertical" else layout

    def model(self, document: dict[str, Any]) -> tuple[PortModel, ...]:
        rows = document.get("ports") or []
        ports = []
        for row in rows if isinstance(rows, list) else [rows]:
            if not isinstance(row, dict) or not isinstance(row.get("name"), str):
                self.report("BT0013", field="ports")
                continue
            direction = row.get("direction", "input")
            default = row.get("default")
            ports.append(
                PortModel(
                    name=clean(row["name"]),
                    direction=direction if direction in DIRECTIONS else "input",
                    type=self.text("", row, "type") or "any",
                    default=clean(default) if isinstance(default, str) else None,
                    required=row.get("required") is True,
                    description=self.text("", row, "description"),
                )
            )
        return tuple(ports)


def version_of(nodes: Iterable[Node]) -> int:
    """Returns the version that a diagram of these nodes needs."""
    return CURRENT_VERSION if any(node.silenced for node in nodes) else PLAIN_VERSION


def needed_version(rows: Iterable[Mapping[str, Any]], version: int) -> int:
    """Returns the version that a document of these nodes needs; a newer one than ours stays."""
    if version > CURRENT_VERSION:
        return version
    return CURRENT_VERSION if any(row.get("silenced") for row in rows) else PLAIN_VERSION


def to_diagram(tree: Tree) -> dict[str, Any]:
    """Returns the tree as a diagram document; defaults are not written."""
    document: dict[str, Any] = {
        "format": FORMAT,
        "version": version_of(tree.nodes.values()),
        "id": tree.id,
        "root": tree.root,
    }
    if tree.ports:
        document["ports"] = [_port_row(port) for port in tree.ports]
    if tree.attributes:
        document["attributes"] = dict(tree.attributes)
    document["nodes"] = {key: _node_row(node) for key, node in tree.nodes.items()}
    document["drafts"] = list(tree.drafts)
    document["layout"] = tree.layout or "vertical"
    if tree.conflicts:
        document["conflicts"] = [dict(conflict) for conflict in tree.conflicts]
    return document


def diagram_text(tree: Tree) -> str:
    """Returns the diagram as text with one line for each node, so that a diff shows the changes."""
    return document_text(to_diagram(tree))


def document_text(document: Mapping[str, Any]) -> str:
    """Returns a document as `diagram_text` does a tree; conflicts have a line each."""
    last = ("nodes", "drafts", "layout", "conflicts")
    parts = [f"  {_dump(key)}: {_dump(value)}" for key, value in document.items() if key not in last]
    rows = ",\n".join(f"    {_dump(key)}: {_dump(row)}" for key, row in document["nodes"].items())
    parts.append(f'  "nodes": {{\n{rows}\n  }}' if document["nodes"] else '  "nodes": {}')
    parts += [f"  {_dump(key)}: {_dump(document[key])}" for key in ("drafts", "layout") if key in document]
    if conflicts := document.get("conflicts"):
        parts.append('  "conflicts": [\n' + ",\n".join(f"    {_dump(row)}" for row in conflicts) + "\n  ]")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def diagram_path(tree_id: str) -> str:
    """Returns the path of a tree's diagram in a project."""
    return f"trees/{tree_id if is_valid_id(tree_id) else safe_name(tree_id)}.json"


def _node_row(node: Node) -> dict[str, Any]:
    row: dict[str, Any] = {"type": node.type}
    if node.tree:
        row["tree"] = node.tree
    if node.name or node.has_empty_name:
        row["name"] = node.name
    for field in ("ports", "conditions", "attributes"):
        if getattr(node, field):
            row[field] = dict(getattr(node, field))
    if node.children:
        row["children"] = list(node.children)
    if node.position is not None:
        row["position"] = list(node.position)
    for field in ("comment", "color", "disabled", "collapsed"):
        if getattr(node, field):
            row[field] = getattr(node, field)
    if node.silenced:
        row["silenced"] = dict(node.silenced)
    return row


def _port_row(port: PortModel) -> dict[str, Any]:
    row: dict[str, Any] = {"name": port.name, "direction": port.direction}
    if port.type != "any":
        row["type"] = port.type
    if port.default is not None:
        row["default"] = port.default
    if port.required:
        row["required"] = True
    if port.description:
        row["description"] = port.description
    return row


def _reach(nodes: Mapping[str, Node], starts: list[str | None]) -> set[str]:
    reached: set[str] = set()
    stack = [start for start in starts if start in nodes]
    while stack:
        node_id = stack.pop()
        if node_id is None or node_id in reached:
            continue
        reached.add(node_id)
        stack.extend(nodes[node_id].children)
    return reached


def _as_text(value: Any) -> str | None:
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return json.dumps(value)
    return None


def _is_number(value: Any) -> bool:
    if not isinstance(value, int | float) or isinstance(value, bool):
        return False
    return abs(value) < 1e9 and math.isfinite(value)


def _json_kind(value: Any) -> str:
    names = {list: "a list", str: "a text", bool: "a truth value", int: "a number", float: "a number"}
    return names.get(type(value), "nothing") if not isinstance(value, dict) else "an object"


_dump = json.JSONEncoder(ensure_ascii=False).encode
