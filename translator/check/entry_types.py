"""Checks of the types of blackboard entries, by the rule of the engine when it builds a tree.

The first port that names an entry, in the order of execution, gives it a type, or none: then other ports may
have any. A SubTree's names lead to entries of its caller; a constant that it passes has the type of a number.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from translator.check.port import is_queue
from translator.diagnostic import Severity
from translator.tree import Node, Tree, bare_pointer, pointer
from translator.values import constant_type, describe

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.catalog import PortModel
    from translator.check.context import Context

_VISITED = 50_000
"""The number of nodes that are visited from one tree; trees that call each other often have more."""
_OBJECT = "an object"


@dataclass(frozen=True, slots=True)
class Entry:
    """The first use of an entry; `type` is "" if it has none, `port` if a SubTree passes a constant."""

    type: str
    tree: Tree
    node: Node
    port: str

    @property
    def label(self) -> str:
        """The place of the use, for messages."""
        return f"{self.node.label} ({self.node.id}), port {self.port}"


@dataclass(slots=True)
class _Scope:
    """The entries and remappings of one blackboard."""

    parent: _Scope | None = None
    entries: dict[str, Entry] = field(default_factory=dict)
    remapping: dict[str, str] = field(default_factory=dict)
    autoremap: bool = False

    @property
    def root(self) -> _Scope:
        scope = self
        while scope.parent is not None:
            scope = scope.parent
        return scope

    def declare(self, key: str, entry: Entry) -> Entry:
        """Returns the entry that a name means; if there is none, `entry`, which is stored."""
        scope = self
        while True:
            if key.startswith("@"):
                scope, key = scope.root, key[1:]
            found = scope.entries.get(key)
            if found is not None:
                return found
            outer = scope.remapping.get(key)
            if scope.parent is None or (outer is None and (not scope.autoremap or key.startswith("_"))):
                return scope.entries.setdefault(key, entry)
            scope, key = scope.parent, key if outer is None else outer


def check_entry_types(context: Context) -> None:
    """Reports ports of different types that lead to one entry, in one tree or through SubTrees."""
    trees = context.project.trees
    told: set[tuple[str, str, str]] = set()
    for start in [context.project.settings.main_tree, *sorted(set(trees) - context.reachable)]:
        if start not in trees:
            continue
        for key, first, second, port in _conflicts(context, trees[start]):
            place = (second.tree.id, second.node.id, second.port)
            if place not in told:
                told.add(place)
                _report(context, key, first, second, port)


def _report(context: Context, key: str, first: Entry, second: Entry, port: PortModel) -> None:
    said = {"key": key, "other": first.label}
    if first.type == "string":
        context.report("BT0407", second.tree, second.node, second.port, **said)
        return
    types = {
        "held": describe(second.type),
        "other_held": describe(first.type),
        "value_type": second.type,
        "other_type": first.type,
    }
    severity = Severity.WARNING if is_queue(port) else None
    if first.tree is second.tree and not is_shared(context, second.tree, key):
        context.report_as(severity, "BT0210", second.tree, second.node, second.port, **said, **types)
    else:
        values = {**said, **types, "tree": first.tree.id}
        context.report_as(severity, "BT0214", second.tree, second.node, second.port, **values)


def is_shared(context: Context, tree: Tree, key: str) -> bool:
    """Returns whether other trees may use an entry, by a name that a SubTree passes."""
    if key.startswith("@") or any(port.name == key for port in tree.ports):
        return True
    calls = [node for each in context.project.trees.values() for node in each.subtree_calls()]
    from_outside = any(node.autoremap or key in node.ports for node in calls if node.tree == tree.id)
    return from_outside or any(
        node.autoremap or key in (pointer(text, name) for name, text in node.ports.items())
        for node in tree.subtree_calls()
    )


def _conflicts(context: Context, start: Tree) -> Iterator[tuple[str, Entry, Entry, PortModel]]:
    """Yields each second use of an entry that its first use does not permit."""
    trees = context.project.trees
    stack = [(start, _Scope(), start.walk(), {start.id})]
    for _ in range(_VISITED):
        if not stack:
            return
        tree, scope, rest, above = stack[-1]
        node = next(rest, None)
        if node is None:
            stack.pop()
        elif not node.is_subtree:
            yield from _declared(context, tree, node, scope)
        elif node.tree in trees and node.tree not in above:
            target = trees[node.tree]
            stack.append((target, _inner(tree, node, target, scope), target.walk(), {*above, target.id}))


def _declared(
    context: Context, tree: Tree, node: Node, scope: _Scope
) -> Iterator[tuple[str, Entry, Entry, PortModel]]:
    model = context.model(node.type)
    for name, text in node.ports.items() if model is not None and not model.open else ():
        port = model.ports.get(name) if model is not None else None
        key = pointer(text, name)
        if port is None or key is None:
            continue
        second = Entry(_type_of(port), tree, node, name)
        first = scope.declare(key, second)
        if first.type and (is_queue(port) or second.type) and not _agree(first.type, second, port):
            shown = Entry(port.type, tree, node, name) if is_queue(port) else second
            yield key, first, shown, port


def _agree(first: str, second: Entry, port: PortModel) -> bool:
    if is_queue(port):
        return first in {"string", port.type, _OBJECT}
    if first == "string":  # another value is refused when it is written
        return not port.is_written or second.type == "string"
    return first == second.type


def _type_of(port: PortModel) -> str:
    """Returns the type that a port gives to an entry; "" if any."""
    if is_queue(port):
        return ""
    if port.type == "any":
        return _OBJECT if port.is_object else ""
    return "string" if port.type == "script" else port.type


def _inner(tree: Tree, node: Node, target: Tree, scope: _Scope) -> _Scope:
    """Returns the blackboard of a called tree."""
    inner = _Scope(scope, autoremap=node.autoremap)
    passed = {name: (text, pointer(text, name)) for name, text in node.ports.items()}
    for port in () if node.autoremap else target.ports:
        if port.default:
            passed.setdefault(port.name, (port.default, bare_pointer(port.default)))
    for name, (text, outer) in passed.items():
        if outer is not None:
            inner.remapping[name] = outer
        else:
            inner.entries[name] = Entry(constant_type(text), tree, node, name)
    return inner
