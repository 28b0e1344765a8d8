"""The results of the built-in control nodes, by the rules of BehaviorTree.CPP 4.10.

A rule gets the node and the sets of its children, in order, and returns the node's set.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from translator.check.results.sets import ALL, DONE, RUNS, YIELDS, F, K, R, S, whole

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from translator.tree import Node

Rule = "Callable[[Node, Sequence[int]], int]"
RESTING: Final = frozenset({"IfThenElse", "WhileDoElse"})
"""The nodes that do not reset a condition that is done."""
SEQUENCES: Final = frozenset({"Sequence", "AsyncSequence", "SequenceWithMemory", "ReactiveSequence"})
FALLBACKS: Final = frozenset({"Fallback", "AsyncFallback", "ReactiveFallback"})
ASYNC: Final = frozenset({"AsyncSequence", "SequenceWithMemory", "AsyncFallback"})


def ordered(children: Sequence[int], goes_on: int, ends: int, *, yields: bool = False) -> int:
    """Returns the set of a Sequence (`goes_on` SUCCESS, `ends` FAILURE) or of a Fallback (the reverse)."""
    found = 0
    passes = goes_on | K
    are_all_skippable, is_one_done = True, False
    for index, child in enumerate(children):
        found |= child & (ends | RUNS)
        if not child & passes:
            return found
        if child & goes_on:
            is_one_done = True
            if yields and index + 1 < len(children):
                found |= YIELDS
        are_all_skippable = are_all_skippable and bool(child & K)
    return found | (goes_on if is_one_done else 0) | (K if are_all_skippable else 0)


def rested(children: Sequence[int], goes_on: int, ends: int) -> int:
    """Returns the additional results of an ordered node that is not reset after a result.

    Its count of skipped children is then kept, and may be too high or too low.
    """
    may_skip = any(child & K for child in children)
    return goes_on | K if may_skip and any(child & ends for child in children) else 0


def _sequence(node: Node, children: Sequence[int]) -> int:
    found = ordered(children, S, F, yields=node.type in ASYNC)
    # The position is kept after a failure, but not what was skipped before it.
    return found | rested(children, S, F) if node.type == "SequenceWithMemory" else found


def _fallback(node: Node, children: Sequence[int]) -> int:
    return ordered(children, F, S, yields=node.type in ASYNC)


def threshold(value: int, count: int) -> int:
    """Returns a count of children; a negative value counts from their number."""
    return value if value >= 0 else max(count + value + 1, 0)


def _parallel(node: Node, children: Sequence[int]) -> int:
    count = len(children)
    wanted, limit = whole(node, "success_count", -1), whole(node, "failure_count", 1)
    either = _union(children)
    found = either & RUNS
    can_all_skip = all(child & K for child in children)
    if (wanted is None or wanted >= 0) and either & K and count > 1:
        found |= R  # a skipped child never counts as done
    if wanted is None or limit is None:
        return found | DONE | (K if can_all_skip else 0)
    needed, fatal = threshold(wanted, count), threshold(limit, count)
    if needed == 0:
        return S
    suits = S | K if wanted < 0 else S
    failing = sum(1 for child in children if child & F)
    if sum(1 for child in children if child & suits) >= needed:
        found |= S
    if fatal == 0 or failing >= fatal or failing > count - needed:
        found |= F
    return found | (K if can_all_skip and wanted >= 0 else 0)


def _parallel_all(node: Node, children: Sequence[int]) -> int:
    either = _union(children)
    found = either & RUNS
    if all(child & K for child in children):
        found |= K
    if not either & DONE:
        return found
    limit = whole(node, "max_failures", 1)
    if limit is None:
        return found | DONE
    fatal = threshold(limit, len(children))
    if sum(1 for child in children if child & F) >= fatal:
        found |= F
    if sum(1 for child in children if child & F and not child & (S | K)) < fatal:
        found |= S
    return found


def _if_then_else(_node: Node, children: Sequence[int]) -> int:
    condition, *branches = children
    found = condition & RUNS
    if condition & S and branches:
        found |= branches[0]
    if condition & F:
        found |= branches[1] if len(branches) > 1 else F
    return found


def _switch(_node: Node, children: Sequence[int]) -> int:
    return _union(children)


def _try_catch(_node: Node, children: Sequence[int]) -> int:
    *tried, caught = children
    found = ordered(tried, S, F)
    return found | (caught & RUNS if found & F else 0)


def _union(children: Sequence[int]) -> int:
    found = 0
    for child in children:
        found |= child
    return found


RULES: Final[dict[str, Callable[[Node, Sequence[int]], int]]] = {
    **dict.fromkeys(SEQUENCES, _sequence),
    **dict.fromkeys(FALLBACKS, _fallback),
    "Parallel": _parallel,
    "ParallelAll": _parallel_all,
    **dict.fromkeys(RESTING, _if_then_else),
    **{f"Switch{cases}": _switch for cases in range(2, 7)},
    "TryCatch": _try_catch,
}
LEAST: Final = {**dict.fromkeys(RESTING, 2), "TryCatch": 2}
"""The nodes that need more than one child; with fewer, they are an error, and nothing is known."""


def of_control(node: Node, children: Sequence[int]) -> int | None:
    """Returns the set of a built-in control node; None for another node."""
    rule = RULES.get(node.type)
    if rule is None:
        return None
    return rule(node, children) if len(children) >= LEAST.get(node.type, 1) else ALL
