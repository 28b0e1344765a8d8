"""The node types by tag: the built-in nodes, and the classes that a tree was given."""

import dataclasses
import functools
import inspect
from collections.abc import Mapping
from typing import Any, Final

from py_trees.behaviour import Behaviour

from tree_gardener import catalog
from tree_gardener.control_node import ControlNode, DecoratorNode, LoopNode
from tree_gardener.controls.adapted import adapted
from tree_gardener.controls.custom import CustomControl, CustomDecorator
from tree_gardener.controls.fallback import AsyncFallback, Fallback
from tree_gardener.controls.if_then_else import IfThenElse
from tree_gardener.controls.parallel import Parallel, ParallelAll
from tree_gardener.controls.reactive import ReactiveFallback, ReactiveSequence
from tree_gardener.controls.sequence import AsyncSequence, Sequence, SequenceWithMemory
from tree_gardener.controls.switch import SWITCHES
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
from tree_gardener.errors import DOCUMENT, Diagnostic, LoadError, place_of
from tree_gardener.leaves.behaviour import LEAF_KINDS
from tree_gardener.leaves.constant import AlwaysFailure, AlwaysSuccess
from tree_gardener.leaves.entries import SetBlackboard, UnsetBlackboard, WasEntryUpdated
from tree_gardener.leaves.scripts import Script, ScriptCondition
from tree_gardener.leaves.sleep import Sleep
from tree_gardener.leaves.test_node import TestNode
from tree_gardener.node import Control, Decorator, Kind, Leaf, Node
from tree_gardener.ports import INOUT, INPUT, NO_DEFAULT, OUTPUT, Manifest, PortSpec, manifest_of
from tree_gardener.rebind import has_ports
from tree_gardener.ros_nodes import NODES as ROS_NODES
from tree_gardener.values import STATUS, ValueType, queue_type, value_type

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
    **SWITCHES,
    **{f"Loop{kind}": Loop for kind in ("Int", "Double", "String", "Bool")},
}

_SHIPPED: Final = "tree_gardener.nav2."
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
"""Node names of version 3 and of other engines, each with the current name."""


@dataclasses.dataclass(frozen=True, eq=False)
class NodeType:
    """A node type: the meaning of a tag.

    Attributes:
        name: the tag.
        node_class: the engine's class.
        manifest: its ports; None if it accepts any port.
        min_children: the smallest number of children.
        max_children: the largest number; None for any.
        behaviour_class: the class of an action, or of a control node of the user; None for others.
        takes_ports: whether that class takes the ports in its constructor.
    """

    name: str
    node_class: type[Node]
    manifest: Manifest | None
    min_children: int
    max_children: int | None
    behaviour_class: type[Any] | None = None
    takes_ports: bool = False

    @functools.cached_property
    def has_required(self) -> bool:
        """Whether a tree must give a port a value."""
        return any(spec.required and spec.default is NO_DEFAULT for spec in (self.manifest or {}).values())

    @functools.cached_property
    def has_py_trees_ports(self) -> bool:
        """Whether the access to its ports is to be redirected."""
        return self.behaviour_class is not None and has_ports(self.behaviour_class)

    @property
    def is_own(self) -> bool:
        """Whether the type is a control node or decorator of the user."""
        return issubclass(self.node_class, CustomControl)

    @property
    def kind(self) -> Kind:
        """The kind of the nodes of this type."""
        return self.node_class.KIND


@functools.cache
def built_in_types() -> dict[str, NodeType]:
    """Returns the built-in node types by tag."""
    return {entry.type: _built_in(entry) for entry in catalog.load().values()}


def _built_in(entry: catalog.CatalogNode) -> NodeType:
    behaviour = ROS_NODES.get(entry.type)
    if behaviour is None:
        node_class = BUILT_IN[entry.type]
        return NodeType(entry.type, node_class, entry.manifest, entry.min_children, entry.max_children)
    kind = LEAF_KINDS[getattr(behaviour, "NODE_KIND", "Action")]
    return NodeType(entry.type, kind, None if entry.open else entry.manifest, 0, 0, behaviour)


