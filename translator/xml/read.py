"""Reads trees from BehaviorTree.CPP XML: v3 and v4, compact and explicit form, with models and includes."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from translator.catalog import NodeModel, PortModel
from translator.diagnostic import Diagnostic, Place, TranslatorError, diagnostic
from translator.text import clean, is_clean, is_xml_name
from translator.tree import SUBTREE, Node, Span, Tree
from translator.xml.attributes import from_attributes
from translator.xml.capital import with_small_root
from translator.xml.py_trees import converted, defaults_of, included_path, is_of_py_trees
from translator.xml.source import Element, Source, parse_source
from translator.xml.v3 import is_of_v4, remapped, remaps_of, upgrade
from translator.xml.write import CPP_TYPES, LAYOUT, PORT_TAGS

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

EXPLICIT = {"Control": "control", "Decorator": "decorator", "Action": "action", "Condition": "condition"}
MODEL_TAGS = ("TreeNodesModel", "TreeNodeModel")
OTHER_TAGS = {*MODEL_TAGS, "include", "Code", "Enums"}
_TYPE_NAMES = {cpp: name for name, cpp in reversed(CPP_TYPES.items())} | {
    "BT::AnyTypeAllowed": "any",
    "std::string": "string",
    "float": "double",
    "int32_t": "int",
    "unsigned": "uint",
    "uint32_t": "uint",
}
# As compilers write the names of templates with their default arguments.
_LONG_STRING = re.compile(
    r"std::(?:__\w+::)?basic_string<char, std::(?:__\w+::)?char_traits<char>, [^<>]*<char> ?>"
)
_ALLOCATOR = re.compile(r", std::(?:__\w+::)?allocator<[^<>]*> ?(?=>)")
_CPP_NAME = re.compile(r"(?:[A-Za-z_]\w*::)*([A-Za-z_]\w*)")
_VERSION = re.compile(r"\s*([0-9]{1,4})(?:\.[0-9.]*)?\s*")
_WHOLE = re.compile(r"-?[0-9]{1,20}")
_DIRECTIONS = {tag: direction for direction, tag in PORT_TAGS.items()} | {"Parameter": "input"}


@dataclass(slots=True)
class TreeSource:
    """One `<BehaviorTree>`: the tree as it was read, and the element of each node."""

    tree: Tree
    element: Element
    elements: dict[str, Element]
    upgraded: set[str] = field(default_factory=set)
    is_renamed: bool = False


@dataclass(slots=True)
class Document:
    """The content of one XML file."""

    source: Source
    is_v4: bool
    main: str
    is_of_py_trees: bool = False
    trees: list[TreeSource] = field(default_factory=list)
    models: dict[str, NodeModel] = field(default_factory=dict)
    includes: list[Element] = field(default_factory=list)
    code: dict[str, str] = field(default_factory=dict)
    enums: dict[str, dict[str, int | str]] = field(default_factory=dict)
    kinds: dict[str, str] = field(default_factory=dict)
    diagnostics: list[Diagnostic] = field(default_factory=list)

    @property
    def file(self) -> str:
        """The name under which the document was read."""
        return self.source.file


def read_document(raw: bytes | str, *, file: str) -> Document:
    """Reads one document; findings that do not prevent reading are in its `diagnostics`.

    Raises:
        TranslatorError: If the text is not accepted as XML, or is not a behaviour tree.
    """
    source, notes = with_small_root(parse_source(raw, file=file))
    root = source.root
    if root.tag != "root":
        place = Place(file, line=root.line, column=root.column)
        raise TranslatorError([diagnostic("BT0703", place, tag=root.tag)])
    document = Document(source, is_v4=False, main=root.attributes.get("main_tree_to_execute", ""))
    document.diagnostics += notes
    _Reader(document).read()
    return document


class _Reader:
    """Fills a document from its root element."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.file = document.file

    def report(self, code: str, element: Element, tree: str = "", node: str = "", **values: object) -> None:
        place = Place(self.file, tree=tree, node=node, line=element.line, column=element.column)
        self.document.diagnostics.append(diagnostic(code, place, **values))

    def read(self) -> None:
        root = self.document.source.root
        self.document.is_of_py_trees = is_of_py_trees(root)
        if self.document.is_of_py_trees:
            self.report("BT0728", root)
        else:
            self.document.is_v4 = self.version(root)
        last = {self.id_of(element): element for element in self.trees()}
        taken: set[str] = set()
        models = [element for element in root.children if element.tag in MODEL_TAGS]
        for element in models:
            if element.tag != MODEL_TAGS[0]:
                self.report("BT0725", element, tag=element.tag)
            self.read_models(element)
        for extra in models[1:]:
            self.report("BT0710", extra)
        for element in root.children:
            if element.tag == "BehaviorTree":
                self.read_tree(element, last, taken)
            elif element.tag == "include" or included_path(element):
                self.document.includes.append(element)
            elif element.tag == "Code":
                self.read_code(element)
            elif element.tag == "Enums":
                self.read_enums(element)
            elif element.tag not in OTHER_TAGS:
                self.report("BT0711", element, tag=element.tag)

    def version(self, root: Element) -> bool:
        """Returns whether a document is of version 4; one that names no version, by what it uses."""
        said = root.attributes.get("BTCPP_format")
        if said is not None:
            if (number := _VERSION.fullmatch(said)) is not None:
                return int(number.group(1)) >= 4
            self.report("BT0724", root, format=said)
        found = is_of_v4(root)
        if found is not None:
            self.report("BT0723", root, what=found)
        return found is not None

    def read_code(self, element: Element) -> None:
        for child in element.children:
            name = child.attributes.get("name", child.tag)
            self.document.code[name] = child.text

    def read_enums(self, element: Element) -> None:
        for child in element.children:
            values = [value.attributes for value in child.children]
            numbers = {value.get("name", ""): _whole(value.get("value", "")) for value in values}
            self.document.enums[child.attributes.get("name", "")] = numbers

    def read_tree(self, element: Element, last: Mapping[str, Element], taken: set[str]) -> None:
        tree_id = self.id_of(element)
        if not element.attributes.get("ID") and len(list(self.trees())) > 1:
            self.report("BT0712", element, tree_id, id=tree_id)
        if last[tree_id] is not element:
            name = _free(tree_id, taken | last.keys())
            self.report("BT0713", element, name, id=tree_id, name=name)
        else:
            name = tree_id
        taken.add(name)
        if not element.children:
            self.report("BT0722", element, name, id=name)
        elif len(element.children) > 1:
            self.report("BT0714", element, name, id=name, count=len(element.children))
        made = self.tree_source(element, name)
        made.is_renamed = name != tree_id
        self.document.trees.append(made)

    def trees(self) -> Iterator[Element]:
        return (element for element in self.document.source.root.children if element.tag == "BehaviorTree")

    def id_of(self, tree: Element) -> str:
        return tree.attributes.get("ID") or self.document.main or "MainTree"

    def tree_source(self, element: Element, tree_id: str) -> TreeSource:
        explicit_ids = {below.attributes.get("_bts_id", "") for below in element.walk()}
        result = TreeSource(Tree(tree_id, None, {}), element, {})
        ids = self.node_ids(element, explicit_ids)
        nodes: dict[str, Node] = {}
        for below in element.walk():
            if id(below) in ids:
                node = self.node(below, ids, tree_id, result)
                nodes[node.id] = node
                result.elements[node.id] = below
        tops = [ids[id(child)] for child in element.children]
        model = self.document.models.get(f"{SUBTREE}:{tree_id}")
        known = {"ID", LAYOUT}
        result.tree = Tree(
            id=tree_id,
            root=tops[0] if tops else None,
            nodes=nodes,
            drafts=tuple(tops[1:]),
            layout=element.attributes.get(LAYOUT, ""),
            ports=tuple(model.ports.values()) if model else self.defaults(element),
            attributes={key: text for key, text in element.attributes.items() if key not in known},
            file=self.file,
        )
        return result

    def defaults(self, tree: Element) -> tuple[PortModel, ...]:
        return defaults_of(tree) if self.document.is_of_py_trees else ()

    def node_ids(self, tree: Element, explicit: set[str]) -> dict[int, str]:
        """Returns each element's id: the one that it has, or the next free `n<number>` in pre-order."""
        ids: dict[int, str] = {}
        used: set[str] = set()
        number = 0
        remaps = {id(remap) for below in tree.walk() for remap in remaps_of(below)}
        for below in tree.walk():
            if below is tree or id(below) in remaps:
                continue
            own = below.attributes.get("_bts_id", "")
            if not own or own in used:
                number += 1
                while f"n{number}" in explicit or f"n{number}" in used:
                    number += 1
                own = f"n{number}"
            used.add(own)
            ids[id(below)] = own
        return ids

    def node(self, element: Element, ids: dict[int, str], tree_id: str, into: TreeSource) -> Node:
        node_id = ids[id(element)]
        type_, attributes = self.typed(element, tree_id, node_id)
        remaps = remaps_of(element)
        changes = [("<remap>", "an attribute")] if remaps else []
        if not self.document.is_v4:
            upgraded = (converted if self.document.is_of_py_trees else upgrade)(type_, attributes)
            changes += upgraded.changes
            type_, attributes = upgraded.type, upgraded.attributes
        if remaps:
            attributes = remapped(attributes, remaps)
        if changes:
            into.upgraded.add(node_id)
            for before, after in changes:
                self.report("BT0720", element, tree_id, node_id, before=before, after=after)
        fields: dict[str, Any] = from_attributes(attributes, is_subtree=type_ == SUBTREE)
        fields["id"] = node_id
        children = tuple(ids[id(child)] for child in element.children if id(child) in ids)
        return Node(type=type_, children=children, span=Span(element.line, element.column), **fields)

    def typed(self, element: Element, tree_id: str, node_id: str) -> tuple[str, Mapping[str, str]]:
        """Returns the type of an element in either form, and its other attributes."""
        attributes = element.attributes
        if self.document.is_of_py_trees:
            return element.tag, attributes
        if element.tag not in EXPLICIT:
            if "ID" in attributes and element.tag not in {SUBTREE, "SubTreePlus", "Subtree"}:
                self.report("BT0715", element, tree_id, node_id, tag=element.tag)
            return element.tag, attributes
        type_ = attributes.get("ID", "")
        if not type_:
            self.report("BT0716", element, tree_id, node_id, tag=element.tag)
            return element.tag, attributes
        self.document.kinds.setdefault(type_, EXPLICIT[element.tag])
        return type_, {name: text for name, text in attributes.items() if name != "ID"}

    def read_models(self, element: Element) -> None:
        for child in element.children:
            kind = "subtree" if child.tag == SUBTREE else EXPLICIT.get(child.tag)
            type_ = child.attributes.get("ID", "")
            if kind is None or not type_:
                self.report("BT0717", child, tag=child.tag)
                continue
            ports = [self.port(port) for port in child.children if port.tag in _DIRECTIONS]
            for port in ports:
                if not is_xml_name(port.name) or port.name.startswith("_") or port.name in {"name", "ID"}:
                    self.report("BT0718", child, port=port.name, type=type_)
            low, high = {"control": (1, None), "decorator": (1, 1)}.get(kind, (0, 0))
            model = NodeModel(type_, kind, low, high, {port.name: port for port in ports if port.name})
            key = f"{SUBTREE}:{type_}" if kind == "subtree" else type_
            self.document.models[key] = model

    def port(self, element: Element) -> PortModel:
        attributes = element.attributes
        text = " ".join((element.text or attributes.get("description", "")).split())
        cpp = attributes.get("type", "")
        type_ = type_name(cpp)
        own = _CPP_NAME.fullmatch(cpp) if type_ == "any" and cpp not in _TYPE_NAMES else None
        return PortModel(
            name=attributes.get("label" if element.tag == "Parameter" else "name", ""),
            direction=_DIRECTIONS[element.tag],
            type=type_,
            named=own.group(1) if own else "",
            default=attributes.get("default"),
            description=text if is_clean(text) else clean(text),
        )


def type_name(cpp: str) -> str:
    """Returns the catalogue's name of a C++ type; `any` if the catalogue does not have it."""
    if "<" in cpp:
        cpp = _ALLOCATOR.sub("", _LONG_STRING.sub("std::string", cpp)).replace("std::__1::", "std::")
    if cpp.startswith("std::vector<") and cpp.endswith(">"):
        inner = type_name(cpp[len("std::vector<") : -1])
        return f"list[{inner}]" if inner in {"int", "double", "bool", "string"} else "any"
    return _TYPE_NAMES.get(cpp, "any") if cpp not in {"script", "status"} else cpp


def _whole(text: str) -> int | str:
    """Returns a number of an enumeration; other text stays a string, which the project's check reports."""
    return int(text) if _WHOLE.fullmatch(text) else text


def _free(name: str, taken: set[str]) -> str:
    number = 2
    while f"{name}_{number}" in taken:
        number += 1
    return f"{name}_{number}"
