"""Trees and a scripted user for the tests of the debugger."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import py_trees
from py_trees.common import Status as PyTreesStatus

from tree_gardener import Tree
from tree_gardener.debugging import Debugger, Stop

if TYPE_CHECKING:
    from collections.abc import Callable

    from tree_gardener.node import Node

RESULTS = {"S": PyTreesStatus.SUCCESS, "F": PyTreesStatus.FAILURE, "R": PyTreesStatus.RUNNING}


class Leaf(py_trees.behaviour.Behaviour):
    """Returns what the letters behind the point of its name say, and notes its calls; the last one stays."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.calls: list[str] = []

    def initialise(self) -> None:
        self.calls.append("initialise")

    def update(self) -> Any:
        letters = self.name.rpartition(".")[2]
        ticks = self.calls.count("update")
        self.calls.append("update")
        return RESULTS[letters[min(ticks, len(letters) - 1)]]

    def terminate(self, new_status: PyTreesStatus) -> None:
        self.calls.append(f"terminate {new_status.name}")


def tree_of(body: str, more: str = "", **nodes: Any) -> Tree:
    """A tree of a body, and other BehaviorTrees."""
    text = f'<root BTCPP_format="4"><BehaviorTree ID="Main">{body}</BehaviorTree>{more}</root>'
    return Tree.from_xml(text, {"Leaf": Leaf, **nodes}, main_tree="Main")


def named(tree: Tree, name: str) -> Node:
    """The node with a name, in front of the point."""
    return next(node for node in tree.nodes if node.name.partition(".")[0] == name)


def calls(tree: Tree, name: str) -> list[str]:
    """The calls of a leaf."""
    found: list[str] = named(tree, name).behaviour.calls
    return found


class User:
    """Does one thing at each stop, in order, and then lets the tree continue.

    Attributes:
        stops: the stops so far, as ``name: what``.
    """

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        self.script: list[Callable[[Debugger], object]] = []
        self.stops: list[str] = []
        self.last: Stop | None = None
        self.said: list[str] = []
        self.debugger = Debugger(self.hold, self.said.append)
        tree.debug(self.debugger)

    def hold(self, stop: Stop) -> None:
        """Notes a stop and does what is next."""
        node = self.tree.nodes[stop.uid - 1]
        self.stops.append(f"{node.name.partition('.')[0] or node.type}: {stop.what}")
        self.last = stop
        if self.script:
            self.script.pop(0)(self.debugger)

    def at_next(self, *script: Callable[[Debugger], object]) -> None:
        """Sets what is done at the next stops."""
        self.script = list(script)

    def take(self) -> list[str]:
        """Returns the stops, and forgets them."""
        stops, self.stops = self.stops, []
        return stops
