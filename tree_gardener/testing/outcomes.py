"""The results that each node of a tree can return, and whether it can be halted, by the rules of the nodes.

Coverage is measured against this set: a result that cannot occur is not missing.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Final

from tree_gardener.controls.custom import CustomControl
from tree_gardener.leaves.behaviour import BehaviourLeaf, ImmediateLeaf
from tree_gardener.node import Node
from tree_gardener.status import FAILURE, RUNNING, SKIPPED, SUCCESS, Status

Outcomes = frozenset[Status]

_NONE: Final[Outcomes] = frozenset()
_ALL: Final[Outcomes] = frozenset((SUCCESS, FAILURE, RUNNING))
_DONE: Final[Outcomes] = frozenset((SUCCESS, FAILURE))
_LEAVES: Final[Mapping[str, Outcomes]] = {
    "AlwaysSuccess": frozenset((SUCCESS,)),
    "AlwaysFailure": frozenset((FAILURE,)),
    "Script": frozenset((SUCCESS,)),
    "SetBlackboard": frozenset((SUCCESS,)),
    "UnsetBlackboard": frozenset((SUCCESS,)),
    "ScriptCondition": _DONE,
    "WasEntryUpdated": _DONE,
    "Sleep": frozenset((RUNNING, SUCCESS)),
}
_REACTIVE: Final = {"ReactiveSequence", "ReactiveFallback"}


def outcomes(nodes: Sequence[Node], returns: Mapping[str, frozenset[str]]) -> list[Outcomes]:
    """Returns the possible results of each node, in the order of the nodes.

    Args:
        nodes: all nodes of a tree in pre-order.
        returns: the results of leaves by type, where they are known.
    """
    found: list[Outcomes] = [_NONE] * len(nodes)
    for node in reversed(nodes):
        below = [found[child.uid - 1] for child in node.children]
        found[node.uid - 1] = _guarded(node, _of(node, below, returns))
    return found


def haltable(nodes: Sequence[Node], possible: Sequence[Outcomes]) -> list[bool]:
    """Returns for each node whether it can be halted while it is RUNNING."""
    found = [False] * len(nodes)
    from_above = [False] * len(nodes)
    for node in nodes:
        at = node.uid - 1
        guarded = "_while" in node.attributes
        parent = node.parent
        if parent is not None:
            index = parent.children.index(node)
            from_above[at] = from_above[parent.uid - 1] or _halts(parent, index)
            from_above[at] |= "_while" in parent.attributes
        found[at] = RUNNING in possible[at] and (guarded or from_above[at])
    return found


def _halts(parent: Node, index: int) -> bool:
    """Returns whether a node can halt its RUNNING child by its own rule."""
    kind, many = parent.type, len(parent.children) > 1
    if kind in _REACTIVE or kind == "WhileDoElse":
        return index > 0
    if kind.startswith("Switch") or kind == "Parallel":
        return many
    return kind == "Timeout" or isinstance(parent, CustomControl)


def _guarded(node: Node, own: Outcomes) -> Outcomes:
    attributes = node.attributes
    added = {
        result
        for name, result in (
            ("_failureIf", FAILURE),
            ("_successIf", SUCCESS),
            ("_skipIf", SKIPPED),
            ("_while", SKIPPED),
        )
        if name in attributes
    }
    return own | added


def _of(node: Node, below: list[Outcomes], returns: Mapping[str, frozenset[str]]) -> Outcomes:
    kind = node.type
    if isinstance(node, BehaviourLeaf):
        return _of_leaf(node, returns.get(kind))
    if not below:
        return _LEAVES.get(kind, _ALL)
    if len(below) == 1 and (rule := _DECORATORS.get(kind)) is not None:
        return rule(node, below[0])
    control = _SWITCH if kind.startswith("Switch") else _CONTROLS.get(kind)
    return control(below) if control is not None else _ALL


def _of_leaf(node: BehaviourLeaf, known: frozenset[str] | None) -> Outcomes:
    if known:
        return frozenset(Status[name] for name in known)
    return _DONE if isinstance(node, ImmediateLeaf) else _ALL


def _in_order(below: list[Outcomes], passing: Status, ending: Status, *, yields: bool) -> Outcomes:
    """Returns the results of a node that ticks its children until one of them does not pass."""
    found: set[Status] = set()
    for index, each in enumerate(below):
        found |= each & {ending, RUNNING}
        if yields and passing in each and index + 1 < len(below):
            found.add(RUNNING)
        if not each & {passing, SKIPPED}:
            return frozenset(found)
    if any(passing in each for each in below):
        found.add(passing)
    if all(SKIPPED in each for each in below):
        found.add(SKIPPED)
    return frozenset(found)


def _if(below: list[Outcomes]) -> Outcomes:
    found = set(below[0] & {RUNNING})
    if SUCCESS in below[0] and len(below) > 1:
        found |= below[1]
    if FAILURE in below[0]:
        found |= below[2] if len(below) > 2 else {FAILURE}
    return frozenset(found)


def _try(below: list[Outcomes]) -> Outcomes:
    tried = _in_order(below[:-1], SUCCESS, FAILURE, yields=False)
    return tried | (below[-1] & {RUNNING}) if FAILURE in tried else tried


def _parallel(below: list[Outcomes]) -> Outcomes:
    union = _NONE.union(*below)
    return union if all(SKIPPED in each for each in below) else union - {SKIPPED}


def _ordered(
    passing: Status, ending: Status, *, yields: bool = False
) -> Callable[[list[Outcomes]], Outcomes]:
    return lambda below: _in_order(below, passing, ending, yields=yields)


def _inverted(_: Node, below: Outcomes) -> Outcomes:
    swap = {SUCCESS: FAILURE, FAILURE: SUCCESS}
    return frozenset(swap.get(status, status) for status in below)


def _forced(to: Status) -> Callable[[Node, Outcomes], Outcomes]:
    def rule(_: Node, below: Outcomes) -> Outcomes:
        return (below - _DONE) | ({to} if below & _DONE else set())

    return rule


def _repeated(port: str, counted: Status) -> Callable[[Node, Outcomes], Outcomes]:
    """Returns the rule of Repeat and RetryUntilSuccessful: `counted` results start another cycle."""

    def rule(node: Node, below: Outcomes) -> Outcomes:
        cycles = node.ports.get(port, "")
        if cycles == "0":
            return frozenset((SUCCESS if counted is SUCCESS else FAILURE,))
        found = set(below)
        if counted in below and cycles != "1":
            found.add(RUNNING)
        if cycles == "-1":
            found.discard(counted)
        return frozenset(found)

    return rule


def _keep_running(_: Node, below: Outcomes) -> Outcomes:
    return (below & {FAILURE}) | ({RUNNING} if below - {FAILURE} else set())


def _run_once(node: Node, below: Outcomes) -> Outcomes:
    return below if node.ports.get("then_skip", "true").lower() in ("false", "0") else below | {SKIPPED}


def _precondition(node: Node, below: Outcomes) -> Outcomes:
    other = node.ports.get("else", "FAILURE")
    return below | ({Status[other]} if other in Status.__members__ else _ALL)


def _looped(node: Node, below: Outcomes) -> Outcomes:
    other = node.ports.get("if_empty", "SUCCESS")
    return (
        frozenset((RUNNING,))
        | (below & {FAILURE})
        | ({Status[other]} if other in Status.__members__ else _ALL)
    )


def _with(*more: Status) -> Callable[[Node, Outcomes], Outcomes]:
    return lambda _, below: below | set(more)


def _timeout(node: Node, below: Outcomes) -> Outcomes:
    return below if node.ports.get("msec") == "0" or RUNNING not in below else below | {FAILURE}


_DECORATORS: Final[Mapping[str, Callable[[Node, Outcomes], Outcomes]]] = {
    "Inverter": _inverted,
    "ForceSuccess": _forced(SUCCESS),
    "ForceFailure": _forced(FAILURE),
    "Repeat": _repeated("num_cycles", SUCCESS),
    "RetryUntilSuccessful": _repeated("num_attempts", FAILURE),
    "KeepRunningUntilFailure": _keep_running,
    "RunOnce": _run_once,
    "Precondition": _precondition,
    "SkipUnlessUpdated": _with(SKIPPED),
    "WaitValueUpdate": _with(RUNNING),
    "Delay": _with(RUNNING),
    "Timeout": _timeout,
    **{f"Loop{kind}": _looped for kind in ("Int", "Double", "String", "Bool")},
}


def _any_of(below: list[Outcomes]) -> Outcomes:
    return _NONE.union(*below)


_SWITCH: Final = _any_of
_CONTROLS: Final[Mapping[str, Callable[[list[Outcomes]], Outcomes]]] = {
    "Sequence": _ordered(SUCCESS, FAILURE),
    "ReactiveSequence": _ordered(SUCCESS, FAILURE),
    "AsyncSequence": _ordered(SUCCESS, FAILURE, yields=True),
    "SequenceWithMemory": _ordered(SUCCESS, FAILURE, yields=True),
    "Fallback": _ordered(FAILURE, SUCCESS),
    "ReactiveFallback": _ordered(FAILURE, SUCCESS),
    "AsyncFallback": _ordered(FAILURE, SUCCESS, yields=True),
    "Parallel": _parallel,
    "ParallelAll": _parallel,
    "IfThenElse": _if,
    "WhileDoElse": _if,
    "TryCatch": _try,
    "SubTree": _any_of,
}
