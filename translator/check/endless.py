"""Checks for loops that never give the tick back: they spin within one tick of the tree.

`tick_once` ticks a tree again at once while a node asks for it. An endless Repeat or RetryUntilSuccessful
does so after each cycle of a child that is done within a tick; two nodes that yield under a reactive one wake
each other. Only a result that is really RUNNING, which waits for the next tick, ends this.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from translator.check.reason import because
from translator.check.results.controls import FALLBACKS
from translator.check.results.sets import YIELDS, F, R, S, whole, words

if TYPE_CHECKING:
    from translator.check.context import Context
    from translator.tree import Node, Tree

_LOOPS: Final = {"Repeat": ("num_cycles", S), "RetryUntilSuccessful": ("num_attempts", F)}
_REACTIVE: Final = frozenset({"ReactiveSequence", "ReactiveFallback"})


def check_endless_loops(context: Context) -> None:
    """Reports loops whose child can never be RUNNING, and reactive nodes whose children wake each other."""
    for tree in context.project.trees.values():
        for node in tree.walk():
            if node.disabled:
                continue
            if node.type in _LOOPS and len(node.children) == 1:
                _check_loop(context, tree, node)
            elif node.type in _REACTIVE:
                _check_reactive(context, tree, node)


def _check_loop(context: Context, tree: Tree, node: Node) -> None:
    port, counted = _LOOPS[node.type]
    child = tree.nodes[node.children[0]]
    results = context.results.of(tree, child.id)
    if whole(node, port) == -1 and results & counted and not results & R:
        said = {"node": node.label, "child": child.label, "says": words(results)}
        context.report("BT0120", tree, node, port, because(context, tree, (node, child)), **said)


def _check_reactive(context: Context, tree: Tree, node: Node) -> None:
    goes_on = F if node.type in FALLBACKS else S
    elder = None
    for child_id in node.children:
        results = context.results.of(tree, child_id)
        if results & YIELDS and not results & R:
            child = tree.nodes[child_id]
            if elder is not None:
                said = {"node": node.label, "elder": elder.label, "child": child.label}
                context.report("BT0125", tree, node, "", because(context, tree, (node, elder, child)), **said)
                return
            if results & goes_on:
                elder = child
