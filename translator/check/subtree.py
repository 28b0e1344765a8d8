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

_WHOLE = re.compile(r"[-+]?\d+")


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
    for name in node.ports:
        if name in RESERVED or name.startswith("_") or not is_xml_name(name):
            context.report("BT0209", tree, node, name, port=name)
    for port in trees[node.tree].ports:
        _check_value(context, tree, node, port)
    if node.autoremap:
        return
    for port in trees[node.tree].ports:
        if port.name not in node.ports and port.default is None:
            context.report("BT0504", tree, node, port.name, target=node.tree, port=port.name)


def _check_value(context: Context, tree: Tree, node: Node, port: PortModel) -> None:
    """Reports a literal that the tree below could not read."""
    text = node.ports.get(port.name)
    if text is None or not check_braces(context, tree, node, port.name, text):
        return
    if pointer(text, port.name) is not None:
        return
    if port.type == "double" and _WHOLE.fullmatch(text.strip()):
        # A number that a SubTree is given becomes a typed entry; an int is no double there.
        context.report(
            "BT0506", tree, node, port.name, port=port.name, value=text, wanted=f"{text.strip()}.0"
        )
    elif not port.is_written:
        check_literal(context, tree, node, port, text)


def _check_cycles(context: Context) -> None:
    """Reports each call that leads back into a tree that is being called."""
    trees = context.project.trees
    calls = {tree_id: list(tree.subtree_calls()) for tree_id, tree in trees.items()}
    done: set[str] = set()
    for start in trees:
        if start in done:
            continue
        trail: list[str] = [start]
        iterators = [iter(calls[start])]
        while iterators:
            node = next(iterators[-1], None)
            if node is None:
                iterators.pop()
                done.add(trail.pop())
            elif node.tree in trail:
                ring = " → ".join([*trail[trail.index(node.tree) :], node.tree])
                context.report("BT0502", trees[trail[-1]], node, ring=ring)
            elif node.tree in trees and node.tree not in done:
                trail.append(node.tree)
                iterators.append(iter(calls[node.tree]))
