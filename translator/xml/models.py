"""Writes `<TreeNodesModel>` alone, and an XML Schema, as `writeTreeNodesModelXML` and `writeTreeXSD` do.

The schema describes the compact form (`<Sequence>`, not `<Control ID="Sequence">`). To what BehaviorTree.CPP
writes it adds models of SubTrees and inout ports, ports of nodes that take any, and this program's own
attributes, so that the documents that this program writes are valid.
"""

from __future__ import annotations

from importlib import resources
from typing import TYPE_CHECKING

from translator.catalog import NodeModel, PortModel, builtins
from translator.project import action_node_model
from translator.text import is_xml_name
from translator.tree import CONDITIONS, SUBTREE
from translator.xml.attributes import HIDDEN, METADATA
from translator.xml.escape import attribute
from translator.xml.write import EXPLICIT_TAGS, LAYOUT, model_element

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from translator.project import Project

_INDENT = "    "
_ONLY_IN_TESTS = "TestNode"  # a node becomes one by a substitution rule
_ANY = "BT::AnyTypeAllowed"
_XSD_TYPES = {
    "int": "integerOrBlackboardType",
    "uint": "integerOrBlackboardType",
    "double": "decimalOrBlackboardType",
    "bool": "booleanOrBlackboardType",
    "string": "stringOrBlackboardType",
    "script": "stringOrBlackboardType",
}
_CHILDREN = {"decorator": ("1", "1"), "control": ("0", "unbounded")}
_OWN_ATTRIBUTES = (*METADATA, *HIDDEN.values(), LAYOUT)
_TAKEN = {"name", *CONDITIONS, *_OWN_ATTRIBUTES}
_AUTOREMAP = '<xs:attribute name="_autoremap" type="booleanOrBlackboardType" default="false"/>'
_ANY_ATTRIBUTE = '<xs:anyAttribute processContents="skip"/>'


def to_models_xml(project: Project, *, with_builtins: bool = False) -> str:
    """Returns a document that holds the models of the project's actions, nodes and trees with ports.

    Other programs, such as Groot2, read it as a palette. The project needs no tree that runs.
    """
    models = [action_node_model(action) for action in project.actions.values()]
    if with_builtins:
        models += [model for model in builtins().values() if model.type not in {SUBTREE, _ONLY_IN_TESTS}]
    lines = ['<root BTCPP_format="4">', f"{_INDENT}<TreeNodesModel>"]
    for model in sorted(models, key=lambda model: model.type):
        tag = EXPLICIT_TAGS.get(model.kind, "Action")
        lines += model_element(tag, model.type, list(model.ports.values()), indent=_INDENT, any_type=_ANY)
    for _, tree in sorted(project.trees.items()):
        if tree.ports:
            lines += model_element(SUBTREE, tree.id, list(tree.ports), indent=_INDENT, any_type=_ANY)
    return "\n".join([*lines, f"{_INDENT}</TreeNodesModel>", "</root>", ""])


def to_xsd(project: Project) -> str:
    """Returns the XML Schema of documents with the built-in nodes and those of the project."""
    own = [action_node_model(action) for action in project.actions.values()]
    return xsd([*(model for model in builtins().values() if model.type != _ONLY_IN_TESTS), *own])


def xsd(models: Iterable[NodeModel]) -> str:
    """Returns the XML Schema of documents with these nodes."""
    # Others are written in the explicit form, which the schema does not describe.
    ordered = sorted((each for each in models if is_xml_name(each.type)), key=lambda model: model.type)
    frame = resources.files("translator.xml").joinpath("schema.xsd").read_text(encoding="utf-8")
    names = [
        f'{_INDENT * 3}<xs:element name="{attribute(model.type)}" type="{attribute(model.type)}Type"/>'
        for model in ordered
    ]
    optional = 'type="xs:string" use="optional"'
    own = [f'{_INDENT * 2}<xs:attribute name="{name}" {optional}/>' for name in _OWN_ATTRIBUTES]
    types = [line for model in ordered for line in _type(model)]
    for mark, lines in (("own attributes", own), ("nodes", names), ("types", types)):
        frame = frame.replace(f"<!-- {mark} -->\n", "".join(f"{line}\n" for line in lines))
    return frame


def _type(model: NodeModel) -> Iterator[str]:
    yield f'{_INDENT}<xs:complexType name="{attribute(model.type)}Type">'
    if model.kind in _CHILDREN:
        low, high = _CHILDREN[model.kind]
        yield f'{_INDENT * 2}<xs:group ref="oneNodeGroup" minOccurs="{low}" maxOccurs="{high}"/>'
    yield f'{_INDENT * 2}<xs:attributeGroup ref="commonAttributeGroup"/>'
    for port in model.ports.values():
        if is_xml_name(port.name) and port.name not in _TAKEN:
            yield _INDENT * 2 + _attribute(model, port)
    if model.type == SUBTREE:
        yield _INDENT * 2 + _AUTOREMAP
        yield f'{_INDENT * 2}<xs:attribute name="ID" type="xs:string" use="required"/>'
    if model.type == SUBTREE or model.open:
        yield _INDENT * 2 + _ANY_ATTRIBUTE
    yield f"{_INDENT}</xs:complexType>"


def _attribute(model: NodeModel, port: PortModel) -> str:
    kind = "blackboardType" if port.direction == "output" else _XSD_TYPES.get(port.type)
    if model.type == "ScriptCondition":
        kind = None  # its port has no type in C++
    typed = f' type="{kind}"' if kind is not None else ""
    use = 'use="required"' if port.default is None else f'default="{attribute(port.default)}"'
    return f'<xs:attribute name="{attribute(port.name)}"{typed} {use}/>'
