"""The leaves of which the conformance cases consist. Each callback records an event."""

import functools
from typing import Any, ClassVar

from py_trees.behaviour import Behaviour
from py_trees.common import Status as PyTreesStatus

from tree_gardener.errors import PortError
from tree_gardener.ports import Port, get_input, node_of, pointer_key, set_output
from tree_gardener.status import Status
from tree_gardener.values import format_number

RESULTS: dict[str, Any] = {
    "S": PyTreesStatus.SUCCESS,
    "F": PyTreesStatus.FAILURE,
    "R": PyTreesStatus.RUNNING,
    "K": Status.SKIPPED,
    "I": Status.IDLE,
}


class Trace:
    """The events of one case."""

    def __init__(self) -> None:
        self.events: list[str] = []

    def take(self) -> list[str]:
        """Returns the events since the last call, and removes them."""
        events, self.events = self.events, []
        return events


class Traced(Behaviour):
    """A leaf that writes to a trace."""

    trace: ClassVar[Trace]

    def event(self, text: str) -> None:
        self.trace.events.append(text)

    @property
    def path(self) -> str:
        return node_of(self).path


class _Scripted(Traced):
    """Returns the statuses of its script's letters one after the other; the last one repeats."""

    INPUT_PORTS: ClassVar = {"script": Port(str, default="S")}

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.cursor = 0
        self.word = ""

    def next_result(self) -> Any:
        """Returns the status of the next letter of the script."""
        try:
            script = get_input(self, "script")
        except PortError:  # it replaces a node that has no such port
            script = "S"
        letter = script[min(self.cursor, len(script) - 1)]
        self.cursor += 1
        return RESULTS[letter]


class Leaf(_Scripted):
    """A StatefulAction."""

    def initialise(self) -> None:
        """Marks the next event as a start."""
        self.word = "start"

    def update(self) -> Any:
        self.event(f"{self.word or 'tick'}:{self.path}")
        self.word = ""
        return self.next_result()

    def terminate(self, new_status: PyTreesStatus) -> None:
        """Records a halt."""
        if new_status is PyTreesStatus.INVALID:
            self.event(f"halt:{self.path}")


class SyncLeaf(_Scripted):
    """A SyncAction."""

    NODE_KIND = "SyncAction"

    def update(self) -> Any:
        self.event(f"tick:{self.path}")
        return self.next_result()


class Cond(SyncLeaf):
    """A Condition."""

    NODE_KIND = "Condition"


def _text(value: Any) -> str:
    if isinstance(value, str):
        return value
    return format_number(int(value) if isinstance(value, bool) else value)


class _Get(Traced):
    NODE_KIND = "SyncAction"

    def update(self) -> PyTreesStatus:
        try:
            value = get_input(self, "value")
        except PortError:
            self.event(f"get:{self.path}!error")
            return PyTreesStatus.FAILURE
        self.event(f"get:{self.path}={_text(value)}")
        return PyTreesStatus.SUCCESS


class _Set(Traced):
    NODE_KIND = "SyncAction"

    def update(self) -> PyTreesStatus:
        try:
            value = get_input(self, "value")
        except PortError:
            self.event(f"set:{self.path}!input")
            return PyTreesStatus.FAILURE
        spec = node_of(self)
        if "to" not in spec.ports:
            self.event(f"set:{self.path}!output")
            return PyTreesStatus.FAILURE
        set_output(self, "to", value)
        self.event(f"set:{self.path}")
        return PyTreesStatus.SUCCESS


class Inc(Traced):
    """Counts up."""

    NODE_KIND = "SyncAction"
    INOUT_PORTS: ClassVar = {"counter": Port(int)}

    def update(self) -> PyTreesStatus:
        try:
            count = get_input(self, "counter")
        except PortError:
            count = 0
        if pointer_key(node_of(self).ports.get("counter", ""), "counter") is not None:
            set_output(self, "counter", count + 1)
        self.event(f"inc:{self.path}={count + 1}")
        return PyTreesStatus.SUCCESS


_TYPES = {"Int": int, "Str": str, "Double": float, "Bool": bool}


def leaves(trace: Trace, text: str | None = None) -> dict[str, type[Traced]]:
    """Returns the leaf classes of the cases, or those that a text names; the leaves write to this trace."""
    found = _classes().items()
    return {name: type(name, (cls,), {"trace": trace}) for name, cls in found if text is None or name in text}


@functools.cache
def _classes() -> dict[str, type[Traced]]:
    classes: dict[str, type[Traced]] = {cls.__name__: cls for cls in (Leaf, SyncLeaf, Cond, Inc)}
    for word, kind in _TYPES.items():
        classes[f"Get{word}"] = type(f"Get{word}", (_Get,), {"INPUT_PORTS": {"value": Port(kind)}})
        ports = {"INPUT_PORTS": {"value": Port(kind)}, "OUTPUT_PORTS": {"to": Port(kind)}}
        classes[f"Set{word}"] = type(f"Set{word}", (_Set,), ports)
    for word, default in (("Def", 7), ("BB", "{dflt}"), ("Same", "{=}")):
        port = Port(int, default=default)
        classes[f"GetInt{word}"] = type(f"GetInt{word}", (_Get,), {"INPUT_PORTS": {"value": port}})
    return classes
