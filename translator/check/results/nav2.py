"""The results of the control nodes, decorators and leaves of Nav2, by the classes in `tree_gardener.nav2`.

The rules hold for a project's node only if its source is that of the library; a changed one is like any other
node of the project.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Final

from translator.check.results.controls import ordered
from translator.check.results.sets import ALL, DONE, RUNS, F, K, R, S
from translator.nav2.distributions import new_node
from translator.nav2.sources import nav2_source, sources

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from translator.action import ActionModel


def _nonblocking(children: Sequence[int]) -> int:
    found = S if all(child & S for child in children) else 0
    for child in children:
        found |= child & (F | RUNS)
    return found


def _persistent(children: Sequence[int]) -> int:
    found = S  # its position is in an entry, which may be behind the last child
    for child in children:
        found |= child & (F | RUNS)
    return found


def _pipeline(children: Sequence[int]) -> int:
    # A child before the furthest one may be RUNNING again; the next is ticked all the same.
    passing = [child | (S if child & RUNS else 0) for child in children[:-1]]
    return ordered([*passing, children[-1]], S, F)


def _recovery(children: Sequence[int]) -> int:
    main = children[0]
    recovers = main & F and len(children) > 1
    return main | (children[1] & RUNS if recovers else 0)


def _round_robin(children: Sequence[int]) -> int:
    found = 0
    for child in children:
        found |= child & (S | RUNS)
        found |= F if child & (DONE | K) else 0
    return found | (K if all(child & K for child in children) else 0)


CONTROLS: Final[dict[str, Callable[[Sequence[int]], int]]] = {
    "NonblockingSequence": _nonblocking,
    "PersistentSequence": _persistent,
    "PipelineSequence": _pipeline,
    "RecoveryNode": _recovery,
    "RoundRobin": _round_robin,
    "PauseResumeController": lambda _children: DONE | R,
}
ADDED: Final = {
    "DistanceController": F | R,
    "GoalUpdatedController": R,
    "GoalUpdater": 0,
    "PathLongerOnApproach": S,
    "RateController": R,
    "SingleTrigger": F,
    "SpeedController": R,
}
"""What a decorator can return apart from the results of its child."""
_SERVED: Final = ("(Nav2Action)", "(Nav2Service)", "(Nav2Cancel)", "(Nav2Costs)")


@cache
def _library(type_: str) -> str:
    return nav2_source(new_node(type_)) or ""


def is_of_library(action: ActionModel) -> bool:
    """Returns whether an action's source is that of Nav2's node of this name in some distribution."""
    return action.source.strip() in sources(action.name)


def of_nav2(type_: str, children: Sequence[int]) -> int | None:
    """Returns the set of a node of Nav2's library; None if its Python decides the results."""
    if (rule := CONTROLS.get(type_)) is not None:
        return rule(children) if children else ALL
    if (added := ADDED.get(type_)) is not None:
        return children[0] | added if children else ALL
    return DONE | R if any(base in _library(type_) for base in _SERVED) else None
