"""The node types by tag: the built-in nodes, and the classes that a tree was given."""

import dataclasses
import functools
import inspect
from collections.abc import Mapping
from typing import Any, Final

from py_trees.behaviour import Behaviour
from py_trees.composites import Composite
from py_trees.decorators import Decorator as PyTreesDecorator

from tree_gardener import catalog
from tree_gardener.controls.fallback import AsyncFallback, Fallback
from tree_gardener.controls.if_then_else import IfThenElse
from tree_gardener.controls.parallel import Parallel, ParallelAll
from tree_gardener.controls.reactive import ReactiveFallback, ReactiveSequence
from tree_gardener.controls.sequence import AsyncSequence, Sequence, SequenceWithMemory
from tree_gardener.controls.switch import Switch
from tree_gardener.controls.try_catch import TryCatch
from tree_gardener.controls.while_do_else import WhileDoElse
from tree_gardener.decorators.loop import Loop
from tree_gardener.decorators.precondition import Precondition
from tree_gardener.decorators.repeat import Repeat, RetryUntilSuccessful
from tree_gardener.decorators.result import ForceFailure, ForceSuccess, Inverter, KeepRunningUntilFailure
from tree_gardener.decorators.run_once import RunOnce
from tree_gardener.decorators.subtree import SubTree
from tree_gardener.decorators.timing import Delay, Timeout
from tree_gardener.decorators.update import SkipUnlessUpdated, WaitValueUpdate
from tree_gardener.errors import Diagnostic, LoadError
from tree_gardener.leaves.behaviour import LEAF_KINDS
from tree_gardener.leaves.constant import AlwaysFailure, AlwaysSuccess
from tree_gardener.leaves.entries import SetBlackboard, UnsetBlackboard, WasEntryUpdated
from tree_gardener.leaves.scripts import Script, ScriptCondition
from tree_gardener.leaves.sleep import Sleep
from tree_gardener.leaves.test_node import TestNode
from tree_gardener.node import Control, Decorator, Kind, Leaf, Node
from tree_gardener.ports import Manifest, manifest_of

BUILT_IN: Final[Mapping[str, type[Node]]] = {
    **{
        cls.__name__: cls
        for cls in (
            *(Sequence, AsyncSequence, SequenceWithMemory, ReactiveSequence),
            *(Fallback, AsyncFallback, ReactiveFallback, Parallel, ParallelAll, IfThenElse, WhileDoElse),
            *(TryCatch, Inverter, ForceSuccess, ForceFailure, Repeat, RetryUntilSuccessful),
            *(KeepRunningUntilFailure, RunOnce, Precondition, SkipUnlessUpdated, WaitValueUpdate),
            *(Delay, Timeout, AlwaysSuccess, AlwaysFailure, Script, ScriptCondition, SetBlackboard),
            *(UnsetBlackboard, WasEntryUpdated, Sleep, TestNode, SubTree),
        )
    },
    **{f"Switch{cases}": Switch for cases in range(2, 7)},
    **{f"Loop{kind}": Loop for kind in ("Int", "Double", "String", "Bool")},
}

OLD_NAMES: Final = {
    "SequenceStar": "SequenceWithMemory",
    "FallbackStar": "Fallback",
    "SubTreePlus": "SubTree",
    "BlackboardCheckInt": "Precondition",
    "BlackboardCheckDouble": "Precondition",
    "BlackboardCheckString": "Precondition",
    "BlackboardCheckBool": "Precondition",
    "SequentialStar": "SequenceWithMemory",
    "ReactiveSelector": "ReactiveFallback",
    "Selector": "Fallback",
}
"""Names of version 3 and of other engines, with those of today."""


@dataclasses.dataclass(frozen=True, eq=False)
class NodeType:
    """A node type: the meaning of a tag.

    Attributes:
        name: the tag.
        node_class: the engine's class.
        manifest: its ports; None if it accepts any.
        min_children: the least number of children.
        max_children: the largest number; None for any.
        behaviour_class: the py_trees class of an action, or None.
        takes_ports: whether that class takes the ports in its constructor.
    """

    name: str
    node_class: type[Node]
    manifest: Manifest | None
    min_children: int
    max_children: int | None
    behaviour_class: type[Any] | None = None
    takes_ports: bool = False

    @property
    def kind(self) -> Kind:
        """Its kind."""
        return self.node_class.KIND


@functools.cache
def built_in_types() -> dict[str, NodeType]:
    """Returns the built-in node types by tag."""
    return {
        entry.type: NodeType(
            entry.type, BUILT_IN[entry.type], entry.manifest, entry.min_children, entry.max_children
        )
        for entry in catalog.load().values()
    }


def build_registry(nodes: Mapping[str, Any]) -> dict[str, NodeType]:
    """Returns the built-in nodes and those given by the user.

    Raises:
        LoadError: something given is not a class of nodes, or has the name of a built-in one.
    """
    registry = dict(built_in_types())
    problems = []
    for name, cls in nodes.items():
        if name in registry:
            hint = "give the action another name"
            problems.append(Diagnostic("TG601", f"'{name}' is the name of a built-in node", hint, node=name))
            continue
        try:
            registry[name] = _user_type(name, cls)
        except (TypeError, ValueError) as error:
            problems.append(Diagnostic("TG602", f"'{name}' cannot be a node: {error}", node=name))
    if problems:
        raise LoadError(problems)
    return registry


def _user_type(name: str, cls: Any) -> NodeType:
    if not isinstance(cls, type):
        raise TypeError(f"{cls!r} is not a class")
    if issubclass(cls, Node):
        return _engine_type(name, cls)
    if not issubclass(cls, Behaviour):
        raise TypeError(f"{cls.__name__} is not derived from py_trees.behaviour.Behaviour")
    if issubclass(cls, (Composite, PyTreesDecorator)):
        raise TypeError(
            f"{cls.__name__} is a py_trees composite or decorator, whose ticks are generators; "
            "derive it from tree_gardener.node.Control or Decorator"
        )
    kind = getattr(cls, "NODE_KIND", "Action")
    if kind not in LEAF_KINDS:
        raise ValueError(f"its NODE_KIND is {kind!r}, which is not one of {', '.join(LEAF_KINDS)}")
    parameters = inspect.signature(cls.__init__).parameters
    return NodeType(name, LEAF_KINDS[kind], manifest_of(cls), 0, 0, cls, "ports" in parameters)


def _engine_type(name: str, cls: type[Node]) -> NodeType:
    """Returns the type of a node that is written against the engine itself, such as a custom control node."""
    manifest = manifest_of(cls) or {}
    if issubclass(cls, Decorator):
        return NodeType(name, cls, manifest, 1, 1)
    if issubclass(cls, Control):
        return NodeType(name, cls, manifest, 1, None)
    if issubclass(cls, Leaf):
        return NodeType(name, cls, manifest, 0, 0)
    raise TypeError("derive it from Control, Decorator or Leaf of tree_gardener.node")
