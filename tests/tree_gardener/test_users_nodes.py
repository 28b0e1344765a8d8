"""The calls that each of the user's nodes gets once."""

from __future__ import annotations

import functools
from typing import Any

import py_trees
import pytest

from tree_gardener import TickError, Tree, users_nodes
from tree_gardener.status import SUCCESS

XML = """<root BTCPP_format="4" main_tree_to_execute="T"><BehaviorTree ID="T"><Sequence>
<Own name="a"/><Own name="b"/><AlwaysSuccess/></Sequence></BehaviorTree></root>"""


def made(calls: list[str], failing: str = "") -> Tree:
    class Own(py_trees.behaviour.Behaviour):
        def call(self, what: str) -> None:
            calls.append(f"{what} {self.name}")
            if failing == f"{what} {self.name}":
                raise RuntimeError("no")

        def setup(self, **kwargs: object) -> None:
            self.call("setup")

        def update(self) -> py_trees.common.Status:
            return py_trees.common.Status.RUNNING

        def terminate(self, new_status: py_trees.common.Status) -> None:
            self.call("terminate")

        def shutdown(self) -> None:
            self.call("shutdown")

    return Tree.from_xml(XML, nodes={"Own": Own})


def test_each_is_set_up_once_in_order_until_one_raises():
    calls: list[str] = []
    users_nodes.setup(made(calls).nodes, None, {})
    assert calls == ["setup a", "setup b"]
    calls.clear()
    with pytest.raises(TickError, match="no"):
        users_nodes.setup(made(calls, "setup a").nodes, None, {})
    assert calls == ["setup a"]


def test_each_is_shut_down_and_the_first_error_is_returned():
    calls: list[str] = []
    error = users_nodes.shutdown(made(calls, "shutdown a").nodes)
    assert error is not None
    assert "no" in str(error)
    assert calls == ["shutdown a", "shutdown b"]
    assert users_nodes.shutdown(made([]).nodes) is None


def test_all_are_idle_though_one_cannot_be_halted():
    tree = made([], "terminate a")
    tree.tick_exactly_once()
    tree.nodes[-1].status = SUCCESS
    users_nodes.halt_one_by_one(tree.nodes)
    assert {node.status.name for node in tree.nodes} == {"IDLE"}


@pytest.mark.parametrize(
    ("setup", "given"),
    [
        (lambda _: {}, {}),
        (lambda _, node: {"node": node}, {"node": "the node"}),
        (lambda _, *, node=None: {"node": node}, {"node": "the node"}),
        (lambda _, timeout=1: {"timeout": timeout}, {"timeout": 1}),
        (lambda _, speed, node: {"node": node, "speed": speed}, {"node": "the node", "speed": 2}),
        (lambda _, **kwargs: kwargs, {"node": "the node", "speed": 2}),
    ],
)
def test_setup_gets_what_its_signature_takes(setup: Any, given: dict[str, object]) -> None:
    seen: list[dict[str, object]] = []

    class Own(py_trees.behaviour.Behaviour):
        def update(self) -> py_trees.common.Status:
            return py_trees.common.Status.SUCCESS

    Own.setup = functools.wraps(setup)(lambda *a, **k: seen.append(setup(*a, **k)))
    users_nodes.setup(Tree.from_xml(XML, nodes={"Own": Own}).nodes, "the node", {"speed": 2})
    assert seen == [given, given]


class Foo(py_trees.behaviour.Behaviour):
    """As py_trees' documentation writes an action."""

    def setup(self):
        self.count = 0

    def update(self):
        self.count += 1
        return py_trees.common.Status.SUCCESS if self.count > 2 else py_trees.common.Status.RUNNING


def test_the_skeleton_of_py_trees_runs() -> None:
    text = '<root BTCPP_format="4"><BehaviorTree ID="M"><Foo/></BehaviorTree></root>'
    tree = Tree.from_xml(text, nodes={"Foo": Foo})
    tree.setup(node=None)
    assert [tree.tick_exactly_once().name for _ in range(3)] == ["RUNNING", "RUNNING", "SUCCESS"]
