"""Composites and decorators of py_trees as control nodes.

A composite of py_trees ticks its children through generators. Here the composite gets stand-ins as children,
each of which ticks a child of the engine. py_trees has no SKIPPED: a skipped child has the status INVALID. A
composite whose own result is INVALID is SKIPPED if a child was skipped in the tick; otherwise it fails, as an
action does.
"""

from collections.abc import Iterator
from typing import Any, ClassVar, cast

from py_trees.behaviour import Behaviour
from py_trees.common import Status as PyTreesStatus
from py_trees.composites import Composite
from py_trees.decorators import Decorator

from tree_gardener.control_node import ControlNode, DecoratorNode
from tree_gardener.rebind import rebind
from tree_gardener.status import FAILURE, SKIPPED, Status, to_py_trees

INVALID = PyTreesStatus.INVALID


class _Child(Behaviour):
    """A py_trees behaviour that represents a child of the node."""

    def __init__(self, name: str, owner: "_Adapter", index: int) -> None:
        super().__init__(name)
        self.owner = owner
        self.index = index

    def update(self) -> PyTreesStatus:
        """Returns the result of the child, which `tick` has ticked."""
        return self.status

    def tick(self) -> Iterator[Any]:
        """Ticks the child once; a child that has a result starts again, as in py_trees."""
        if self.owner.child_status(self.index).is_completed:
            self.owner.halt_child(self.index)
        result = self.owner.tick_child(self.index)
        self.owner.has_skipped |= result is SKIPPED
        self.status = to_py_trees(result)
        yield self

    def stop(self, new_status: PyTreesStatus = INVALID) -> None:
        """Halts the child if it is running, and removes its stored result."""
        if new_status is INVALID:
            self.owner.halt_child(self.index)
        self.status = new_status


class _Adapter(ControlNode):
    """Ticks a composite or a decorator of py_trees.

    Attributes:
        adapted: the user's object.
        has_skipped: whether a child was skipped in this tick.
    """

    CLASS: ClassVar[Any]

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.has_skipped = False
        self.stand_ins: list[_Child] = []
        self.adapted: Any = self.make(name)

    def make(self, name: str) -> Any:
        """Makes the user's object."""
        return self.CLASS(name)

    def __setattr__(self, name: str, value: Any) -> None:
        super().__setattr__(name, value)
        if name == "tree_gardener_node":
            self.adapted.tree_gardener_node = value
            rebind(self.adapted)

    def adopt(self) -> None:
        """Gives the composite its children, at its first use."""
        children = self.tree_gardener_node.children
        self.stand_ins = [_Child(child.name, self, index) for index, child in enumerate(children)]
        self.adapted.add_children(self.stand_ins)

    def update(self) -> Status:
        """Ticks the user's object once."""
        if not self.stand_ins:
            self.adopt()
        self.has_skipped = False
        for _ in self.adapted.tick():
            pass
        result = self.adapted.status
        if result is not INVALID:
            return Status[result.name]
        if self.has_skipped:
            return SKIPPED
        node = self.tree_gardener_node
        node.tree.warn(node, f"{node.type} ended with Status.INVALID, which counts as FAILURE")
        return FAILURE

    def halt(self) -> None:
        """Stops the user's object, which stops its children."""
        try:
            self.adapted.stop(INVALID)
        finally:
            for stale in (*self.stand_ins, self.adapted):
                stale.status = INVALID


class _DecoratorAdapter(_Adapter, DecoratorNode):
    """Ticks a decorator of py_trees."""

    def make(self, name: str) -> Any:
        """Makes the user's object with the stand-in of its child."""
        self.stand_ins = [_Child(name, self, 0)]
        return self.CLASS(name, child=self.stand_ins[0])


def adapted(cls: type) -> type[ControlNode] | None:
    """Returns the control node that ticks a py_trees class; None if it is not a composite or decorator."""
    base = (
        _Adapter if issubclass(cls, Composite) else _DecoratorAdapter if issubclass(cls, Decorator) else None
    )
    return None if base is None else cast("type[ControlNode]", type(cls.__name__, (base,), {"CLASS": cls}))
