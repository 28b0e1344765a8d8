"""Composites and decorators of py_trees as control nodes.

A class may hold its children itself: a composite that adds some in ``__init__``, or a decorator whose
``__init__`` takes no ``child``. Then the tree need not give it any.

A composite of py_trees ticks its children through generators. Here the composite gets stand-ins as children,
each of which ticks a child of the engine. py_trees has no SKIPPED: a skipped child has the status INVALID. A
composite whose own result is INVALID is SKIPPED if a child was skipped in the tick; otherwise it fails, as an
action does.
"""

import inspect
from collections.abc import Collection, Iterator
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

    @property
    def inner(self) -> list[Behaviour]:
        """The behaviours that the user's object made itself, children first as py_trees sets them up."""
        return [
            each for each in self.adapted.iterate() if each is not self.adapted and type(each) is not _Child
        ]

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
            for each in (self.adapted, *self.inner):
                each.tree_gardener_node = value
                rebind(each)

    def adopt(self) -> None:
        """Gives the composite its children, at its first use."""
        children = self.tree_gardener_node.children
        self.stand_ins = [_Child(child.name, self, index) for index, child in enumerate(children)]
        self.adapted.add_children(self.stand_ins)

    def update(self) -> Status:
        """Ticks the user's object once."""
        if not self.stand_ins and self.tree_gardener_node.children:
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


class _ClosedAdapter(_Adapter):
    """Ticks a decorator of py_trees that makes its child itself."""

    MIN_CHILDREN = MAX_CHILDREN = 0


class _OpenAdapter(_Adapter):
    """Ticks a composite of py_trees that may make its children itself."""

    MIN_CHILDREN = 0


def _constructor(cls: type) -> Any:
    return cls.__init__  # type: ignore[misc]


def inner_behaviours(owner: Any) -> list[Behaviour]:
    """Returns the behaviours that a composite or decorator of py_trees made itself, children first."""
    return owner.inner if isinstance(owner, _Adapter) else []


def holds_nothing(behaviour: Any, children: Collection[Any]) -> bool:
    """Returns whether a composite of py_trees has no child, neither in the tree nor of its own."""
    return isinstance(behaviour, _OpenAdapter) and not children and not behaviour.inner


def adapted(cls: type) -> type[ControlNode] | None:
    """Returns the control node that ticks a py_trees class; None if it is not a composite or decorator."""
    if issubclass(cls, Composite):
        is_shipped = _constructor(cls).__module__ == Composite.__module__
        base: type[_Adapter] = _Adapter if is_shipped else _OpenAdapter
    elif issubclass(cls, Decorator):
        takes = inspect.signature(_constructor(cls)).parameters
        is_open = "child" in takes or any(each.kind is each.VAR_KEYWORD for each in takes.values())
        base = _DecoratorAdapter if is_open else _ClosedAdapter
    else:
        return None
    return cast("type[ControlNode]", type(cls.__name__, (base,), {"CLASS": cls}))
