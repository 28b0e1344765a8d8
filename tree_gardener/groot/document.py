"""The document that describes a running tree: a ``<BehaviorTree>`` for each instance, with the uids of nodes.

Source: ``WriteTreeToXML`` with metadata of BehaviorTree.CPP 4.8, as its publisher answers for the whole tree.
"""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Final
from xml.etree import ElementTree as ET

from tree_gardener import catalog
from tree_gardener.node import Kind, Node
from tree_gardener.ports import NO_DEFAULT, PortSpec

if TYPE_CHECKING:
    from tree_gardener.tree import Tree

_OWN: Final = ("ID", "name", "_autoremap", "_fullpath", "_uid")
"""Attributes that are written from the running node, or not at all."""
_IDS_OF_DIAGRAMS: Final = "_bts_"
_KINDS: Final = {kind.value.lower(): kind.value for kind in Kind}


def instances(tree: "Tree") -> list[list[Node]]:
    """Returns the nodes of each instance of a BehaviorTree, in the order in which instances begin."""
    found: dict[int, list[Node]] = {}
    for node in tree.nodes:
        found.setdefault(id(node.instance), []).append(node)
    return list(found.values())


def document_of(tree: "Tree") -> bytes:
    """Returns the document of a tree, with the models of its nodes and of all built-in ones."""
    root = ET.Element("root", {"BTCPP_format": "4"})
    for nodes in instances(tree):
        first = nodes[0]
        wanted = {"ID": first.tree_id, "_fullpath": first.instance.path()}
        ET.SubElement(root, "BehaviorTree", wanted).append(_element_of(first))
    root.append(_models(tree))
    ET.indent(root, "    ")
    text: bytes = ET.tostring(root, "utf-8")
    return text


def _element_of(node: Node) -> ET.Element:
    """Returns the element of a node with those below it in its instance, which are few levels."""
    element = ET.Element(node.type, dict(_attributes(node)))
    if node.KIND is not Kind.SUBTREE:
        element.extend(_element_of(child) for child in node.children)
    return element


def _attributes(node: Node) -> Iterator[tuple[str, str]]:
    if node.KIND is Kind.SUBTREE:
        yield "ID", node.attributes.get("ID", "")
        yield "_fullpath", node.path
    else:
        yield "name", node.name
    yield "_uid", str(node.uid)
    for name, text in node.attributes.items():
        if name not in _OWN and not name.startswith(_IDS_OF_DIAGRAMS):
            yield name, text
    for port in (node.manifest or {}).values():
        if port.name not in node.attributes and node.KIND is not Kind.SUBTREE and _has_default(port):
            yield port.name, str(port.default)


def _has_default(port: PortSpec) -> bool:
    return port.default is not NO_DEFAULT and port.default is not None


def _models(tree: "Tree") -> ET.Element:
    models = ET.Element("TreeNodesModel")
    known = {entry.type: (entry.kind, entry.manifest) for entry in catalog.load().values() if not entry.group}
    used = {
        node.type: (node.kind, dict(node.manifest or {}))
        for node in tree.nodes
        if node.KIND is not Kind.SUBTREE
    }
    for name, (kind, ports) in sorted({**used, **known}.items()):
        _model(ET.SubElement(models, _KINDS[kind.lower()], {"ID": name}), ports)
    return models


def _model(model: ET.Element, ports: Mapping[str, PortSpec]) -> None:
    for port in ports.values():
        attributes = {"name": port.name, "type": port.type.name}
        if _has_default(port):
            attributes["default"] = str(port.default)
        ET.SubElement(model, f"{port.direction}_port", attributes).text = port.description or None
