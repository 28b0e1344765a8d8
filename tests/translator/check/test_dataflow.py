"""The flow of data over the blackboard."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import find, findings, is_found_at_its_place
from translator import from_xml
from translator.check.dataflow import check_dataflow

CASES = {
    "never written": ("BT0401", {"n1": {"type": "Act", "ports": {"speed": "{k}"}}}, "n1"),
    "name never written": ("BT0401", {"n1": {"type": "ScriptCondition", "ports": {"code": "x > 1"}}}, "n1"),
    "never read": ("BT0402", {"n1": {"type": "Act", "ports": {"result": "{k}"}}}, "n1"),
}


@pytest.mark.parametrize("name", CASES)
def test_finding_and_its_place(make_project, name):
    is_found_at_its_place(check_dataflow, make_project, CASES[name])


GLOBAL = """<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><Sequence><SubTree ID="Set" {given}/><Script code="y := g"/></Sequence></BehaviorTree>
<BehaviorTree ID="Set">{inside}</BehaviorTree></root>"""


@pytest.mark.parametrize(
    ("given", "inside", "lost"),
    [
        ('x="{@g}"', '<Script code="x := 1"/>', ["x"]),
        ('x="{@g}"', '<SetBlackboard value="1" output_key="x"/>', ["x"]),
        ('x="{@g}"', '<LoopInt queue="1" value="{x}"><AlwaysSuccess/></LoopInt>', ["x"]),
        ('x="{@g}"', '<ScriptCondition code="x == 1"/>', []),
        ('x="{@g}"', '<Unknown value="{x}"/>', []),
        ("", '<Script code="@g := 1"/>', []),
        ('x="{g}"', '<Script code="x := 1"/>', []),
    ],
)
def test_a_write_through_a_remap_to_a_global_is_warned_of(given, inside, lost):
    found = findings(check_dataflow, from_xml(GLOBAL.replace("{given}", given).replace("{inside}", inside)))
    warnings = [item for item in found if item.code == "BT0404"]
    assert [item.place.port for item in warnings] == lost
    for item in warnings:
        assert "BehaviorTree.CPP loses this write" in item.message
        assert item.hint == "Write {@g} inside “Set”, and do not pass it."


def test_key_that_is_not_passed_to_a_subtree(make_project):
    inner = {"n1": {"type": "Act", "ports": {"speed": "{fast}"}}}
    outer = {"n1": {"type": "SubTree", "tree": "Inner"}}
    found = find(check_dataflow, make_project(outer, trees={"Inner": inner}), "BT0403")
    assert (found.place.tree, found.place.node, found.place.port) == ("MainTree", "n1", "fast")
    for ports, attributes in (({"fast": "1.5"}, {}), ({}, {"_autoremap": "true"})):
        node = {"type": "SubTree", "tree": "Inner", "ports": ports, "attributes": attributes}
        assert "BT0403" not in [
            item.code for item in findings(check_dataflow, make_project({"n1": node}, trees={"Inner": inner}))
        ]


def test_output_of_a_subtree_is_a_write_of_its_caller(make_project):
    inner = {"n1": {"type": "Act", "ports": {"result": "{out}"}}}
    nodes = {
        "n1": {"type": "Sequence", "children": ["a", "b"]},
        "a": {"type": "SubTree", "tree": "Inner", "ports": {"out": "{speed}"}},
        "b": {"type": "Act", "ports": {"speed": "{speed}"}},
    }
    assert findings(check_dataflow, make_project(nodes, trees={"Inner": inner})) == []


def test_global_key_written_in_a_subtree(make_project):
    nodes = {
        "n1": {"type": "Sequence", "children": ["a", "b"]},
        "a": {"type": "SubTree", "tree": "Inner"},
        "b": {"type": "Act", "ports": {"speed": "{k}"}},
    }
    inner = {"n1": {"type": "Script", "ports": {"code": "@k := 1"}}}
    found = [item.code for item in findings(check_dataflow, make_project(nodes, trees={"Inner": inner}))]
    assert "BT0403" not in found
