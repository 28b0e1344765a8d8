"""Checks of scripts that are in an entry: BehaviorTree.CPP reads them when it builds the tree.

At that time an entry has a value only if it is a constant that a SubTree receives.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from translator.tree import Node, Tree, pointer

if TYPE_CHECKING:
    from translator.check.context import Context


def check_late_scripts(context: Context) -> None:
    """Reports scripts whose entry has no value when the tree is built."""
    for tree_id in sorted(context.reachable):
        tree = context.project.trees[tree_id]
        for node in tree.walk():
            for port, key in _scripts_in_entries(context, node):
                if not _is_constant(context, tree_id, key):
                    context.report("BT0303", tree, node, port, port=port, key=key, type=node.type)


def _scripts_in_entries(context: Context, node: Node) -> list[tuple[str, str]]:
    model = context.model(node.type)
    ports = model.ports.values() if model is not None else ()
    found = [
        (port.name, pointer(node.ports.get(port.name, ""), port.name))
        for port in ports
        if port.type == "script"
    ]
    return [(name, key) for name, key in found if key is not None]


def _is_constant(context: Context, tree_id: str, key: str) -> bool:
    """Returns whether the entry is a constant in every call of the tree."""
    waiting, seen = [(tree_id, key)], set()
    while waiting:
        place = waiting.pop()
        if place in seen:
            continue
        seen.add(place)
        called, name = place
        calls = _calls(context, called)
        if name.startswith("@") or called == context.project.settings.main_tree or not calls:
            return False
        for caller, node in calls:
            outer = _outer(context, node, name)
            if outer is None:
                return False
            if (further := pointer(outer, name)) is not None:
                waiting.append((caller.id, further))
    return True


def _calls(context: Context, tree_id: str) -> list[tuple[Tree, Node]]:
    trees = context.project.trees
    return [
        (trees[caller], node)
        for caller in sorted(context.reachable)
        for node in trees[caller].subtree_calls()
        if node.tree == tree_id
    ]


def _outer(context: Context, node: Node, name: str) -> str | None:
    """Returns the value that a call gives to an entry of its tree: a constant, a `{key}`, or None."""
    if name in node.ports:
        return node.ports[name]
    if node.autoremap:
        return None if name.startswith("_") else f"{{{name}}}"
    ports = context.project.trees[node.tree].ports
    return next((port.default for port in ports if port.name == name), None)
