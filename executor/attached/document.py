"""Makes diagrams of another program's tree, and names their blocks for its nodes. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final
from xml.etree import ElementTree as ET

from executor.messages import TreeNode
from translator.catalog import builtins
from translator.importer import from_xml
from tree_gardener.document import parse_document
from tree_gardener.groot.protocol import GrootError

if TYPE_CHECKING:
    from tree_gardener.document import Element
    from tree_gardener.groot.remote import RemoteTree

__all__ = ["AttachedDocument", "document_of"]

NAME: Final = "Attached tree"
FILE: Final = "attached.xml"
_META: Final = ("_uid", "_fullpath")
_KINDS: Final = {"Action": "Action", "Condition": "Condition", "Control": "Control", "Decorator": "Decorator"}
_SUBTREE: Final = "SubTree"
_Shape = tuple[str, tuple[tuple[str, int], ...]]


@dataclass(frozen=True)
class AttachedDocument:
    """The tree of another program as a project.

    Attributes:
        xml: the tree as one writes it, with one BehaviorTree for all instances that are alike.
        main_tree: the ID of the main tree.
        files: the files of the project by path, with the diagrams.
        actions: its actions, as the page's checks have them.
        nodes: the nodes of the running tree, with the blocks of the diagrams; their uids count from 1.
        numbers: our uid of each node, by its uid in the other program.
    """

    xml: str
    main_tree: str
    files: dict[str, bytes]
    actions: list[dict[str, Any]]
    nodes: list[TreeNode]
    numbers: dict[int, int]


def document_of(tree: RemoteTree) -> AttachedDocument:
    """Returns the project that shows a tree.

    Raises:
        GrootError: the document is nested too deeply to be shown.
        TranslatorError: it is too large, or no tree that can be shown.
    """
    root = parse_document(tree.document, "the tree of the other program").root
    instances = [each for each in root.children if each.tag == "BehaviorTree"]
    names = _names(instances)
    blocks: dict[int, tuple[str, str]] = {}
    written = ET.Element("root", {"BTCPP_format": "4", "main_tree_to_execute": names[id(instances[0])]})
    firsts: dict[str, list[str]] = {}
    by_path = {each.attributes.get("_fullpath", ""): names[id(each)] for each in reversed(instances)}
    for instance in instances:
        tree_id = names[id(instance)]
        nodes = [each for each in instance.walk() if each is not instance]
        if tree_id not in firsts:
            firsts[tree_id] = [f"u{node.attributes.get('_uid', '')}" for node in nodes]
            written.append(_tree_of(instance, tree_id, by_path))
        for node, block in zip(nodes, firsts[tree_id], strict=True):
            blocks[_uid_of(node)] = tree_id, block
    models = next((each for each in root.children if each.tag == "TreeNodesModel"), None)
    kinds = _kinds(models)
    if models is not None:
        written.append(_models_of(models))
    try:
        xml = ET.tostring(written, "unicode")
    except RecursionError:
        raise GrootError("the tree of the other program is nested too deeply") from None
    project = from_xml(xml, file=FILE)
    files = {path: data for path, data in project.files.items() if path.startswith(("trees/", "project."))}
    numbers = {node.uid: number for number, node in enumerate(tree.nodes, 1)}
    if len(numbers) < len(tree.nodes):
        raise GrootError("the other program gives two nodes the same uid")
    rows = [
        TreeNode(
            uid=numbers[node.uid],
            parent=numbers.get(node.parent, 0),
            type=node.type,
            kind=kinds.get(node.type, "Action"),
            name=node.name,
            path=node.path,
            tree_id=blocks[node.uid][0],
            node_id=blocks[node.uid][1],
        )
        for node in tree.nodes
    ]
    actions = [action.to_json() for action in project.actions.values()]
    return AttachedDocument(xml, project.settings.main_tree, files, actions, rows, numbers)


def _uid_of(node: Element) -> int:
    text = node.attributes.get("_uid", "")
    return int(text) if text.isdecimal() else 0


def _names(instances: list[Element]) -> dict[int, str]:
    """Returns the ID of each instance's diagram; instances of one ID that differ get one each."""
    known: dict[_Shape, str] = {}
    taken: set[str] = set()
    names: dict[int, str] = {}
    for instance in instances:
        wanted = instance.attributes.get("ID", "") or "Main"
        shape = (
            wanted,
            tuple(
                (node.attributes.get("ID", "") if node.tag == _SUBTREE else node.tag, len(node.children))
                for node in instance.walk()
            ),
        )
        if shape not in known:
            number, name = 1, wanted
            while name in taken:
                number += 1
                name = f"{wanted}_{number}"
            taken.add(name)
            known[shape] = name
        names[id(instance)] = known[shape]
    return names


def _tree_of(instance: Element, tree_id: str, by_path: dict[str, str]) -> ET.Element:
    made = ET.Element("BehaviorTree", {"ID": tree_id})
    stack = [(child, made) for child in reversed(instance.children)]
    while stack:
        node, above = stack.pop()
        element = ET.SubElement(above, node.tag, _attributes(node, by_path))
        stack += [(child, element) for child in reversed(node.children)]
    return made


def _attributes(node: Element, by_path: dict[str, str]) -> dict[str, str]:
    kept = {name: text for name, text in node.attributes.items() if name not in _META}
    if node.tag == _SUBTREE:
        full = node.attributes.get("_fullpath", "")
        own = full.rpartition("/")[2]
        if own != f"{kept.get('ID', '')}::{node.attributes.get('_uid', '')}":
            kept["name"] = own
        kept["ID"] = by_path.get(full, kept.get("ID", ""))
    elif kept.get("name") == node.tag:
        del kept["name"]
    return kept | {"_bts_id": f"u{node.attributes.get('_uid', '')}"}


def _models_of(models: Element) -> ET.Element:
    """Returns the models of nodes that are not built in; those of subtrees too."""
    made = ET.Element(models.tag)
    for model in models.children:
        if model.attributes.get("ID", "") in builtins():
            continue
        copy = ET.SubElement(made, model.tag, model.attributes)
        for port in model.children:
            ET.SubElement(copy, port.tag, port.attributes).text = port.text or None
    return made


def _kinds(models: Element | None) -> dict[str, str]:
    found = {name: model.kind.capitalize() for name, model in builtins().items()}
    for model in models.children if models is not None else ():
        if model.tag in _KINDS:
            found[model.attributes.get("ID", "")] = _KINDS[model.tag]
    return found | {_SUBTREE: _SUBTREE}
