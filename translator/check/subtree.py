"""Checks of SubTree nodes: the tree that they call, cycles, names, remappings."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from translator.catalog import did_you_mean
from translator.check.port import RESERVED, check_braces, check_literal
from translator.text import is_xml_name
from translator.tree import AUTOREMAP, pointer

if TYPE_CHECKING:
    from translator.catalog import PortModel
    from translator.check.context import Context
    from translator.tree import Node, Tree

_WHOLE = re.compile(r"-?[0-9]+")


def check_subtrees(context: Context) -> None:
    """Reports calls of trees that cannot work."""
    for tree in context.project.trees.values():
        names: dict[str, Node] = {}
        for node in tree.subtree_calls():
            _check_call(context, tree, node)
            if node.name and node.name in names:
                context.report("BT0503", tree, node, name=node.name, other=names[node.name].id)
            names.setdefault(node.name, node)
    _check_cycles(context)


def _check_call(context: Context, tree: Tree, node: Node) -> None:
    trees = context.project.trees
    if node.tree not in trees:
        otherwise = "Make a tree of this name, or choose another."
        suggestion = did_you_mean(node.tree, trees, otherwise=otherwise)
        context.report("BT0501", tree, node, target=node.tree or "(none)", suggestion=suggestion)
        return
    autoremap = node.attributes.get(AUTOREMAP)
    if autoremap is not None and autoremap not in {
        "0",
        "1",
        "true",
        "false",
        "True",
        "False",
        "TRUE",
        "FALSE",
    }:
        context.report("BT0505", tree, node, value=autoremap)
    declared = {port.name: port for port in trees[node.tree].ports}
    for name, text in node.ports.items():
        if name in RESERVED or name.startswith("_") or not is_xml_name(name):
            context.report("BT0209", tree, node, name, port=name)
        if check_braces(context, tree, node, name, text) and name in declared:
            _check_value(context, tree, node, declared[name], text)
    if node.autoremap:
        return
    for port in trees[node.tree].ports:
        if port.name not in node.ports and port.default is None:
            context.report("BT0504", tree, node, port.name, target=node.tree, port=port.name)


def _check_value(context: Context, tree: Tree, node: Node, port: PortModel, text: str) -> None:
    """Reports a literal that the tree below could not read."""
    if pointer(text, port.name) is not None:
        return
    if port.type == "double" and _WHOLE.fullmatch(text):
        # A number that a SubTree is given becomes a typed entry; an int is no double there.
        context.report("BT0506", tree, node, port.name, port=port.name, value=text, wanted=f"{text}.0")
    elif not port.is_written:
        check_literal(context, tree, node, port, text)


def _check_cycles(context: Context) -> None:
    """Reports each call that leads back to its own tree: any one of a ring can be the one to take out."""
    trees = context.project.trees
    calls = {tree_id: list(tree.subtree_calls()) for tree_id, tree in trees.items()}
    called = _in_rings({key: {node.tree for node in nodes} & trees.keys() for key, nodes in calls.items()})
    for tree_id in called:
        for node in calls[tree_id]:
            if (way := _way(called, node.tree, tree_id)) is not None:
                context.report("BT0502", trees[tree_id], node, ring=" → ".join([tree_id, *way]))


def _in_rings(called: dict[str, set[str]]) -> dict[str, set[str]]:
    """Leaves out, again and again, the trees that call none of those left: all, if there is no ring."""
    callers: dict[str, list[str]] = {}
    for tree_id, targets in called.items():
        for target in targets:
            callers.setdefault(target, []).append(tree_id)
    waiting = {tree_id: len(targets) for tree_id, targets in called.items()}
    done = [tree_id for tree_id, count in waiting.items() if count == 0]
    for tree_id in done:
        for caller in callers.get(tree_id, ()):
            waiting[caller] -= 1
            if waiting[caller] == 0:
                done.append(caller)
    return {tree_id: targets for tree_id, targets in called.items() if waiting[tree_id] > 0}


def _way(called: dict[str, set[str]], start: str, goal: str) -> list[str] | None:
    """Returns the trees from one to another along their calls, both included."""
    came_from = {start: ""}
    for tree_id in (queue := [start]):
        if tree_id == goal:
            way = [goal]
            while way[0] != start:
                way.insert(0, came_from[way[0]])
            return way
        for target in sorted(called.get(tree_id, ())):
            if target not in came_from:
                came_from[target] = tree_id
                queue.append(target)
    return None
