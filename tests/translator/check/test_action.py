"""Actions that the trees use and nobody has written."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import find, findings
from translator.check.action import check_actions
from translator.stub import stub_source


def test_a_stub_is_reported_at_the_node_that_uses_it(make_project):
    project = make_project({"n1": {"type": "Later"}}, actions={"Later": stub_source("Later", None, [])})
    found = find(check_actions, project, "BT0613")
    assert (found.place.node, found.values["path"]) == ("n1", "actions/Later.py")


def test_a_stub_that_no_tree_uses_is_not_reported(make_project):
    project = make_project({"n1": {"type": "Act"}}, actions={"Later": stub_source("Later", None, [])})
    assert findings(check_actions, project) == []


PAINT = """
import py_trees
{head}
from tree_gardener import Port


class Paint(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {{
        "color": Port("Colour"),
    }}

    def update(self):
        return py_trees.common.Status.SUCCESS
"""
ENUMS = '{{"format": "bt-studio/enums", "version": 1, "enums": {{"{name}": {{"RED": 0}}}}}}'


@pytest.mark.parametrize(
    ("head", "enums", "lines"),
    [
        ("", "Color", [9]),
        ("", "Colour", []),
        ("from robot import Colour", "Color", []),
        ("class Colour:\n    pass\n", "Color", []),
    ],
)
def test_a_type_that_is_no_enumeration_is_reported_at_its_line(make_project, head, enums, lines):
    source = PAINT.format(head=head)
    files = {"enums.json": ENUMS.format(name=enums).encode()}
    project = make_project({"n1": {"type": "Paint"}}, actions={"Paint": source}, files=files)
    found = [item for item in findings(check_actions, project) if item.code == "BT0616"]
    assert [(item.place.file, item.place.line, item.place.port) for item in found] == [
        ("actions/Paint.py", line, "color") for line in lines
    ]


@pytest.mark.parametrize(
    ("time", "universe", "lines"),
    [
        ("exact", "walled_room", [9]),
        ("live", "walled_room", []),
        ("exact", "none", []),
    ],
)
def test_an_action_that_waits_is_reported_in_exact_time(make_project, time, universe, lines):
    source = """import time

import py_trees


class Wait(py_trees.behaviour.Behaviour):
    def update(self):
        self.waited = True
        time.sleep(1)
        return py_trees.common.Status.SUCCESS
"""
    project = make_project({"n1": {"type": "Wait"}}, actions={"Wait": source}, time=time, universe=universe)
    found = [item for item in findings(check_actions, project) if item.code == "BT0622"]
    assert [(item.place.file, item.place.line) for item in found] == [("actions/Wait.py", n) for n in lines]
    assert all(item.values["call"] == "time.sleep" for item in found)


def test_values_that_a_message_refuses_are_reported_with_what_to_write(make_project):
    source = """import py_trees
from geometry_msgs.msg import Twist
from tree_gardener.ports import Port, get_input


class Drive(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"speed": Port(int)}

    def update(self):
        twist = Twist()
        twist.linear.x = 1
        twist.angular.z = get_input(self, "speed")
        twist.lineer = 1.0
        return py_trees.common.Status.RUNNING
"""
    project = make_project({"n1": {"type": "Drive", "ports": {"speed": "1"}}}, actions={"Drive": source})
    found = {item.place.line: item for item in findings(check_actions, project)}
    assert {line: item.code for line, item in found.items()} == {11: "BT0631", 12: "BT0631", 13: "BT0632"}
    assert found[11].message == (
        "geometry_msgs/Vector3.x takes the type float, and gets 1: ROS refuses it when the line runs."
    )
    assert found[11].hint == "Write 1.0."
    assert found[13].hint == "The message has linear, angular."
