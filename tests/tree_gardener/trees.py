"""Leaves and helpers that the tests of the engine share."""

from __future__ import annotations

from typing import Any

import py_trees
from py_trees.common import Status as PyTreesStatus

from tree_gardener import Tree


class Succeeding(py_trees.behaviour.Behaviour):
    def update(self) -> PyTreesStatus:
        return PyTreesStatus.SUCCESS


class Failing(py_trees.behaviour.Behaviour):
    def update(self) -> PyTreesStatus:
        return PyTreesStatus.FAILURE


class Running(py_trees.behaviour.Behaviour):
    def update(self) -> PyTreesStatus:
        return PyTreesStatus.RUNNING


class Raising(py_trees.behaviour.Behaviour):
    def update(self) -> PyTreesStatus:
        raise ValueError("out of order")


class Recording(py_trees.behaviour.Behaviour):
    """Returns the statuses in `results` one after the other, and notes every call in `calls`."""

    results: Any = (PyTreesStatus.SUCCESS,)

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.calls: list[str] = []

    def setup(self, **kwargs: Any) -> None:
        self.calls.append(f"setup {kwargs['node']}")

    def initialise(self) -> None:
        self.calls.append("initialise")

    def update(self) -> Any:
        ticks = self.calls.count("update")
        self.calls.append("update")
        return self.results[min(ticks, len(self.results) - 1)]

    def terminate(self, new_status: PyTreesStatus) -> None:
        self.calls.append(f"terminate {new_status.name} from {self.status.name}")

    def shutdown(self) -> None:
        self.calls.append("shutdown")


def recording(*results: Any, kind: str = "Action") -> type[Recording]:
    """A class of Recording with these results."""
    return type("Recorder", (Recording,), {"results": results, "NODE_KIND": kind})


LEAVES: dict[str, Any] = {cls.__name__: cls for cls in (Succeeding, Failing, Running, Raising)}


def document(body: str, *more: str) -> str:
    """A document with one main tree, and other elements."""
    return (
        f'<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main">{body}</BehaviorTree>'
        f"{''.join(more)}</root>"
    )


def subtree(tree_id: str, body: str) -> str:
    """A BehaviorTree."""
    return f'<BehaviorTree ID="{tree_id}">{body}</BehaviorTree>'


def load(body: str, *more: str, nodes: dict[str, Any] | None = None, **options: Any) -> Tree:
    """A tree with the leaves of this module and others."""
    return Tree.from_xml(document(body, *more), {**LEAVES, **(nodes or {})}, **options)


def leaf(tree: Tree, path: str) -> Any:
    """The behaviour of the action with this path."""
    return next(node.behaviour for node in tree.nodes if node.path == path)


def letters(tree: Tree, ticks: int) -> str:
    """The results of the next ticks, a letter each; K is SKIPPED."""
    return "".join(tree.tick_exactly_once().letter for _ in range(ticks))
