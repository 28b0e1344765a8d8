"""Checks of SubTree nodes: the tree that they call, cycles, names, remappings."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from translator.action_ports import is_read_as_port
from translator.catalog import did_you_mean
from translator.check.port import check_braces, check_literal
from translator.diagnostic import Severity
from translator.tree import AUTOREMAP, bare_pointer, pointer

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

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
            if node.has_empty_name and not node.name and tree.id == context.project.settings.main_tree:
                context.report("BT0507", tree, node)
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
        if not is_read_as_port(name):
            context.report_as(Severity.WARNING, "BT0209", tree, node, name, port=name)
        if check_braces(context, tree, node, name, text) and name in declared:
            _check_value(context, tree, node, declared[name], text)
    if node.autoremap:
        return
    for port in trees[node.tree].ports:
        if port.name in node.ports:
            continue
        if port.default is not None and bare_pointer(port.default) == "=":
            context.report("BT0508", tree, node, port.name, target=node.tree, port=port.name)
        if not port.default:
            context.report("BT0504", tree, node, port.name, target=node.tree, port=port.name)


def _check_value(context: Context, tree: Tree, node: Node, port: PortModel, text: str) -> None:
    """Reports a literal that the called tree could not read."""
    if pointer(text, port.name) is not None:
        return
    if port.type == "double" and _WHOLE.fullmatch(text):
        # A number that a SubTree is given becomes a typed entry; an int is not read as a double there.
        context.report("BT0506", tree, node, port.name, port=port.name, value=text, wanted=f"{text}.0")
    elif not port.is_written:
        check_literal(context, tree, node, port, text)


def _check_cycles(context: Context) -> None:
    """Reports, for each cycle of calls, the call that closes it, on the way from the main tree."""
    trees = context.project.trees
    for tree_id, target, ring in closing_calls(trees, context.project.settings.main_tree):
        node = next(node for node in trees[tree_id].subtree_calls() if node.tree == target)
        context.report("BT0502", trees[tree_id], node, ring=" → ".join([*ring, target]))


def closing_calls(trees: Mapping[str, Tree], main: str) -> Iterator[tuple[str, str, list[str]]]:
    """Yields each call that closes a cycle: the caller, the called tree, and the trees of the cycle.

    The search begins at the main tree. It then continues at the trees that it has not reached, in the order
    of their IDs.
    """
    done: set[str] = set()
    for start in [main, *sorted(trees)]:
        if start in done or start not in trees:
            continue
        above = {start: iter(_called(trees[start]))}
        while above:
            user = next(reversed(above))
            target = next(above[user], None)
            if target is None:
                del above[user]
                done.add(user)
            elif target in above:
                names = list(above)
                yield user, target, names[names.index(target) :]
            elif target in trees and target not in done:
                above[target] = iter(_called(trees[target]))


def _called(tree: Tree) -> list[str]:
    """Returns the trees that a tree calls, each once, in order of execution."""
    return list(dict.fromkeys(node.tree for node in tree.subtree_calls()))