def build_registry(
    nodes: Mapping[str, Any], types: Mapping[str, ValueType] | None = None
) -> dict[str, NodeType]:
    """Returns the built-in nodes and those given by the user, whose ports may have the named `types`.

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
            registry[name] = _user_type(name, cls, types) if types else _type_alone(name, cls)
        except (TypeError, ValueError) as error:
            file, line = place_of(cls) if isinstance(cls, type) else ("", 0)
            message = f"'{name}' cannot be a node: {error}"
            problems.append(Diagnostic("TG602", message, file=file or DOCUMENT, line=line, node=name))
    if problems:
        raise LoadError(problems)
    return registry


def _type_alone(name: str, cls: Any) -> NodeType:
    """Returns the type of a class whose ports name no types; nodes of Nav2 are read once a process."""
    is_shipped = isinstance(cls, type) and cls.__module__.startswith(_SHIPPED)
    return _shipped_type(name, cls) if is_shipped else _user_type(name, cls, {})


@functools.cache
def _shipped_type(name: str, cls: type) -> NodeType:
    return _user_type(name, cls, {})


def _user_type(name: str, cls: Any, types: Mapping[str, ValueType]) -> NodeType:
    if not isinstance(cls, type):
        raise TypeError(f"{cls!r} is not a class")
    if issubclass(cls, Node):
        return _engine_type(name, cls, types)
    if issubclass(cls, LoopNode):
        return NodeType(name, Loop, _loop_manifest(cls), 1, 1)
    own = cls if issubclass(cls, ControlNode) else adapted(cls)
    if own is not None:
        return _own_type(name, cls, own, types)
    if not issubclass(cls, Behaviour):
        raise TypeError(
            f"{cls.__name__} is not derived from py_trees.behaviour.Behaviour, "
            "tree_gardener.ControlNode or tree_gardener.DecoratorNode"
        )
    kind = getattr(cls, "NODE_KIND", "Action")
    if kind not in LEAF_KINDS:
        raise ValueError(f"its NODE_KIND is {kind!r}, which is not one of {', '.join(LEAF_KINDS)}")
    parameters = inspect.signature(cls.__init__).parameters
    return NodeType(name, LEAF_KINDS[kind], manifest_of(cls, types), 0, 0, cls, "ports" in parameters)


def _own_type(name: str, cls: type, own: type[ControlNode], types: Mapping[str, ValueType]) -> NodeType:
    """Returns the type of a user's control node or decorator; `own` is `cls`, or the class that adapts it."""
    is_decorator = issubclass(own, DecoratorNode)
    least, most = own.MIN_CHILDREN, own.MAX_CHILDREN
    kind = getattr(cls, "NODE_KIND", own.NODE_KIND)
    if kind != ("Decorator" if is_decorator else "Control"):
        base = "a decorator" if is_decorator else "a control node"
        raise ValueError(
            f"its NODE_KIND is {kind!r}, but its base class makes it {base}: leave NODE_KIND out"
        )
    if is_decorator and (least, most) != (1, 1):
        raise ValueError("a decorator has exactly one child: leave out MIN_CHILDREN and MAX_CHILDREN")
    if own is cls and (type(least) is not int or least < 1):
        raise ValueError(f"its MIN_CHILDREN is {least!r} and must be 1 or more")
    if most is not None and (type(most) is not int or most < least):
        raise ValueError(f"its MAX_CHILDREN is {most!r} and must be None, or {least} or more")
    takes_ports = "ports" in inspect.signature(own.__init__).parameters
    node_class = CustomDecorator if is_decorator else CustomControl
    return NodeType(name, node_class, manifest_of(cls, types), least, most, own, takes_ports)


def _loop_manifest(cls: type[LoopNode]) -> Manifest:
    """Returns the ports of a loop; its queue takes any entry, as BehaviorTree.CPP's."""
    return {
        "queue": PortSpec("queue", INOUT, queue_type(cls.ELEMENT)),
        "value": PortSpec("value", OUTPUT, value_type(cls.ELEMENT)),
        "if_empty": PortSpec("if_empty", INPUT, STATUS, "SUCCESS"),
    }


def _engine_type(name: str, cls: type[Node], types: Mapping[str, ValueType]) -> NodeType:
    """Returns the type of a node that is written against the engine itself, such as a custom control node."""
    manifest = manifest_of(cls, types) or {}
    if issubclass(cls, Decorator):
        return NodeType(name, cls, manifest, 1, 1)
    if issubclass(cls, Control):
        return NodeType(name, cls, manifest, 1, None)
    if issubclass(cls, Leaf):
        return NodeType(name, cls, manifest, 0, 0)
    raise TypeError("derive it from Control, Decorator or Leaf of tree_gardener.node")
