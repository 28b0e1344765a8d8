"""Checks for decorators that change nothing, by the results of their child."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from translator.check.reason import because
from translator.check.results.sets import DONE, RUNS, TRUE, F, K, S, literal, whole, words

if TYPE_CHECKING:
    from translator.check.context import Context
    from translator.tree import Node, Tree

_CHANGES: Final = {
    "Inverter": DONE,
    "ForceSuccess": F,
    "ForceFailure": S,
    "Repeat": S,
    "RetryUntilSuccessful": F,
    "KeepRunningUntilFailure": S | K,
    "RunOnce": DONE,
    "Timeout": RUNS | K,
}
"""The results of a child that a decorator changes, or that it counts."""


def check_effects(context: Context) -> None:
    """Reports decorators that only return their child's result, and have no conditions."""
    for tree in context.project.trees.values():
        for node in tree.walk():
            if len(node.children) == 1 and not node.disabled and not node.conditions:
                _check(context, tree, node, tree.nodes[node.children[0]])


def _check(context: Context, tree: Tree, node: Node, child: Node) -> None:
    port = _idle_port(node)
    if port:
        said = {"node": node.label, "type": node.type, "port": port, "value": node.ports.get(port, "")}
        context.report("BT0123", tree, node, port, **said)
        return
    if node.type == child.type == "Inverter" and not child.conditions and not child.disabled:
        context.report("BT0124", tree, node, node=node.label, child=child.label)
        return
    results = context.results.of(tree, child.id)
    if node.type in _CHANGES and results and not results & _CHANGES[node.type]:
        said = {"node": node.label, "type": node.type, "child": child.label, "says": words(results)}
        context.report("BT0119", tree, node, "", because(context, tree, (node, child)), **said)


def _idle_port(node: Node) -> str:
    """Returns the port whose value makes a decorator pass on every result, or ""."""
    if node.type == "Repeat" and whole(node, "num_cycles") == 1:
        return "num_cycles"
    if node.type == "RetryUntilSuccessful" and whole(node, "num_attempts") == 1:
        return "num_attempts"
    if node.type == "Timeout" and (limit := whole(node, "msec")) is not None and limit <= 0:
        return "msec"
    if node.type == "Precondition" and (literal(node, "if") or "").strip() in TRUE:
        return "if"
    return ""
