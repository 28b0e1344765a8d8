"""The document of a running tree: instances, uids, ports and models."""

from __future__ import annotations

from xml.etree import ElementTree as ET

from tests.tree_gardener.trees import subtree
from tree_gardener import Tree
from tree_gardener.groot.document import document_of, instances

BODY = subtree("Body", '<Delay delay_msec="5"><AlwaysSuccess name="a &lt; b" _skipIf="x == 1"/></Delay>')
MAIN = subtree("Main", '<Sequence><SubTree ID="Body" name="first" to="{x}"/><SubTree ID="Body"/></Sequence>')


def test_each_instance_has_a_tree_with_uids() -> None:
    tree = Tree.from_xml(f"<root main_tree_to_execute='Main'>{MAIN}{BODY}</root>")
    assert [[node.uid for node in nodes] for nodes in instances(tree)] == [[1, 2, 5], [3, 4], [6, 7]]
    document = ET.fromstring(document_of(tree))  # noqa: S314 - our own
    trees = document.findall("BehaviorTree")
    assert [(each.get("ID"), each.get("_fullpath")) for each in trees] == [
        ("Main", ""),
        ("Body", "first"),
        ("Body", "Body::5"),
    ]
    first, second = trees[0].iter("SubTree")
    assert first.attrib == {"ID": "Body", "_fullpath": "first", "_uid": "2", "to": "{x}"}
    assert (len(first), second.get("_fullpath")) == (0, "Body::5")
    leaf = trees[1].find(".//AlwaysSuccess")
    assert leaf is not None
    assert leaf.attrib == {"name": "a < b", "_uid": "4", "_skipIf": "x == 1"}


def test_built_in_nodes_have_models() -> None:
    tree = Tree.from_xml(f"<root>{subtree('Main', '<AlwaysSuccess/>')}</root>")
    models = ET.fromstring(document_of(tree)).find("TreeNodesModel")  # noqa: S314 - our own
    assert models is not None
    found = {model.get("ID"): model for model in models}
    assert {"Sequence", "SubTree", "Switch6", "Timeout"} <= found.keys()
    assert {model.tag for model in models} == {"Action", "Condition", "Control", "Decorator", "SubTree"}
    port = found["Repeat"].find("input_port")
    assert port is not None
    assert (port.get("name"), port.get("type")) == ("num_cycles", "int")


def test_a_deep_tree_is_written() -> None:
    deep = 190
    inner = "<Inverter>" * deep + "<AlwaysSuccess/>" + "</Inverter>" * deep
    tree = Tree.from_xml(f"<root>{subtree('Main', inner)}</root>")
    assert document_of(tree).count(b"<Inverter ") == deep
