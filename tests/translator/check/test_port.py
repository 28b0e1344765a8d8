"""Values of ports."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import LEAF, find, findings, is_found_at_its_place
from translator.check.port import check_ports
from translator.diagnostic import Severity

GOING = "nav2_msgs/action/NavigateToPos"
GO = {"action_name": "/go", "action_type": "nav2_msgs/action/NavigateToPose"}
CASES = {
    "no name in ROS": ("BT0204", {"n1": {"type": "RosAction", "ports": {**GO, "action_name": "/a b"}}}, "n1"),
    "missing port": ("BT0201", {"n1": {"type": "Delay", "children": ["a"]}, "a": LEAF}, "n1"),
    "unknown port": ("BT0202", {"n1": {"type": "Act", "ports": {"sped": "1"}}}, "n1"),
    "brace open": ("BT0203", {"n1": {"type": "Act", "ports": {"speed": "{x"}}}, "n1"),
    "no number": ("BT0204", {"n1": {"type": "Act", "ports": {"speed": "fast"}}}, "n1"),
    "no integer": ("BT0204", {"n1": {"type": "Act", "ports": {"count": "many"}}}, "n1"),
    "integer too large": ("BT0212", {"n1": {"type": "Act", "ports": {"count": "99999999999"}}}, "n1"),
    "number too large": ("BT0212", {"n1": {"type": "Act", "ports": {"speed": "1e400"}}}, "n1"),
    "watching no entry": ("BT0201", {"n1": {"type": "WasEntryUpdated", "ports": {"entry": ""}}}, "n1"),
    "no boolean": ("BT0204", {"n1": {"type": "Act", "ports": {"flag": "perhaps"}}}, "n1"),
    "literal output": ("BT0205", {"n1": {"type": "Act", "ports": {"result": "5"}}}, "n1"),
    "read in part": ("BT0206", {"n1": {"type": "Act", "ports": {"count": "12abc"}}}, "n1"),
    "empty key": ("BT0207", {"n1": {"type": "Act", "ports": {"speed": "{}"}}}, "n1"),
    "bad key": ("BT0208", {"n1": {"type": "Act", "ports": {"speed": "{@a@b}"}}}, "n1"),
    "JSON in the queue of a loop": (
        "BT0215",
        {"n1": {"type": "LoopInt", "children": ["a"], "ports": {"queue": "json:[1]"}}, "a": LEAF},
        "n1",
    ),
    "an equals sign": ("BT0213", {"n1": {"type": "UnsetBlackboard", "ports": {"key": "="}}}, "n1"),
    "blanks round a key": ("BT0204", {"n1": {"type": "Act", "ports": {"count": " {k}"}}}, "n1"),
    "no field of the interface": (
        "BT0202",
        {"n1": {"type": "RosAction", "ports": {**GO, "goal__pos": "1"}}},
        "n1",
    ),
    "no number for a field": (
        "BT0204",
        {"n1": {"type": "RosAction", "ports": {**GO, "goal__pose__pose__position__x": "far"}}},
        "n1",
    ),
    "no such interface": (
        "BT0204",
        {"n1": {"type": "RosAction", "ports": {**GO, "action_type": GOING}}},
        "n1",
    ),
    "a service as an action": (
        "BT0204",
        {"n1": {"type": "RosAction", "ports": {**GO, "action_type": "std_srvs/srv/Trigger"}}},
        "n1",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_finding_and_its_place(make_project, name):
    is_found_at_its_place(check_ports, make_project, CASES[name])


@pytest.mark.parametrize(
    ("code", "ports"),
    [
        ("BT0203", {"any": "{x"}),
        ("BT0207", {"any": "{}"}),
        ("BT0208", {"any": "{a}{b}"}),
        ("BT0209", {"1st": "x"}),
        ("BT0209", {"é": "x"}),
    ],
)
def test_what_the_engine_takes_as_a_text_or_ignores_is_a_warning(make_project, code, ports):
    project = make_project({"n1": {"type": "Open", "ports": ports}})
    assert find(check_ports, project, code).severity is Severity.WARNING


def test_blanks_round_a_key_are_no_fault_of_a_text(make_project):
    project = make_project({"n1": {"type": "UnsetBlackboard", "ports": {"key": " {k} "}}})
    assert findings(check_ports, project) == []


def test_the_nearest_name_of_a_port_is_suggested(make_project):
    project = make_project({"n1": {"type": "Act", "ports": {"sped": "1"}}})
    assert "speed" in find(check_ports, project, "BT0202").hint


PLACED = """
import py_trees

from poses import Pose
from tree_gardener import Port


class Placed(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"pose": Port(Pose)}
"""


@pytest.mark.parametrize(("text", "codes"), [("json:{", ["BT0204"]), ('json:{"x": 1}', []), ("1,2", [])])
def test_a_literal_in_json_of_a_class_must_be_json(make_project, text, codes):
    project = make_project({"n1": {"type": "Placed", "ports": {"pose": text}}}, actions={"Placed": PLACED})
    assert [found.code for found in findings(check_ports, project)] == codes
