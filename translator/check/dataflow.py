"""Checks of the data flow over the blackboard: keys read but never written, outputs never read.

Each tree has its own blackboard; a SubTree node connects names of two blackboards. So the keys that a tree
and its calls read and write are collected under the tree's own names, called trees first.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from translator.catalog import did_you_mean, nearest
from translator.check.uses import is_local
from translator.tree import pointer

if TYPE_CHECKING:
    from collections.abc import Mapping

    from translator.check.context import Context
    from translator.check.uses import Keys
    from translator.tree import Node, Tree


def check_dataflow(context: Context) -> None:
    """Reports keys that nothing writes, and outputs that nothing reads."""
    trees, keys = context.project.trees, context.keys
    global_writes = {key for item in keys.values() for key in item.written if key.startswith("@")}
    if (main := context.project.main) is not None and main.id in keys:
        global_writes |= {f"@{key}" for key in keys[main.id].written}
    global_reads = {key for item in keys.values() for key in item.read if key.startswith("@")}
    for tree_id in sorted(context.reachable):
        for node in trees[tree_id].subtree_calls():
            _report_missing_remaps(context, trees[tree_id], node, keys)
            _report_lost_writes(context, trees[tree_id], node, keys)
        if main is not None and tree_id != main.id:
            _report_unread(context, trees[tree_id], keys[tree_id])
    if main is not None and main.id in keys:
        _report_main(context, main, keys[main.id], global_writes, global_reads)


def _report_main(
    context: Context, main: Tree, own: Keys, global_writes: set[str], global_reads: set[str]
) -> None:
    for key, use in own.read.items():
        if use.port and key not in own.written and key not in global_writes:
            suggestion = did_you_mean(key, own.written)
            said = {"key": key, "port": use.port, "near": nearest(key, own.written)}
            context.report("BT0401", main, use.node, use.port, suggestion=suggestion, **said)
    for key, use in own.written.items():
        if use.port and key not in own.read and f"@{key}" not in global_reads:
            context.report("BT0402", main, use.node, use.port, key=key, port=use.port)


def _report_unread(context: Context, tree: Tree, own: Keys) -> None:
    """Reports the outputs of a called tree that nothing reads, and that no caller has a name for."""
    for key, use in own.written.items():
        if use.port and key not in own.read and is_local(context, tree, key):
            context.report("BT0402", tree, use.node, use.port, key=key, port=use.port)


def _report_lost_writes(context: Context, tree: Tree, node: Node, keys: Mapping[str, Keys]) -> None:
    """Reports writes of a called tree through a remap to a global key, which BehaviorTree.CPP 4.10 loses."""
    inner = keys.get(node.tree)
    for name, text in node.ports.items() if inner is not None else ():
        key = pointer(text, name)
        if inner is not None and key is not None and key.startswith("@") and name in inner.surely:
            context.report("BT0404", tree, node, name, target=node.tree, inner=name, key=key)


def _report_missing_remaps(context: Context, tree: Tree, node: Node, keys: Mapping[str, Keys]) -> None:
    inner = keys.get(node.tree)
    if inner is None or node.autoremap:
        return
    modelled = {port.name for port in context.project.trees[node.tree].ports}
    for name, use in inner.read.items():
        passed = name in node.ports or name in modelled or name.startswith("@")
        if use.port and not passed and name not in inner.written:
            context.report("BT0403", tree, node, name, target=node.tree, key=name)
