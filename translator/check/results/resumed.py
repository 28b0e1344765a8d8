"""The results of nodes that were RUNNING before: how a node can end once it has waited.

A Sequence of a condition and an action that turns fails at its condition, but not once the action has ended.
Reactive nodes need the difference: a child that waits, then lets the next one run, starts again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from translator.check.results.controls import FALLBACKS, RESTING, SEQUENCES, ordered
from translator.check.results.decorators import of_decorator
from translator.check.results.sets import RUNS, F, R, S

if TYPE_CHECKING:
    from collections.abc import Iterable

    from translator.check.results import Results
    from translator.tree import Node, Tree

_AGAIN: Final = frozenset({"SkipUnlessUpdated", "WaitValueUpdate", "Delay", "Precondition"})
"""Decorators that pass on how their child ends, but may wait or refuse by themselves before."""


def resumed(tree: Tree, results: Results, roots: dict[str, int]) -> dict[str, int]:
    """Returns, for each node of a tree, the results that it can have after a tick in which it was RUNNING.

    Args:
        tree: The tree.
        results: The results of all nodes.
        roots: The same of the roots of the trees that it calls.
    """
    found: dict[str, int] = {}
    for node in tree.post_order():
        named = results.named_of(tree, node.id)
        if not named & R:
            found[node.id] = 0
        elif node.is_subtree:
            found[node.id] = roots.get(node.tree, 0)
        elif not node.children:
            found[node.id] = named
        else:
            found[node.id] = named & _of(tree, node, results, found)
    return found


def _of(tree: Tree, node: Node, results: Results, found: dict[str, int]) -> int:
    if node.type in SEQUENCES or node.type in FALLBACKS:
        goes_on, ends = (S, F) if node.type in SEQUENCES else (F, S)
        after = 0
        for place, child in enumerate(node.children):
            if results.named_of(tree, child) & RUNS:
                later = [results.named_of(tree, each) for each in node.children[place + 1 :]]
                after |= ordered([found[child], *later], goes_on, ends)
        return after
    if node.type in _AGAIN:
        return found[node.children[0]] | R
    if len(node.children) == 1 and (decorated := of_decorator(node, found[node.children[0]])) is not None:
        return decorated
    if node.type in RESTING and not found[node.children[0]]:
        return _union(found[child] for child in node.children[1:])
    return results.named_of(tree, node.id)


def _union(sets: Iterable[int]) -> int:
    either = 0
    for each in sets:
        either |= each
    return either
