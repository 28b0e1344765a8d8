"""Doubles, which replace the Python of a leaf in a test.

The engine's node stays the one that ticks the leaf in a program; only the behaviour below it is another. So
conditions, ports, starts and halts are those of the real leaf.
"""

import bisect
import dataclasses
import fnmatch
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, ClassVar, Final

from py_trees.behaviour import Behaviour

from tree_gardener.control_node import ControlNode, DecoratorNode
from tree_gardener.controls.custom import CustomControl
from tree_gardener.leaves.behaviour import BehaviourLeaf, ConditionLeaf, StatefulLeaf
from tree_gardener.node import Node
from tree_gardener.ports import NO_DEFAULT, Port, write_port
from tree_gardener.status import RUNNING, Status
from tree_gardener.testing.cases import Double, Step

_ATTRIBUTES: Final = {"input": "INPUT_PORTS", "output": "OUTPUT_PORTS", "inout": "INOUT_PORTS"}
_OWN = {"control": ControlNode, "decorator": DecoratorNode}


@dataclasses.dataclass(frozen=True)
class LeafModel:
    """A leaf or control node of the project as its source declares it.

    Attributes:
        kind: ``Action``, ``SyncAction``, ``Condition``, ``control`` or ``decorator``.
        ports: by direction and name, each with type and default (None for none).
        open: whether it takes any port.
        returns: the results that its `update` can return; empty if not known.
        children: the smallest and the largest number of children.
    """

    kind: str = "Action"
    ports: tuple[tuple[str, str, str, str | None], ...] = ()
    open: bool = True
    returns: frozenset[str] = frozenset()
    children: tuple[int, int | None] = (0, 0)

    def to_json(self) -> dict[str, Any]:
        """Returns the fields as a JSON object."""
        document = dataclasses.asdict(self)
        return {**document, "returns": sorted(self.returns)}


def leaf_models(document: Mapping[str, Any]) -> dict[str, LeafModel]:
    """Reads models from the form that `LeafModel.to_json` writes, by type."""
    return {
        name: LeafModel(
            kind=item["kind"],
            ports=tuple((d, n, t, default) for d, n, t, default in item["ports"]),
            open=item["open"],
            returns=frozenset(item["returns"]),
            children=(item["children"][0], item["children"][1]),
        )
        for name, item in document.items()
    }


class MissingError(Exception):
    """A leaf was ticked that nobody doubled."""


class Stub(Behaviour):  # type: ignore[misc, unused-ignore]
    """Replaces a leaf until a double is bound; its `update` raises an error."""

    TYPE: ClassVar[str] = ""

    def update(self) -> Any:
        """Refuses the tick."""
        raise MissingError(
            f"the leaf is ticked and has no double: write one for {self.TYPE}, or `{self.TYPE}: real`"
        )


def stub_class(name: str, model: LeafModel) -> type[Any]:
    """Returns a class with the ports of a leaf or control node, and none of its Python."""
    ports: dict[str, Any] = {}
    if not model.open:
        for direction, attribute in _ATTRIBUTES.items():
            ports[attribute] = {
                port: Port(kind, default=NO_DEFAULT if default is None else default)
                for way, port, kind, default in model.ports
                if way == direction
            }
    own = _OWN.get(model.kind)
    if own is None:
        return type(name, (Stub,), {**ports, "NODE_KIND": model.kind, "TYPE": name})
    if model.kind == "control":
        ports |= {"MIN_CHILDREN": max(1, model.children[0]), "MAX_CHILDREN": model.children[1]}
    return type(name, (own,), {**ports, "update": _refuse_control(name)})


def _refuse_control(name: str) -> Callable[[Any], Any]:
    def update(self: Any) -> Any:
        raise MissingError(f"{name} is Python of the project, which tests leave out: write `{name}: real`")

    return update


class DoubleBehaviour:
    """Plays the steps of a double."""

    def __init__(self, node: BehaviourLeaf, double: Double) -> None:
        self.name = node.name
        self.node = node
        self.double = double
        self.status: Any = None
        self.tree_gardener_node = node
        self.halts = 0
        self._steps = [step for step in double.steps if step.times > 0]
        self._ticks = [step.at for step in self._steps if step.at is not None]
        self._tick = 0
        self._index = 0
        self._left = self._steps[0].times
        self._start_s = 0.0

    def initialise(self) -> None:
        """Notes when the leaf starts."""
        self._start_s = self.node.tree.clock.now()

    def update(self) -> Status:
        """Returns the result of this tick, and writes its outputs."""
        step = self._step()
        for port, value in step.outputs.items():
            write_port(self.node, port, value)
        return step.status

    def terminate(self, new_status: Any) -> None:
        """Counts halts; results need nothing."""
        if new_status.name == "INVALID":
            self.halts += 1

    def setup(self, **_: Any) -> None:
        """Does nothing: a double needs no preparation."""

    def shutdown(self) -> None:
        """Does nothing."""

    def _step(self) -> Step:
        if self.double.for_s is not None:
            is_over = self.node.tree.clock.now() - self._start_s >= self.double.for_s - 1e-9
            return self._steps[1 if is_over else 0]
        if self._ticks:
            return self._step_of_tick()
        if self._left == 0 and self._index + 1 < len(self._steps):
            self._index += 1
            self._left = self._steps[self._index].times
        self._left = max(0, self._left - 1)
        return self._steps[self._index]

    def _step_of_tick(self) -> Step:
        """Returns the result of this tick of the tree; of several at it, those that were not played yet."""
        tick, last = self.node.tree.tick_number, self._tick
        self._tick = tick
        end = max(1, bisect.bisect_right(self._ticks, tick))
        if tick == last:
            self._index = min(self._index + 1, end - 1)
        elif self._ticks[end - 1] == tick:
            self._index = bisect.bisect_left(self._ticks, tick)
        else:
            self._index = end - 1
        return self._steps[self._index]


def matching(doubles: Sequence[Double], node: Node) -> Double | None:
    """Returns the double of a node: found by exact path, then name, then type, then patterns in order."""
    path = node.path
    for key in (path, node.name, node.type):
        for double in doubles:
            if double.pattern == key:
                return double
    for double in doubles:
        if any(fnmatch.fnmatchcase(key, double.pattern) for key in (path, node.name, node.type)):
            return double
    return None


def can_double(node: Node) -> bool:
    """Returns whether a node runs Python that a test replaces."""
    return isinstance(node, BehaviourLeaf)


def has_python(node: Node) -> bool:
    """Returns whether a node runs Python of the project or of ROS."""
    return isinstance(node, (BehaviourLeaf, CustomControl))


def refused_result(node: BehaviourLeaf, double: Double) -> Status | None:
    """Returns a result of a double that a leaf of this kind cannot return, or None."""
    if isinstance(node, StatefulLeaf):
        return None
    return next((step.status for step in double.steps if step.status is RUNNING), None)


def kind_of(node: Node) -> str:
    """Returns the kind of a leaf for messages."""
    if isinstance(node, ConditionLeaf):
        return "a condition"
    return "an action" if isinstance(node, StatefulLeaf) else "a synchronous action"


def candidates(nodes: Iterable[Node], key: str) -> list[Node]:
    """Returns the nodes that a name in an expectation means: by path, then name, then type, then id."""
    held = list(nodes)
    for attribute in ("path", "name", "type", "node_id"):
        found = [node for node in held if getattr(node, attribute) == key]
        if found:
            return found
    return []
