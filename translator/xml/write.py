"""Writes BehaviorTree.CPP v4 XML; the output is deterministic, with one line for each node."""

from __future__ import annotations

from typing import TYPE_CHECKING

from translator.catalog import NodeModel, PortModel, builtins
from translator.ros_nodes import direction_of
from translator.text import is_xml_name
from translator.tree import SUBTREE, Node, Tree
from translator.values import type_label
from translator.xml.attributes import COMMENT, is_free, to_attributes
from translator.xml.escape import attribute, character_data

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from translator.project import Project

LAYOUT = "_bts_layout"
INDENT = "  "
EXPLICIT_TAGS = {"control": "Control", "decorator": "Decorator", "condition": "Condition"}
# Tags that mean something else: a node whose type is called so is written in the explicit form.
RESERVED_TAGS = frozenset(
    {"Action", "BehaviorTree", "Condition", "Control", "Decorator", "TreeNodesModel", "include", "root"}
)
PORT_TAGS = {"input": "input_port", "output": "output_port", "inout": "inout_port"}
CPP_TYPES = {
    "int": "int",
    "uint": "unsigned int",
    "double": "double",
    "bool": "bool",
    "string": "std::string",
    "script": "std::string",
    "status": "BT::NodeStatus",
}


def write_document(project: Project, *, after: Iterable[str] = ()) -> str:
    """Returns the whole document; `after` are lines put before the closing tag."""
    main = attribute(project.settings.main_tree)
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<root BTCPP_format="4" main_tree_to_execute="{main}">',
    ]
    trees = [tree for tree in ordered_trees(project) if tree.root is not None]
    for tree in trees:
        lines.extend(tree_lines(tree, project, depth=1))
    lines.extend(model_lines(project, trees))
    lines.extend(after)
    lines.append("</root>\n")
    return "\n".join(lines)


def ordered_trees(project: Project) -> list[Tree]:
    """Returns the trees, the main one first, the others by id."""
    main = project.settings.main_tree
    return sorted(project.trees.values(), key=lambda tree: (tree.id != main, tree.id))


def tree_lines(tree: Tree, project: Project, *, depth: int, indent: str = INDENT) -> list[str]:
    """Returns the lines of one `<BehaviorTree>`."""
    kept = {name: text for name, text in tree.attributes.items() if name == COMMENT or is_free(name)}
    values = {"ID": tree.id, **kept}
    if tree.layout and tree.layout != "vertical":
        values[LAYOUT] = tree.layout
    if tree.root is None:
        return [f"{indent * depth}<BehaviorTree{_written(values)}/>"]
    opening = f"{indent * depth}<BehaviorTree{_written(values)}>"
    return [
        opening,
        *node_lines(tree, tree.root, project, depth=depth + 1, indent=indent),
        f"{indent * depth}</BehaviorTree>",
    ]


def node_lines(
    tree: Tree, start: str, project: Project, *, depth: int, indent: str = INDENT
) -> Iterator[str]:
    """Yields the lines of a branch, without recursion, since trees may be deep."""
    stack: list[tuple[str, int, bool]] = [(start, depth, False)]
    while stack:
        node_id, level, closing = stack.pop()
        node = tree.nodes[node_id]
        tag, id_ = tag_of(node, project)
        if closing:
            yield f"{indent * level}</{tag}>"
            continue
        values = {**id_, **to_attributes(node)}
        if node.children:
            yield f"{indent * level}<{tag}{_written(values)}>"
            stack.append((node_id, level, True))
            stack.extend((child, level + 1, False) for child in reversed(node.children))
        else:
            yield f"{indent * level}<{tag}{_written(values)}/>"


def tag_of(node: Node, project: Project) -> tuple[str, dict[str, str]]:
    """Returns the tag of a node: its type, or if that cannot be a tag the explicit form, with its `ID`."""
    if node.type == SUBTREE or (is_xml_name(node.type) and node.type not in RESERVED_TAGS):
        return node.type, {}
    id_ = {"ID": node.type}
    model = project.model(node.type) or project.imported_model(node.type)
    if model is None:
        tag = "Control" if len(node.children) > 1 else "Decorator" if node.children else "Action"
        return tag, id_
    return EXPLICIT_TAGS.get(model.kind, "Action"), id_


def _written(values: dict[str, str]) -> str:
    return "".join(f' {name}="{attribute(text)}"' for name, text in values.items() if is_xml_name(name))


def model_lines(project: Project, trees: list[Tree]) -> list[str]:
    """Returns the lines of `<TreeNodesModel>`, with the ports of used nodes that BehaviorTree.CPP has not."""
    seen = _ports_seen(trees)
    lines: list[str] = []
    for type_ in sorted(seen):
        if type_ in builtins() and not builtins()[type_].group:
            continue
        model = project.model(type_) or project.imported_model(type_)
        if model is not None:
            lines.extend(
                model_element(EXPLICIT_TAGS.get(model.kind, "Action"), type_, _all_ports(model, seen[type_]))
            )
    for tree in trees:
        if tree.ports:
            lines.extend(model_element("SubTree", tree.id, list(tree.ports)))
    if not lines:
        return []
    return [f"{INDENT}<TreeNodesModel>", *lines, f"{INDENT}</TreeNodesModel>"]


def _ports_seen(trees: list[Tree]) -> dict[str, dict[str, None]]:
    seen: dict[str, dict[str, None]] = {}
    for tree in trees:
        for node in tree.walk():
            seen.setdefault(node.type, {}).update(dict.fromkeys(node.ports))
    return seen


def _all_ports(model: NodeModel, seen: Iterable[str]) -> list[PortModel]:
    ports = list(model.ports.values())
    if model.open:
        ports += [
            PortModel(name, direction_of(model.type, name) or "input")
            for name in sorted(seen)
            if name not in model.ports and is_xml_name(name)
        ]
    return ports


def model_element(
    tag: str, id_: str, ports: list[PortModel], *, indent: str = INDENT, any_type: str | None = None
) -> Iterator[str]:
    """Yields the lines of one model; a type without a name in C++ is written as `any_type`, or left out."""
    if not ports:
        yield f'{indent * 2}<{tag} ID="{attribute(id_)}"/>'
        return
    yield f'{indent * 2}<{tag} ID="{attribute(id_)}">'
    for port in ports:
        yield indent * 3 + _port(port, any_type)
    yield f"{indent * 2}</{tag}>"


def _port(port: PortModel, any_type: str | None) -> str:
    values = {"name": port.name}
    if (type_ := cpp_type(port.type) or any_type) is not None:
        values["type"] = type_
    if port.default is not None:
        values["default"] = port.default
    tag = PORT_TAGS[port.direction]
    opening = f"<{tag}{_written(values)}"
    text = character_data(" ".join(port.description.split()))
    return f"{opening}>{text}</{tag}>" if text else f"{opening}/>"


def cpp_type(type_: str) -> str | None:
    """Returns the C++ name of a type, as Groot2 shows it, or None for one that is not known."""
    if type_.startswith("list["):
        inner = CPP_TYPES.get(type_[5:-1])
        return f"std::vector<{inner}>" if inner else None
    return CPP_TYPES.get(type_, type_label(type_) if type_ != "any" else None)
