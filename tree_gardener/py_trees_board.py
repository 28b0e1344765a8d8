"""The entries that py_trees keeps beside the tree's blackboard: its keys, and behaviours inside of a node.

Observers receive both as entries that nobody can write: a key ``/parameters/speed`` as ``speed`` in the scope
``py_trees:/parameters/``, and the status of a behaviour that a node made itself in the scope
``py_trees:<path of the node>``. py_trees' blackboard belongs to the process, not to a tree.
"""

from collections.abc import Iterator, Sequence
from typing import Any, Final

from py_trees.blackboard import Blackboard

from tree_gardener.controls.adapted import inner_behaviours
from tree_gardener.controls.custom import CustomControl
from tree_gardener.node import Node
from tree_gardener.values import type_name_of

PREFIX: Final = "py_trees:"
STATUS: Final = "Status"
Place = tuple[str, str]
Value = tuple[str, Any]
"""The name of a value's type, and the value."""


def place_of(key: str) -> Place:
    """Returns scope and name of a key of py_trees' blackboard."""
    namespace, separator, name = key.rpartition(Blackboard.separator)
    return f"{PREFIX}{namespace}{separator}", name


def write(scope: str, name: str, value: Any) -> bool:
    """Writes a recorded value to py_trees' blackboard; returns False for entries that are none of it."""
    if not scope.startswith(f"{PREFIX}{Blackboard.separator}"):
        return False
    Blackboard.set(scope.removeprefix(PREFIX) + name, value)
    return True


class PyTreesBoard:
    """Finds the entries that changed since the last call.

    A value counts as changed if it is another object; one that was changed in place does not.
    """

    def __init__(self) -> None:
        self._seen: dict[Place, Value] = {}
        self._inner: list[tuple[Place, Any]] = []

    def begin(self, nodes: Sequence[Node]) -> None:
        """Counts all entries as changed, and looks for behaviours inside of these nodes."""
        self._seen = {}
        self._inner = [found for node in nodes if isinstance(node, CustomControl) for found in _inside(node)]

    @property
    def is_used(self) -> bool:
        """Whether there may be anything to show."""
        return bool(Blackboard.storage or self._seen or self._inner)

    def entries(self) -> dict[Place, Value]:
        """Returns all entries that there are now."""
        found = {
            place_of(key): (type_name_of(value), value) for key, value in tuple(Blackboard.storage.items())
        }
        found.update((place, (STATUS, behaviour.status.name)) for place, behaviour in self._inner)
        return found

    def changes(self) -> Iterator[tuple[Place, Value | None]]:
        """Yields the entries that changed, and those that are gone with None."""
        before, now = self._seen, self.entries()
        self._seen = now
        for place, value in now.items():
            if place not in before or before[place][1] is not value[1]:
                yield place, value
        for place in before:
            if place not in now:
                yield place, None


def _inside(node: CustomControl) -> Iterator[tuple[Place, Any]]:
    """Yields place and object of each behaviour that a node made itself; equal names are numbered."""
    taken: set[str] = set()
    for behaviour in inner_behaviours(node.owner):
        above, path = behaviour.parent, str(behaviour.name)
        while above is not None and above is not node.instance_behaviour:
            above, path = above.parent, f"{above.name}/{path}"
        name, number = path, 1
        while name in taken:
            number += 1
            name = f"{path} ({number})"
        taken.add(name)
        yield (f"{PREFIX}{node.path}", name), behaviour
