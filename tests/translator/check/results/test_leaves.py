"""The results of leaves."""

from __future__ import annotations

import pytest

from translator.action import inspect_action
from translator.check.results.leaves import of_action, of_leaf
from translator.check.results.sets import ALL, F, K, R, S
from translator.tree import Node


@pytest.mark.parametrize(
    ("type_", "ports", "result"),
    [
        ("AlwaysSuccess", {}, S),
        ("AlwaysFailure", {}, F),
        ("Script", {"code": "x := 1"}, S),
        ("ScriptCondition", {"code": "x"}, S | F),
        ("SetBlackboard", {"value": "1"}, S),
        ("SetBlackboard", {"value": "{x}"}, S | F),
        ("Sleep", {"msec": "0"}, S),
        ("Sleep", {"msec": "{t}"}, S | R),
        ("Sleep", {"msec": "10"}, S | R),
        ("TestNode", {}, ALL),
        ("RosAction", {}, S | F | R),
        ("RosAction", {"if_missing": "SKIPPED"}, ALL),
        ("RosService", {"if_missing": "{x}"}, ALL),
        ("RosSubscribe", {}, S | F),
        ("RosSubscribe", {"mode": "wait"}, S | F | R),
        ("RosPublish", {}, S),
        ("Unknown", {}, None),
    ],
)
def test_built_in_leaves(type_, ports, result):
    assert of_leaf(Node("n", type_, ports=ports)) == result


def test_an_action_may_return_more_than_it_names():
    source = (
        "import py_trees\nclass A(py_trees.behaviour.Behaviour):\n    def update(self):\n"
        "        if self.x:\n            return py_trees.common.Status.RUNNING\n        return self.y\n"
    )
    assert of_action(inspect_action(source, "actions/A.py")) == (ALL, R)
    condition = source.replace("    def", "    NODE_KIND = 'Condition'\n    def")
    assert of_action(inspect_action(condition, "actions/A.py")) == (S | F | K, 0)
