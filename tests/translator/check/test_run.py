"""All checks together, over whole projects."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import LEAF
from translator import from_xml
from translator.check.run import check
from translator.diagnostic import rules


def find(project, code):
    found = [item for item in check(project) if item.code == code]
    assert found, f"{code} is not among {[str(item) for item in check(project)]}"
    return found[0]


def test_examples_have_nothing_to_say(example):
    assert check(example) == ()


def test_who_tells_a_finding_in_another_language_gets_what_its_words_are_filled_with(make_project):
    nodes = {
        "n1": {"type": "Sequence", "children": ["a", "b"]},
        "a": {"type": "Act", "ports": {"result": "{speed}"}},
        "b": {"type": "Act", "ports": {"speed": "{spead}"}},
    }
    found = find(make_project(nodes), "BT0401").to_json()
    assert found["values"]["key"] == "spead"
    assert found["values"]["near"] == "speed"
    rule = rules()["BT0401"]
    assert found["message"] == rule.message.format(**found["values"])
    assert found["hint"] == rule.hint.format(**found["values"])


@pytest.mark.parametrize(
    ("nodes", "code"),
    [
        ({"n1": {"type": "Fallback", "children": ["a", "b"]}, "a": {"type": "Act"}, "b": LEAF}, "BT0114"),
        ({"n1": {"type": "Act", "ports": {"speed": "{=}", "result": "{speed}"}}}, "BT0401"),
        ({"n1": {"type": "Act", "ports": {"flag": "TRUE", "count": "-3", "speed": "1e3"}}}, "BT0204"),
        ({"n1": {"type": "Open", "ports": {"text": "a{b"}}}, "BT0203"),
        ({"n1": {"type": "TestNode", "ports": {"anything": "1"}}}, "BT0202"),
    ],
)
def test_what_is_right_is_not_reported(make_project, nodes, code):
    assert code not in [item.code for item in check(make_project(nodes))]


DRIVE = b"""<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><SubTree ID="Drive" distance="%s" times="%s"/></BehaviorTree>
<BehaviorTree ID="Drive"><Script code="x := distance * times"/></BehaviorTree>
<TreeNodesModel><SubTree ID="Drive">
  <input_port name="distance" type="double"/><input_port name="times" type="int"/>
</SubTree></TreeNodesModel></root>"""


@pytest.mark.parametrize(
    ("distance", "times", "codes"),
    [
        (b"2.0", b"3", []),
        (b"{there}", b"{=}", []),
        (b"2", b"3", [("BT0506", "distance")]),
        (b"far", b"3.5", [("BT0204", "distance"), ("BT0206", "times")]),
        (b"{there", b"{}", [("BT0203", "distance"), ("BT0207", "times")]),
    ],
)
def test_values_of_a_subtree_suit_the_ports_of_its_tree(distance, times, codes):
    found = [item for item in check(from_xml(DRIVE % (distance, times))) if item.code[:4] in {"BT02", "BT05"}]
    assert [(item.code, item.place.port) for item in found] == codes


@pytest.mark.parametrize(
    ("source", "code"),
    [
        ("def broken(:\n", "BT0601"),
        ("class Other: pass\n", "BT0602"),
        ("class Act:\n    def update(self): pass\n", "BT0603"),
        ("import py_trees\nclass Act(py_trees.behaviour.Behaviour):\n    pass\n", "BT0604"),
        ("x = 1\nfrom elsewhere import Act\n", "BT0607"),
    ],
)
def test_findings_in_actions_name_file_and_line(make_project, source, code):
    found = find(make_project({"n1": {"type": "Act"}}, actions={"Act": source}), code)
    assert found.place.file == "actions/Act.py"
    assert found.place.line


def test_action_named_like_a_builtin(make_project):
    project = make_project({"n1": LEAF}, actions={"Sequence": "class Sequence: pass"})
    assert find(project, "BT0609").place.file == "actions/Sequence.py"
