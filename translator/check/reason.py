"""The path of a finding's reason through the trees: its nodes, and the possible results of each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from translator.check.results.controls import FALLBACKS, SEQUENCES
from translator.check.results.sets import DONE, F, K, S, names_of
from translator.diagnostic import Step

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from translator.check.context import Context
    from translator.tree import Node, Tree

LONGEST: Final = 12
_PASSES: Final = frozenset({"Inverter", "Timeout", "Delay", "RunOnce", "Repeat", "RetryUntilSuccessful"})


def step(context: Context, tree: Tree, node: Node) -> Step:
    """Returns a node as a step of a path."""
    return Step(tree.id, node.id, node.label, tuple(names_of(context.results.of(tree, node.id))))


def because(context: Context, tree: Tree, nodes: Iterable[Node]) -> tuple[Step, ...]:
    """Returns the path over some nodes, then from the last one down to the node that decides its results."""
    given = list(nodes)
    steps = [step(context, tree, node) for node in given]
    steps += [step(context, *found) for found in _causes(context, tree, given[-1])]
    return tuple(steps[:LONGEST])


def _causes(context: Context, tree: Tree, node: Node) -> Iterator[tuple[Tree, Node]]:
    """Yields the nodes below one whose results are those of a single child, from the nearest on."""
    for _ in range(LONGEST):
        if node.is_subtree:
            called = context.project.trees.get(node.tree)
            root = called.nodes.get(called.root or "") if called is not None else None
            if called is None or root is None:
                return
            tree, node = called, root
        elif (child := _cause(context, tree, node)) is not None:
            node = tree.nodes[child]
        else:
            return
        yield tree, node


def _cause(context: Context, tree: Tree, node: Node) -> str | None:
    """Returns the child that alone decides what a node cannot return."""
    if node.disabled or node.conditions:
        return None
    if len(node.children) == 1 and (node.type in _PASSES or node.type in SEQUENCES | FALLBACKS):
        return node.children[0]
    if node.type not in SEQUENCES and node.type not in FALLBACKS:
        return None
    goes_on = S if node.type in SEQUENCES else F
    missing = DONE & ~context.results.of(tree, node.id)
    if not missing & goes_on:
        return None
    # It cannot go through to its end: a child is in the way.
    return next(
        (child for child in node.children if not context.results.of(tree, child) & (goes_on | K)), None
    )
