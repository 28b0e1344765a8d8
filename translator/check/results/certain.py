"""Finds the results of a node that imply that a given child was ticked, from the child upwards.

`certain` is a set of results of the child for which the tick is certain; a result that the child cannot
return counts as certain.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from translator.check.results.controls import ASYNC, FALLBACKS, SEQUENCES
from translator.check.results.nav2 import CONTROLS as NAV2
from translator.check.results.sets import ALL, DONE, FALSE, RUNS, YIELDS, F, K, R, S, whole

if TYPE_CHECKING:
    from collections.abc import Sequence

    from translator.tree import Node

EVERY: Final = ALL | YIELDS
_LOOPS: Final = {"Repeat": "num_cycles", "RetryUntilSuccessful": "num_attempts"}
_ALWAYS: Final = frozenset({"KeepRunningUntilFailure", "RunOnce", "Timeout"})
"""Decorators whose first tick ticks the child."""
_FIRST: Final = frozenset(
    {"IfThenElse", "WhileDoElse", "TryCatch", "Parallel", "PipelineSequence", "RecoveryNode"}
)
"""Nodes whose first tick ticks their first child."""
_GUARDS: Final = (("_failureIf", F), ("_successIf", S), ("_skipIf", K), ("_while", K))


def is_understood(node: Node, *, is_library: bool) -> bool:
    """Returns whether the rules below hold for a node: those of Nav2 only for nodes of the library."""
    return node.type not in NAV2 or is_library


def first_guard(node: Node) -> str:
    """Returns the pre-condition of a node that is tested first, or ""."""
    return next((name for name, _ in _GUARDS if name in node.conditions), "")


def guarded(node: Node, certain: int) -> int:
    """Returns the results for which a node itself was ticked: its pre-conditions may decide without that."""
    if node.disabled:
        return 0
    for name, result in _GUARDS:
        if node.conditions.get(name, "false").strip() not in FALSE:
            certain &= ~result
    return certain


def lifted(  # noqa: PLR0911 - one for each rule
    node: Node, index: int, children: Sequence[int], certain: int
) -> int:
    """Returns the results of a node for which a tick of its child at `index` is certain.

    `children` are the results that the children can return; `certain` are those of that child.
    """
    type_ = node.type
    surely = EVERY & (certain | ~children[index])
    surely = surely & ~RUNS if (surely & RUNS) != RUNS else surely
    if type_ in SEQUENCES or type_ in FALLBACKS:
        return _ordered(node, index, children, surely)
    if type_ == "Inverter":
        return surely & ~DONE | (F if surely & S else 0) | (S if surely & F else 0)
    if type_ in {"ForceSuccess", "ForceFailure"}:
        return surely if surely & DONE == DONE else surely & ~DONE
    if type_ == "Delay":
        return surely & ~RUNS
    is_whole = surely == EVERY
    if type_ in _LOOPS:
        times = whole(node, _LOOPS[type_])
        return EVERY if is_whole and times is not None and (times > 0 or times == -1) else 0
    if (index == 0 and type_ in _ALWAYS | _FIRST) or type_ == "ParallelAll":
        return EVERY if is_whole else 0
    return 0


def _ordered(node: Node, index: int, children: Sequence[int], surely: int) -> int:
    goes_on, ends = (S, F) if node.type in SEQUENCES else (F, S)
    before = 0
    for child in children[:index]:
        before |= child
    passes = surely & (goes_on | K) == goes_on | K
    found = surely & K
    if passes:
        found |= goes_on  # it goes through to its end, over this child
    if passes and surely & ends and not before & ends:
        found |= ends
    yields = node.type in ASYNC and before & goes_on
    if passes and surely & RUNS and not before & RUNS and not yields:
        found |= RUNS
    return found


def needed(node: Node, index: int, later: int) -> int | None:  # noqa: PLR0911 - one for each rule
    """Returns the results of the child at `index` after which a later one can be ticked.

    None means that the later one can be ticked without the earlier one.
    """
    type_ = node.type
    if type_ in SEQUENCES:
        return S | K
    if type_ in FALLBACKS:
        return F | K
    if type_ in {"Parallel", "ParallelAll", "NonblockingSequence"}:
        return EVERY
    if type_ in {"IfThenElse", "WhileDoElse"}:
        return DONE if index == 0 else None
    if type_ == "TryCatch":
        if later < len(node.children) - 1:
            return S | K
        return S | F | K if index == 0 else None
    if type_ == "PipelineSequence":
        return S | K | R | YIELDS
    return F if type_ == "RecoveryNode" else None
