"""The results of the built-in decorators, by the rules of BehaviorTree.CPP 4.10."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from translator.check.results.sets import (
    ALL,
    DONE,
    FALSE,
    NAMES,
    RUNS,
    TRUE,
    YIELDS,
    F,
    K,
    R,
    S,
    literal,
    whole,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from translator.tree import Node


def _inverter(_node: Node, child: int) -> int:
    return child & ~DONE | (F if child & S else 0) | (S if child & F else 0)


def _force_success(_node: Node, child: int) -> int:
    return child & ~DONE | (S if child & DONE else 0)


def _force_failure(_node: Node, child: int) -> int:
    return child & ~DONE | (F if child & DONE else 0)


def _counting(port: str, counted: int) -> Callable[[Node, int], int]:
    """Returns the rule of Repeat (`counted` SUCCESS) or RetryUntilSuccessful (FAILURE)."""

    def rule(node: Node, child: int) -> int:
        times = whole(node, port)
        if times is not None and (times == 0 or times < -1):
            return counted
        found = child & ~counted
        if child & counted and times != 1:
            found |= YIELDS  # between two cycles it wakes the tree up
        if times is None:
            found |= counted  # 0 ends without a tick of the child
        elif times > 0:
            found |= child & counted
        return found

    return rule


def _keep_running(_node: Node, child: int) -> int:
    return child & (F | RUNS) | (R if child & (S | K) else 0)


def _run_once(node: Node, child: int) -> int:
    text = literal(node, "then_skip", "true")
    return child if text is not None and text.lower() in FALSE else child | (K if child & DONE else 0)


def _result(node: Node, port: str, default: str) -> int:
    """Returns the set of a port that holds a result; all results if it names an entry."""
    text = literal(node, port, default)
    return ALL if text is None else NAMES.get(text.strip(), ALL)


def _precondition(node: Node, child: int) -> int:
    code = (literal(node, "if") or "").strip()
    if code in TRUE:
        return child
    otherwise = _result(node, "else", "FAILURE")
    return otherwise if code in FALSE else child | otherwise


def _loop(node: Node, child: int) -> int:
    return child & (F | RUNS) | (R if child & (S | K) else 0) | _result(node, "if_empty", "SUCCESS")


def _delay(_node: Node, child: int) -> int:
    return child | R


def _timeout(node: Node, child: int) -> int:
    limit = whole(node, "msec")
    # A skipped control node rests in RUNNING, so that the time runs out for it too.
    return child | F if (limit is None or limit > 0) and child & (RUNS | K) else child


RULES: Final[dict[str, Callable[[Node, int], int]]] = {
    "Inverter": _inverter,
    "ForceSuccess": _force_success,
    "ForceFailure": _force_failure,
    "Repeat": _counting("num_cycles", S),
    "RetryUntilSuccessful": _counting("num_attempts", F),
    "KeepRunningUntilFailure": _keep_running,
    "RunOnce": _run_once,
    "Precondition": _precondition,
    **dict.fromkeys(("LoopInt", "LoopDouble", "LoopString", "LoopBool"), _loop),
    "SkipUnlessUpdated": lambda _node, child: child | K,
    "WaitValueUpdate": _delay,
    "Delay": _delay,
    "Timeout": _timeout,
}


def of_decorator(node: Node, child: int) -> int | None:
    """Returns the set of a built-in decorator; None for another node."""
    rule = RULES.get(node.type)
    return None if rule is None else rule(node, child)
