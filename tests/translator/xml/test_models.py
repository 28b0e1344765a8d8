"""Models alone and the XML Schema, compared with BehaviorTree.CPP 4.10 (`types.json`)."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from lxml import etree

from translator import to_models_xml, to_xml, to_xsd
from translator.catalog import NodeModel, PortModel, builtins
from translator.xml.models import xsd
from translator.xml.read import read_document

FIXTURES: dict[str, Any] = json.loads(
    (Path(__file__).parents[2] / "conformance" / "types.json").read_text(encoding="utf-8")
)
XS = "{http://www.w3.org/2001/XMLSchema}"
MANY = (
    ("count", "input", "int", "3"),
    ("speed", "input", "double", "0.500000"),
    ("fast", "input", "bool", "true"),
    ("label", "input", "string", 'a < b & "c"'),
    ("needed", "input", "string", None),
    ("free", "input", "any", None),
    ("result", "output", "double", None),
    ("counter", "inout", "int", None),
    ("list", "input", "list[double]", None),
    ("key", "output", "string", "{=}"),
    ("size", "input", "uint", None),
    ("status", "input", "status", "FAILURE"),
)
OURS = {"inout_port", "SubTree"}
PORTS = """
import py_trees

from tree_gardener import ControlNode, DecoratorNode, Port, Status

"""
NUMBER = '{"n": Port(int, default=2, description="Number.")}'
LEAF = f'{PORTS}\nclass Seen(py_trees.behaviour.Behaviour):\n    NODE_KIND = "Condition"\n'
SOURCES = {
    "Both": f"{PORTS}\nclass Both(ControlNode):\n    INPUT_PORTS = {NUMBER}\n",
    "Once": f"{PORTS}\nclass Once(DecoratorNode):\n    INPUT_PORTS = {{}}\n",
    "Seen": LEAF + '    INPUT_PORTS = {"id": Port(int)}\n',
}


def model(type_: str, kind: str, *ports: tuple[str, str, str, str | None]) -> NodeModel:
    return NodeModel(type_, kind, 0, None, {port[0]: PortModel(*port) for port in ports})


def parsed(text: str) -> Any:
    return etree.fromstring(text.encode())


def canonical(element: Any) -> Any:
    """An element without the order of attributes of a node, and without what this program adds."""
    added = ("_bts_", "_description")
    children = [
        canonical(child)
        for child in element
        if isinstance(child.tag, str)
        and child.get("name", "") not in OURS
        and not child.get("name", "").startswith(added)
        and child.tag != f"{XS}anyAttribute"
    ]
    if element.get("name", "").endswith("Type") and element.tag == f"{XS}complexType":
        children.sort(key=str)
    return (element.tag, dict(element.attrib), children)


def test_the_schema_is_that_of_behaviortree_cpp() -> None:
    own = [
        model("Many", "action", *MANY),
        model("Seen", "condition", ("id", "input", "int", None)),
        model("Once", "decorator"),
        model("Both", "control", ("n", "input", "int", "2")),
    ]
    theirs = parsed(FIXTURES["xsd"])
    known = [each for each in builtins().values() if not each.group and each.type != "TestNode"]
    ours = parsed(xsd([*known, *own]))
    found = {child.get("name"): canonical(child) for child in ours if isinstance(child.tag, str)}
    wanted = {child.get("name"): canonical(child) for child in theirs if isinstance(child.tag, str)}
    differing = {name for name in found.keys() | wanted.keys() if found.get(name) != wanted.get(name)}
    assert {"ManyType", "BothType", "SequenceType"} <= wanted.keys()
    assert differing == set()


def test_documents_of_this_program_are_valid(example) -> None:
    schema = etree.XMLSchema(parsed(to_xsd(example)))
    schema.assertValid(parsed(to_xml(example)))


@pytest.mark.parametrize("change", [("<BehaviorTree", "<Sequenze/><BehaviorTree"), (' BTCPP_format="4"', "")])
def test_a_wrong_document_is_not_valid(example, change: tuple[str, str]) -> None:
    schema = etree.XMLSchema(parsed(to_xsd(example)))
    assert not schema.validate(parsed(to_xml(example).replace(*change)))


def test_a_node_that_has_no_name_for_xml_is_left_out() -> None:
    text = xsd([model("a b", "action"), model("Good", "action", ("1st", "input", "int", None))])
    assert "a b" not in text
    assert "1st" not in text
    assert 'name="GoodType"' in text


def test_an_open_node_takes_any_port() -> None:
    text = xsd([NodeModel("Open", "action", 0, 0, {}, open=True)])
    assert "anyAttribute" in text.partition('name="OpenType"')[2]


def models_of(text: str) -> dict[str, Any]:
    """The models of a document, with the names of types as this program writes them."""
    return {
        each.get("ID"): (each.tag, dict(map(port_of, each))) for each in parsed(text).find("TreeNodesModel")
    }


def port_of(element: Any) -> tuple[str, Any]:
    kind = re.sub(r", std::allocator<\w+> ", "", element.get("type", ""))
    return element.get("name"), (element.tag, kind, element.text)


def test_models_alone_are_those_of_behaviortree_cpp(make_project) -> None:
    project = make_project({"n1": {"type": "AlwaysSuccess"}}, actions=SOURCES)
    found, wanted = models_of(to_models_xml(project)), models_of(FIXTURES["models"])
    assert {name: found[name] for name in SOURCES} == {name: wanted[name] for name in SOURCES}
    assert list(found) == sorted(found)
    assert read_document(to_models_xml(project), file="models.xml").models.keys() == found.keys()


def test_built_in_nodes_are_written_if_wanted(make_project) -> None:
    project = make_project({"n1": {"type": "AlwaysSuccess"}})
    found, wanted = models_of(to_models_xml(project, with_builtins=True)), models_of(FIXTURES["builtin"])
    missing = wanted.keys() - found.keys() - {"Many", "Seen", "Once", "Both", "SubTree"}
    assert missing == set()
    kinds = {name: wanted[name][0] for name in wanted.keys() & found.keys()}
    assert {name: found[name][0] for name in kinds} == kinds
    ports = {name: wanted[name][1].keys() for name in kinds}
    assert {name: found[name][1].keys() for name in kinds} == ports


def test_trees_with_ports_are_models_too(make_project) -> None:
    project = make_project({"n1": {"type": "AlwaysSuccess"}})
    [tree] = project.trees.values()
    ported = project.with_tree(type(tree)(tree.id, tree.root, tree.nodes, ports=(PortModel("goal"),)))
    assert models_of(to_models_xml(ported))["MainTree"] == (
        "SubTree", {"goal": ("input_port", "BT::AnyTypeAllowed", None)},
    )  # fmt: skip
