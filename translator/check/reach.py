"""Checks for branches that can never be ticked, by the results that each node can return."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from translator.check.reason import because
from translator.check.results.controls import FALLBACKS, RESTING, SEQUENCES, threshold
from translator.check.results.sets import ALL, FALSE, TRUE, F, K, R, S, literal, whole, words

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.check.context import Context
    from translator.tree import Node, Tree

_NEVER: Final = (("_failureIf", TRUE), ("_successIf", TRUE), ("_skipIf", TRUE), ("_while", FALSE))
_COUNTS: Final = {"Repeat": "num_cycles", "RetryUntilSuccessful": "num_attempts"}


def check_reachability(context: Context) -> None:
    """Reports each branch that can never be ticked, once, at its first node."""
    for tree in context.project.trees.values():
        stack = [root for root in (tree.root,) if root is not None and root in tree.nodes]
        while stack:
            node = tree.nodes[stack.pop()]
            if node.disabled or _is_never_ticked(context, tree, node):
                continue
            unreached = _unreached(context, tree, node)
            stack.extend(child for child in reversed(node.children) if child not in unreached)


def _is_never_ticked(context: Context, tree: Tree, node: Node) -> bool:
    """Reports a node that a constant pre-condition keeps from being ticked."""
    for name, values in _NEVER:
        text = node.conditions.get(name, "").strip()
        if text in values:
            said = {"child": node.label, "port": name, "parent": node.label, "value": text}
            context.report("BT0117", tree, node, name, **said)
            return True
    return False


def _unreached(context: Context, tree: Tree, node: Node) -> set[str]:
    """Reports the branches of a node that it never ticks; returns their first nodes."""
    for port, first in _by_ports(node):
        child = tree.nodes[node.children[first]]
        value = node.ports.get(port, "")
        said = {"child": child.label, "port": port, "parent": node.label, "value": value}
        context.report("BT0117", tree, child, port, because(context, tree, (node,)), **said)
        return set(node.children[first:])
    for index, elder in _by_siblings(context, tree, node):
        _report(context, tree, node, index, elder)
        branch = node.type in RESTING or node.type == "TryCatch"
        return set(node.children[index : index + 1] if branch else node.children[index:])
    return set()


def _by_ports(node: Node) -> Iterator[tuple[str, int]]:
    """Yields a port whose value keeps the children from an index on from being ticked."""
    count = len(node.children)
    if node.type in _COUNTS and count:
        times = whole(node, _COUNTS[node.type])
        if times is not None and (times == 0 or times < -1):
            yield _COUNTS[node.type], 0
    elif node.type == "Precondition" and count and (literal(node, "if") or "").strip() in FALSE:
        yield "if", 0
    elif node.type == "Parallel" and count > 1:
        wanted = whole(node, "success_count", -1)
        if wanted is not None and threshold(wanted, count) == 0:
            yield "success_count", 1


def _by_siblings(context: Context, tree: Tree, node: Node) -> Iterator[tuple[int, int]]:
    """Yields the first child that is never reached, and the earlier one that keeps it from that."""
    sets = [context.results.of(tree, child) for child in node.children]
    if node.type in SEQUENCES or node.type in FALLBACKS:
        goes_on = S | K if node.type in SEQUENCES else F | K
        yield from _after(sets, goes_on)
    elif context.results.is_library(node.type) and node.type in _NAV2:
        yield from _after(sets, _NAV2[node.type])
    elif node.type == "ParallelAll":
        return
    elif node.type in RESTING and len(sets) > 1:
        for index, needed in ((1, S), (2, F)):
            if index < len(sets) and not sets[0] & needed:
                yield index, 0
    elif node.type == "TryCatch" and len(sets) > 1:
        yield from _after(sets[:-1], S | K)
        if not any(each & F for each in sets[:-1]):
            yield len(sets) - 1, len(sets) - 2


_NAV2: Final = {"RecoveryNode": F, "NonblockingSequence": S | R, "PipelineSequence": ALL & ~F}


def _after(sets: list[int], goes_on: int) -> Iterator[tuple[int, int]]:
    for index in range(1, len(sets)):
        if not sets[index - 1] & goes_on:
            yield index, index - 1
            return


def _report(context: Context, tree: Tree, node: Node, index: int, elder_index: int) -> None:
    child, elder = tree.nodes[node.children[index]], tree.nodes[node.children[elder_index]]
    results = context.results.of(tree, elder.id)
    said = {"child": child.label, "parent": node.label, "elder": elder.label, "says": words(results)}
    path = because(context, tree, (node, elder))
    if node.type in FALLBACKS and elder_index == 0:
        context.report("BT0118", tree, elder, "", path, **said)
    else:
        context.report("BT0114", tree, child, "", path, **said)
