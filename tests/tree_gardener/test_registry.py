"""The node types, and classes that are no nodes."""

from __future__ import annotations

from typing import Any, ClassVar

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import LEAVES, Succeeding, document, load
from tree_gardener import ControlNode, DecoratorNode, LoadError, Port, Status, Tree
from tree_gardener.actions import load_actions
from tree_gardener.node import Control, Decorator
from tree_gardener.registry import BUILT_IN, OLD_NAMES, build_registry, built_in_types
from tree_gardener.status import SUCCESS


class NeedsMore(py_trees.behaviour.Behaviour):
    def __init__(self, name: str, more: int) -> None:
        super().__init__(name)

    def update(self) -> PyTreesStatus:
        return PyTreesStatus.SUCCESS


@pytest.mark.parametrize(
    ("name", "cls", "message"),
    [
        ("Sequence", Succeeding, "name of a built-in node"),
        ("X", "text", "is not a class"),
        ("X", int, "not derived from"),
        ("X", type("X", (Succeeding,), {"NODE_KIND": "Decorator"}), "NODE_KIND"),
        ("X", NeedsMore, "cannot be made"),
    ],
)
def test_classes_that_cannot_be_nodes_are_refused(name: str, cls: Any, message: str) -> None:
    with pytest.raises(LoadError, match=message):
        Tree.from_xml(document(f"<{name}/>" if name == "X" else "<Succeeding/>"), {**LEAVES, name: cls})


def run(self: Any) -> Status:
    result: Status = self.tick_child(0)
    return result


@pytest.mark.parametrize(
    ("base", "changes", "message"),
    [
        (DecoratorNode, {"NODE_KIND": "Control"}, "makes it a decorator"),
        (ControlNode, {"NODE_KIND": "Decorator"}, "makes it a control node"),
        (ControlNode, {"NODE_KIND": "Action"}, "makes it a control node"),
        (ControlNode, {"INPUT_PORTS": {"name": Port(int)}}, "'name' cannot be the name of a port"),
        (Succeeding, {"OUTPUT_PORTS": {"_x": Port(int)}}, "OUTPUT_PORTS: '_x' cannot be the name of a port"),
        (Succeeding, {"INPUT_PORTS": {3: Port(int)}}, "INPUT_PORTS: 3 cannot be the name of a port"),
    ],
)
def test_a_class_against_its_base_is_refused_with_its_file(base: type, changes: Any, message: str) -> None:
    cls = type("Own", (base,), {"update": run, "__module__": __name__, **changes})
    with pytest.raises(LoadError, match=message) as refused:
        build_registry({"Own": cls})
    [problem] = refused.value.diagnostics
    assert (problem.code, problem.file) == ("TG602", __file__)
    assert problem.line == run.__code__.co_firstlineno


def test_a_constructor_that_raises_is_named_with_its_line() -> None:
    source = "import py_trees\n\n\nclass Own(py_trees.behaviour.Behaviour):\n"
    source += "    def __init__(self, name):\n        1 / 0\n\n    def update(self):\n        pass\n"
    with pytest.raises(LoadError, match=r"ZeroDivisionError: division by zero at actions/Own\.py:6"):
        load("<Own/>", nodes=load_actions({"Own": source}))


class Both(Control):
    """Ticks all its children and succeeds."""

    __slots__ = ()

    def execute(self) -> Status:
        self.start()
        for tick in self.ticks:
            tick()
        return self.finish(SUCCESS)


class Twice(Decorator):
    """Ticks its child twice."""

    __slots__ = ()
    INPUT_PORTS: ClassVar = {"times": Port(int, default=2)}

    def execute(self) -> Status:
        self.start()
        for _ in range(self.get("times")):
            self.tick_child()
            self.reset()
        return self.finish(SUCCESS)


def test_nodes_of_ones_own_are_derived_from_the_engines() -> None:
    nodes = {"Both": Both, "Twice": Twice}
    tree = load("<Both><Twice times='3'><Failing/></Twice><Script code='x := 1'/></Both>", nodes=nodes)
    assert tree.tick_once() is Status.SUCCESS
    assert tree.blackboard["x"] == 1
    assert [node.kind for node in tree.nodes[:2]] == ["Control", "Decorator"]


def test_the_built_in_nodes_are_there_and_their_names_are_taken() -> None:
    registry = build_registry({"Mine": Succeeding})
    assert set(BUILT_IN) < set(registry)
    assert registry["Mine"].behaviour_class is Succeeding
    with pytest.raises(LoadError, match="TG601"):
        build_registry({"Sequence": Succeeding})
    assert set(OLD_NAMES.values()) <= set(built_in_types())
