"""Branches that run at once."""

from __future__ import annotations

import pytest

from tests.translator.check.finding import LEAF, find, findings
from tests.translator.check.test_order import tree, under
from translator.check.together import check_together

WAITS = {"type": "Sleep", "ports": {"msec": "10"}}
TESTS = {"type": "ScriptCondition", "ports": {"code": "z"}}
X = {"type": "Script", "ports": {"code": "x := 1"}}
ACT = """
import py_trees
from geometry_msgs.msg import Twist


class {name}(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        self.publisher = kwargs["node"].create_publisher(Twist, "/cmd_vel", 10)

    def update(self):
        return {returns}
"""
STATUS = "py_trees.common.Status."
ACTIONS = {
    "Turn": ACT.format(name="Turn", returns=f"{STATUS}SUCCESS if self.done else {STATUS}RUNNING"),
    "Forward": ACT.format(name="Forward", returns=f"{STATUS}RUNNING"),
    "Stop": ACT.format(name="Stop", returns=f"{STATUS}SUCCESS"),
    "Odd": ACT.format(name="Odd", returns="self.result"),
}
TURN, FORWARD, STOP, ODD = ({"type": name} for name in ACTIONS)


@pytest.mark.parametrize(
    "nodes",
    [
        tree(
            "ReactiveFallback", under("Sequence", TESTS, TURN), FORWARD
        ),  # it never fails after it has waited
        tree("ReactiveSequence", under("Fallback", TESTS, FORWARD), WAITS),
    ],
)
def test_a_child_that_only_continues_when_it_has_not_waited(make_project, nodes):
    assert "BT0121" not in [code for code, _ in codes(make_project(nodes, actions=ACTIONS))]


def codes(project):
    return [(item.code, item.place.node) for item in findings(check_together, project)]


def test_two_children_of_a_reactive_node_that_can_run(make_project):
    found = find(check_together, make_project(tree("ReactiveSequence", TESTS, WAITS, WAITS)), "BT0121")
    assert found.place.node == "c2"
    assert [step.node for step in found.path] == ["n1", "c1", "c2"]


@pytest.mark.parametrize(
    "nodes",
    [
        tree("ReactiveSequence", TESTS, WAITS),
        tree("Sequence", WAITS, WAITS),
        tree("ReactiveFallback", {"type": "Open"}, {"type": "Unknown"}, WAITS),
        tree("ReactiveFallback", under("AsyncFallback", TESTS, TESTS), WAITS),  # it only yields
    ],
)
def test_reactive_nodes_with_one(make_project, nodes):
    assert codes(make_project(nodes)) == []


def test_two_branches_of_a_parallel_that_write_a_key(make_project):
    nodes = tree("Parallel", under("Sequence", LEAF, X), under("Inverter", X))
    found = find(check_together, make_project(nodes), "BT0406")
    assert found.place.node == "c1_0"
    assert [(step.node, step.role) for step in found.path] == [
        ("n1", ""),
        ("c0_1", "writes"),
        ("c1_0", "writes"),
    ]
    other = {"n1": {"type": "Script", "ports": {"code": "inner := 1"}}}
    call = {"type": "SubTree", "tree": "Other", "ports": {"inner": "{x}"}}
    assert ("BT0406", "c1") in codes(make_project(tree("ParallelAll", X, call), trees={"Other": other}))


@pytest.mark.parametrize(
    "nodes",
    [
        tree("Sequence", X, X),
        tree("Parallel", under("Sequence", X, X), LEAF),
        tree("Parallel", X, {"type": "Open", "ports": {"a": "{x}"}}),
    ],
)
def test_keys_of_one_branch(make_project, nodes):
    assert codes(make_project(nodes)) == []


@pytest.mark.parametrize(
    ("nodes", "place"),
    [
        (tree("Parallel", TURN, FORWARD), "c1"),
        (tree("ParallelAll", under("Sequence", TESTS, ODD), under("Inverter", ODD)), "c1_0"),
        (tree("ReactiveSequence", STOP, FORWARD), "c1"),
        (tree("ReactiveFallback", under("Inverter", STOP), FORWARD), "c1"),
        (tree("WhileDoElse", under("Sequence", STOP, TESTS), FORWARD, TURN), "c1"),
    ],
)
def test_two_commands_at_once(make_project, nodes, place):
    found = find(check_together, make_project(nodes, actions=ACTIONS), "BT0122")
    assert found.place.node == place
    assert [step.what for step in found.path if step.role == "commands"] == ["/cmd_vel", "/cmd_vel"]


@pytest.mark.parametrize(
    "nodes",
    [
        tree("Sequence", TURN, FORWARD),
        tree("ReactiveFallback", under("Sequence", TESTS, TURN), FORWARD),  # after the turn it is done
        tree("ReactiveSequence", under("Fallback", TESTS, ODD), FORWARD),  # what it returns is not known
        tree("IfThenElse", TESTS, TURN, FORWARD),
        tree("Parallel", {**TURN, "disabled": True}, FORWARD),
        tree("Parallel", LEAF, FORWARD),
    ],
)
def test_one_command_at_a_time(make_project, nodes):
    assert "BT0122" not in [code for code, _ in codes(make_project(nodes, actions=ACTIONS))]


def test_commands_of_called_trees(make_project):
    call = {"type": "SubTree", "tree": "Other"}
    avoid = tree("Sequence", TESTS, TURN)
    project = make_project(tree("ReactiveFallback", call, FORWARD), trees={"Other": avoid}, actions=ACTIONS)
    assert "BT0122" not in [code for code, _ in codes(project)]
    project = make_project(tree("Parallel", call, FORWARD), trees={"Other": avoid}, actions=ACTIONS)
    found = find(check_together, project, "BT0122")
    assert [(step.tree, step.node) for step in found.path] == [
        ("MainTree", "n1"),
        ("MainTree", "c0"),
        ("Other", "c1"),
        ("MainTree", "c1"),
    ]
