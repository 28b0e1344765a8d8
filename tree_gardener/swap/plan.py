"""Decides what stays when a tree is replaced: a comparison of two states, without any effect.

A node stays if the new tree has a node with its key and type. Its status and memory are kept; so is the
user's object, if its class is the same. What runs is halted where it cannot continue:

* a node that left, whose type or class changed, or that has another parent;
* a node with a child that is RUNNING, or at which it continues, and that left, moved or changed its type;
* a control node of the user whose children changed, since its code knows them by index;
* everything below such a node.
"""

import dataclasses
import enum
from collections.abc import Iterator, Mapping

from py_trees.composites import Composite
from py_trees.decorators import Decorator as PyTreesDecorator

from tree_gardener.blackboard import EMPTY
from tree_gardener.status import RUNNING
from tree_gardener.swap.memory import current_child
from tree_gardener.swap.state import EntryState, Key, NodeState, TreeState
from tree_gardener.values import ConversionError


class Fate(enum.Enum):
    """The fate of a node of the old tree."""

    KEPT = "kept"
    RENEWED = "renewed"
    """It stays, with a new object of the user's changed class."""
    REMOVED = "removed"


@dataclasses.dataclass(frozen=True)
class Conflict:
    """An entry of the blackboard whose value the new tree cannot take over.

    Attributes:
        scope: the path of the SubTree node; "" for the root.
        key: the name of the entry.
        old: the type of the entry now, and `new` that in the new tree.
    """

    scope: str
    key: str
    old: str
    new: str


@dataclasses.dataclass(frozen=True)
class LatePort:
    """A port whose new text a kept action does not see, since it read the port before its first tick."""

    key: Key
    path: str
    port: str


@dataclasses.dataclass(frozen=True)
class Plan:
    """The effects of a swap.

    Attributes:
        fates: of each node of the old tree.
        added: the nodes that begin, in pre-order of the new tree.
        halted: the nodes that are RUNNING and will be halted, in pre-order of the old tree.
        conflicts: the entries for which the swap is refused.
        late_ports: the ports that kept actions read too early.
    """

    fates: Mapping[Key, Fate]
    added: tuple[Key, ...]
    halted: tuple[Key, ...]
    conflicts: tuple[Conflict, ...]
    late_ports: tuple[LatePort, ...]

    def with_fate(self, fate: Fate) -> tuple[Key, ...]:
        """Returns the nodes of the old tree with this fate."""
        return tuple(key for key, found in self.fates.items() if found is fate)


def plan(old: TreeState, new: TreeState) -> Plan:
    """Compares the state of the running tree with that of a new one, which has not ticked yet."""
    fates = {key: _fate(node, new.nodes.get(key)) for key, node in old.nodes.items()}
    return Plan(
        fates=fates,
        added=tuple(key for key in new.nodes if fates.get(key, Fate.REMOVED) is Fate.REMOVED),
        halted=tuple(_halted(old, new, fates)),
        conflicts=tuple(_conflicts(old, new)),
        late_ports=tuple(_late_ports(old, new, fates)),
    )


def _fate(before: NodeState, after: NodeState | None) -> Fate:
    if after is None or after.kind != before.kind or (before.code is None) != (after.code is None):
        return Fate.REMOVED
    is_same = after.code is before.code and (after.children == before.children or not _is_adapted(before))
    return Fate.KEPT if is_same else Fate.RENEWED


def _is_adapted(node: NodeState) -> bool:
    """Returns whether a node is a composite of py_trees, which holds its children itself."""
    return node.code is not None and issubclass(node.code, (Composite, PyTreesDecorator))


def _halted(old: TreeState, new: TreeState, fates: Mapping[Key, Fate]) -> list[Key]:
    halted: set[Key] = set()
    for key, node in old.nodes.items():  # in pre-order, so that a parent is decided before its children
        if node.status is not RUNNING:
            continue
        if node.parent in halted or fates[key] is not Fate.KEPT or _cannot_continue(key, old, new, fates):
            halted.add(key)
    return [key for key in old.nodes if key in halted]


def _cannot_continue(key: Key, old: TreeState, new: TreeState, fates: Mapping[Key, Fate]) -> bool:
    before, after = old.nodes[key], new.nodes[key]
    if after.parent != before.parent:
        return True
    if before.code is not None and after.children != before.children:
        return True
    current = current_child(before)
    running = [child for child in before.children if old.nodes[child].status is RUNNING]
    return any(
        fates[child] is Fate.REMOVED or new.nodes[child].parent != key
        for child in (*running, *(() if current is None else (current,)))
    )


def _conflicts(old: TreeState, new: TreeState) -> list[Conflict]:
    return [
        Conflict(old.nodes[scope].path if scope else "", key, _name(entry), _name(new.entries[scope][key]))
        for scope, key, entry in moved_entries(old, new)
        if not _takes(entry, new.entries[scope].get(key))
    ]


def moved_entries(old: TreeState, new: TreeState) -> Iterator[tuple[Key, str, EntryState]]:
    """Yields the entries that the new tree takes over: scope, name and entry.

    Left out are those of scopes that left, those to which a SubTree gives another constant now, and those
    whose name leads to an entry of the caller now.
    """
    for scope, entries in old.entries.items():
        if scope not in new.entries:
            continue
        before = old.nodes[scope].attributes if scope else {}
        after = new.nodes[scope].attributes if scope else {}
        for key, entry in entries.items():
            is_led_away = key in new.remapped[scope] and key not in old.remapped[scope]
            if before.get(key) == after.get(key) and not is_led_away:
                yield scope, key, entry


def _takes(entry: EntryState, other: EntryState | None) -> bool:
    """Returns whether an entry of the new tree, if it exists, takes the value of that of the old one."""
    if entry.value is EMPTY or other is None or other.type is None or not other.type.is_strong:
        return True
    if entry.type is not None and entry.type.is_strong and entry.type.name != other.type.name:
        return False
    try:
        other.type.convert(entry.value)
    except ConversionError:
        return False
    return True


def _name(entry: EntryState) -> str:
    return "any" if entry.type is None else entry.type.name


def _late_ports(old: TreeState, new: TreeState, fates: Mapping[Key, Fate]) -> list[LatePort]:
    return [
        LatePort(key, new.nodes[key].path, port)
        for key, node in old.nodes.items()
        if fates[key] is Fate.KEPT
        for port in sorted(node.early)
        if node.attributes.get(port) != new.nodes[key].attributes.get(port)
    ]
