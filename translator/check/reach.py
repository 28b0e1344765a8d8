"""Checks for children that can never be ticked, by the statuses that each node can return."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from translator.check.context import Context
    from translator.tree import Node, Tree

S, F, R, K = "S", "F", "R", "K"
ANY = frozenset({S, F, R, K})
_GOES_ON = {
    "Sequence": {S, K},
    "AsyncSequence": {S, K},
    "SequenceWithMemory": {S, K},
    "ReactiveSequence": {S, K},
    "Fallback": {F, K},
    "AsyncFallback": {F, K},
    "ReactiveFallback": {F, K},
}
_SURE_LEAVES = {"AlwaysSuccess", "AlwaysFailure", "Script"}
Outcomes = frozenset[str]


def check_reachability(context: Context) -> None:
    """Reports, for each node, the first child that can never be ticked because of its earlier siblings."""
    for tree in context.project.trees.values():
        outcomes: dict[str, Outcomes] = {}
        for node in tree.post_order():
            outcomes[node.id] = _outcomes(node, [outcomes.get(child, ANY) for child in node.children])
            _check_children(context, tree, node, outcomes)


def _check_children(context: Context, tree: Tree, node: Node, outcomes: dict[str, Outcomes]) -> None:
    goes_on = _GOES_ON.get(node.type)
    if goes_on is not None:
        for elder, child in zip(node.children, node.children[1:], strict=False):
            if outcomes.get(elder, ANY).isdisjoint(goes_on):
                _report(context, tree, node, tree.nodes[child], (tree.nodes[elder], outcomes[elder]))
                return
    elif node.type in {"IfThenElse", "WhileDoElse"} and len(node.children) >= 2:
        condition = outcomes.get(node.children[0], ANY)
        for child, needed in zip(node.children[1:3], (S, F), strict=False):
            if needed not in condition:
                _report(context, tree, node, tree.nodes[child], (tree.nodes[node.children[0]], condition))


_WORDS = {S: "succeeds", F: "fails", R: "runs", K: "is skipped"}


def _report(context: Context, tree: Tree, node: Node, child: Node, cause: tuple[Node, Outcomes]) -> None:
    elder, outcomes = cause
    says = " or ".join(_WORDS[status] for status in (S, F, R, K) if status in outcomes)
    context.report("BT0114", tree, child, child=child.label, parent=node.label, elder=elder.label, says=says)


def _outcomes(node: Node, children: list[Outcomes]) -> Outcomes:
    """Returns the statuses that a node may return; `ANY` if they are unknown."""
    if node.disabled:
        return frozenset({K})
    rule = _RULES.get(node.type) if children or node.type in _SURE_LEAVES else None
    result = rule(children) if rule is not None else ANY
    extra = {
        "_failureIf": {F},
        "_successIf": {S},
        "_skipIf": {K},
        "_while": {K},
    }
    for condition in node.conditions:
        result |= extra.get(condition, set())
    return result


def _sequence(children: list[Outcomes], *, success: str, failure: str) -> Outcomes:
    result: set[str] = set()
    skippable = True
    for child in children:
        result |= child & {failure, R}
        skippable = skippable and K in child
        if child.isdisjoint({success, K}):
            break
    else:
        result |= {success} if any(success in child for child in children) else set()
        result |= {K} if skippable else set()
    return frozenset(result)


def _swap(children: list[Outcomes]) -> Outcomes:
    return frozenset({S: F, F: S}.get(status, status) for status in children[0])


def _force(status: str) -> Callable[[list[Outcomes]], Outcomes]:
    return lambda children: frozenset(status if found in {S, F} else found for found in children[0])


_RULES: dict[str, Callable[[list[Outcomes]], Outcomes]] = {
    "AlwaysSuccess": lambda _: frozenset({S}),
    "AlwaysFailure": lambda _: frozenset({F}),
    "Script": lambda _: frozenset({S}),
    "Inverter": _swap,
    "ForceSuccess": _force(S),
    "ForceFailure": _force(F),
    "KeepRunningUntilFailure": lambda children: frozenset({R}) | (children[0] & {F}),
    "Sequence": lambda children: _sequence(children, success=S, failure=F),
    "ReactiveSequence": lambda children: _sequence(children, success=S, failure=F),
    "AsyncSequence": lambda children: _sequence(children, success=S, failure=F) | {R},
    "SequenceWithMemory": lambda children: _sequence(children, success=S, failure=F) | {R},
    "Fallback": lambda children: _sequence(children, success=F, failure=S),
    "ReactiveFallback": lambda children: _sequence(children, success=F, failure=S),
    "AsyncFallback": lambda children: _sequence(children, success=F, failure=S) | {R},
}
