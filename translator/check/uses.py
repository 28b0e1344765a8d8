"""The uses of blackboard keys: the reads and writes of each node, under the names of its own tree.

Each tree has its own blackboard; a SubTree node connects names of two blackboards. So a SubTree node uses
what its tree uses, under the names that it gives them.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from translator.check.script import scripts_of
from translator.ros_nodes import with_fields
from translator.script_names import script_names
from translator.tree import Node, Tree, pointer

if TYPE_CHECKING:
    from collections.abc import Mapping

    from translator.check.context import Context


@dataclass(frozen=True, slots=True)
class Use:
    """A use of a key by a port or script of a node; `inner` is the name in a called tree."""

    node: Node
    port: str
    inner: str = ""


@dataclass(slots=True)
class Keys:
    """The first use of each key by a node or a tree.

    Attributes:
        read: the keys that it reads, or may read.
        written: the keys that it writes, or may write.
        surely: those that it writes in any case, whatever undeclared ports do.
        reads: the keys that it certainly reads, with the attributes that do so.
        parts: of a tree: the uses of each of its nodes.
    """

    read: dict[str, Use] = field(default_factory=dict)
    written: dict[str, Use] = field(default_factory=dict)
    surely: set[str] = field(default_factory=set)
    reads: list[tuple[str, str]] = field(default_factory=list)
    parts: dict[str, Keys] = field(default_factory=dict)

    def add(self, other: Keys) -> None:
        """Adds the uses of a later node."""
        for key, use in other.read.items():
            self.read.setdefault(key, use)
        for key, use in other.written.items():
            self.written.setdefault(key, use)
        self.surely |= other.surely


def uses_of(context: Context) -> dict[str, Keys]:
    """Returns the uses of keys by each tree."""
    keys: dict[str, Keys] = {}
    for tree_id in context.order:
        keys[tree_id] = _keys_of(context, context.project.trees[tree_id], keys)
    return keys


def _keys_of(context: Context, tree: Tree, keys: Mapping[str, Keys]) -> Keys:
    whole = Keys()
    for node in tree.walk():
        part = Keys()
        _add_scripts(context, part, node)
        if node.is_subtree:
            _add_call(part, node, keys.get(node.tree))
        else:
            _add_ports(context, part, node)
        if part.read or part.written:
            whole.parts[node.id] = part
            whole.add(part)
    return whole


def _add_scripts(context: Context, part: Keys, node: Node) -> None:
    known = context.constants
    for attribute, code in scripts_of(context, node):
        names = script_names(code)
        part.surely.update(names.written)
        for name in names.written:
            part.written.setdefault(name, Use(node, ""))
        for name in names.read:
            if name in known:
                continue  # an enumeration's name comes before an entry's
            part.read.setdefault(name, Use(node, attribute))
            part.reads.append((name, attribute))


def _add_ports(context: Context, part: Keys, node: Node) -> None:
    model = context.model(node.type)
    model = None if model is None else with_fields(model, node)
    if node.type in {"SetBlackboard", "UnsetBlackboard"}:
        target = node.ports.get("output_key", "")
        if target:
            part.written.setdefault(pointer(target) or target, Use(node, ""))
            part.surely.add(target)
    for name, port in model.ports.items() if model else ():
        text = node.ports.get(name, port.default)
        key = pointer(text, name) if text is not None else None
        if key is None:
            continue
        if port.is_read:
            part.read.setdefault(key, Use(node, name))
            if not port.is_written:
                part.reads.append((key, name))
        if port.is_written:
            part.surely.add(key)
            part.written.setdefault(key, Use(node, name if port.direction == "output" else ""))
    for name, value in node.ports.items():
        if (model is None or name not in model.ports) and (key := pointer(value, name)) is not None:
            # The direction of an undeclared port is unknown: it may read, and it may write.
            part.written.setdefault(key, Use(node, ""))
            part.read.setdefault(key, Use(node, name))


def _add_call(part: Keys, node: Node, inner: Keys | None) -> None:
    if inner is None:
        for name, text in node.ports.items():
            if (key := pointer(text, name)) is not None:
                part.written.setdefault(key, Use(node, ""))
        return
    for name, use in inner.read.items():
        outer = outer_name(node, name)
        if outer is not None and name not in inner.written:
            part.read.setdefault(outer, Use(node, name, inner=use.port))
        elif outer is not None:
            part.read.setdefault(outer, Use(node, ""))
    for name in inner.written:
        if (outer := outer_name(node, name)) is not None:
            part.surely.update({outer} if name in inner.surely else ())
            part.written.setdefault(outer, Use(node, ""))


def outer_name(node: Node, inner: str) -> str | None:
    """Returns the caller's name for an entry of the called tree, or None if the caller has none."""
    if inner.startswith("@"):
        return inner
    if inner in node.ports:
        return pointer(node.ports[inner], inner)
    return inner if node.autoremap and not inner.startswith("_") else None


def is_local(context: Context, tree: Tree, key: str) -> bool:
    """Returns whether no caller of a tree shares its entry: it is no port, and no call maps it."""
    if key.startswith("@") or any(port.name == key for port in tree.ports):
        return False
    return all(
        key not in node.ports and outer_name(node, key) is None for _, node in context.calls.get(tree.id, ())
    )
