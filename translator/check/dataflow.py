"""Checks of the data flow over the blackboard: keys read but never written, outputs never read.

Each tree has its own blackboard; a SubTree node connects names of two blackboards. So the keys that a tree
and its calls read and write are collected under the tree's own names, called trees first.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from translator.catalog import did_you_mean, nearest
from translator.check.script import scripts_of
from translator.ros_nodes import with_fields
from translator.script_names import script_names
from translator.tree import Node, Tree, pointer

if TYPE_CHECKING:
    from translator.check.context import Context


@dataclass(frozen=True, slots=True)
class _Use:
    node: Node
    port: str
    inner: str = ""  # for a use inside a called tree: the name there


@dataclass(slots=True)
class _Keys:
    """The first use of each key of a tree, and the keys that are not decided by ports alone."""

    read: dict[str, _Use] = field(default_factory=dict)
    written: dict[str, _Use] = field(default_factory=dict)
    surely: set[str] = field(default_factory=set)  # written in any case, whatever undeclared ports do


def check_dataflow(context: Context) -> None:
    """Reports keys that nothing writes, and outputs that nothing reads."""
    trees = context.project.trees
    keys: dict[str, _Keys] = {}
    for tree_id in context.order:
        keys[tree_id] = _keys_of(context, trees[tree_id], keys)
    global_writes = {key for item in keys.values() for key in item.written if key.startswith("@")}
    if (main := context.project.main) is not None and main.id in keys:
        global_writes |= {f"@{key}" for key in keys[main.id].written}
    global_reads = {key for item in keys.values() for key in item.read if key.startswith("@")}
    for tree_id in sorted(context.reachable):
        for node in trees[tree_id].subtree_calls():
            _report_missing_remaps(context, trees[tree_id], node, keys)
            _report_lost_writes(context, trees[tree_id], node, keys)
    if main is not None and main.id in keys:
        _report_main(context, main, keys[main.id], global_writes, global_reads)


def _keys_of(context: Context, tree: Tree, keys: dict[str, _Keys]) -> _Keys:
    own = _Keys()
    for node in tree.walk():
        for attribute, code in scripts_of(context, node):
            names = script_names(code)
            known = context.constants
            own.surely.update(names.written)
            for name in names.written:
                own.written.setdefault(name, _Use(node, ""))
            for name in names.read:
                if name in known:
                    continue  # an enumeration's name comes before an entry's
                own.read.setdefault(name, _Use(node, attribute))
        if node.is_subtree:
            _add_call(own, node, keys.get(node.tree))
        else:
            _add_ports(context, own, node)
    return own


def _add_ports(context: Context, own: _Keys, node: Node) -> None:
    model = context.model(node.type)
    model = None if model is None else with_fields(model, node)
    if node.type in {"SetBlackboard", "UnsetBlackboard"}:
        target = node.ports.get("output_key", "")
        own.written.setdefault(pointer(target) or target, _Use(node, ""))
        own.surely.add(target)
    for name, port in model.ports.items() if model else ():
        text = node.ports.get(name, port.default)
        key = pointer(text, name) if text is not None else None
        if key is None:
            continue
        if port.is_read:
            own.read.setdefault(key, _Use(node, name))
        if port.is_written:
            own.surely.add(key)
            own.written.setdefault(key, _Use(node, name if port.direction == "output" else ""))
    for name, value in node.ports.items():
        if (model is None or name not in model.ports) and (key := pointer(value, name)) is not None:
            # The direction of an undeclared port is unknown: it may read, and it may write.
            own.written.setdefault(key, _Use(node, ""))
            own.read.setdefault(key, _Use(node, name))


def _add_call(own: _Keys, node: Node, inner: _Keys | None) -> None:
    if inner is None:
        for name, text in node.ports.items():
            if (key := pointer(text, name)) is not None:
                own.written.setdefault(key, _Use(node, ""))
        return
    for name, use in inner.read.items():
        outer = _outer_name(node, name)
        if outer is not None and name not in inner.written:
            own.read.setdefault(outer, _Use(node, name, inner=use.port))
        elif outer is not None:
            own.read.setdefault(outer, _Use(node, ""))
    for name in inner.written:
        if (outer := _outer_name(node, name)) is not None:
            own.surely.update({outer} if name in inner.surely else ())
            own.written.setdefault(outer, _Use(node, ""))


def _outer_name(node: Node, inner: str) -> str | None:
    """Returns the caller's name for an entry of the called tree, or None if the caller has none."""
    if inner.startswith("@"):
        return inner
    if inner in node.ports:
        return pointer(node.ports[inner], inner)
    return inner if node.autoremap and not inner.startswith("_") else None


def _report_main(
    context: Context, main: Tree, own: _Keys, global_writes: set[str], global_reads: set[str]
) -> None:
    for key, use in own.read.items():
        if use.port and key not in own.written and key not in global_writes:
            suggestion = did_you_mean(key, own.written)
            said = {"key": key, "port": use.port, "near": nearest(key, own.written)}
            context.report("BT0401", main, use.node, use.port, suggestion=suggestion, **said)
    for key, use in own.written.items():
        if use.port and key not in own.read and f"@{key}" not in global_reads:
            context.report("BT0402", main, use.node, use.port, key=key, port=use.port)


def _report_lost_writes(context: Context, tree: Tree, node: Node, keys: dict[str, _Keys]) -> None:
    """Reports what a called tree writes through a remap to a global, which BehaviorTree.CPP 4.10 loses."""
    inner = keys.get(node.tree)
    for name, text in node.ports.items() if inner is not None else ():
        key = pointer(text, name)
        if inner is not None and key is not None and key.startswith("@") and name in inner.surely:
            context.report("BT0404", tree, node, name, target=node.tree, inner=name, key=key)


def _report_missing_remaps(context: Context, tree: Tree, node: Node, keys: dict[str, _Keys]) -> None:
    inner = keys.get(node.tree)
    if inner is None or node.autoremap:
        return
    modelled = {port.name for port in context.project.trees[node.tree].ports}
    for name, use in inner.read.items():
        passed = name in node.ports or name in modelled or name.startswith("@")
        if use.port and not passed and name not in inner.written:
            context.report("BT0403", tree, node, name, target=node.tree, key=name)
