"""The outcome of one run, as one line of `runs.jsonl`."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tree_gardener import Tree
    from tree_gardener.hooks import ResultCount

SUCCESS: Final = "success"
FAILURE: Final = "failure"
ERROR: Final = "error"
CRASHED: Final = "crashed"
TIMEOUT: Final = "timeout"
INVALID: Final = "invalid"
LOST: Final = "lost"
CANCELLED: Final = "cancelled"

COUNTED: Final = (SUCCESS, FAILURE, ERROR, CRASHED, TIMEOUT)
"""Outcomes that count in the rate."""
NOT_COUNTED: Final = (INVALID, LOST, CANCELLED)
"""Outcomes that say nothing of the project; an evaluation with one of them is incomplete."""
_LETTERS: Final = (("S", "success"), ("F", "failure"), ("R", "running"), ("K", "skipped"))
OUTCOMES: Final = (*COUNTED, *NOT_COUNTED)


@dataclass(frozen=True)
class Outcome:
    """The outcome of one run, without wall-clock time or name of the machine, so that equal runs are equal.

    Attributes:
        seed: the seed.
        outcome: one of `OUTCOMES`.
        why: the item or the error that decided it.
        end_s: the simulated time of the decision.
        items: the outcome of each item of the judge.
        measures: the measures that are defined for this run.
        drawn: the drawn values by address.
        faults: the faults that happened, with their times.
        path: [t, x, y] of the robot, at most about 200 of them.
        bumps: [t, x, y, id] of its collisions.
        seen: the results of each node of the tree by its path, in letters: S, F, R, and K for skipped.
    """

    seed: int
    outcome: str
    why: str = ""
    end_s: float = 0.0
    items: list[dict[str, Any]] = field(default_factory=list)
    measures: dict[str, float] = field(default_factory=dict)
    drawn: dict[str, Any] = field(default_factory=dict)
    faults: list[dict[str, Any]] = field(default_factory=list)
    path: list[list[float]] = field(default_factory=list)
    bumps: list[list[Any]] = field(default_factory=list)
    seen: dict[str, str] = field(default_factory=dict)

    @property
    def is_counted(self) -> bool:
        """Whether the run counts in the rate."""
        return self.outcome in COUNTED

    @property
    def is_success(self) -> bool:
        """Whether the run succeeded."""
        return self.outcome == SUCCESS

    def to_line(self) -> str:
        """Returns the outcome as one line of JSON, without the line feed."""
        return json.dumps(asdict(self), ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def letters_of(tree: Tree, counts: Sequence[ResultCount]) -> dict[str, str]:
    """Returns the results of each node of a tree by its path, as `Outcome.seen` has them."""
    return {
        node.path: "".join(letter for letter, name in _LETTERS if getattr(count, name))
        for node, count in zip(tree.nodes, counts, strict=True)
    }


def read_outcome(line: str | bytes) -> Outcome:
    """Returns the outcome of a line.

    Raises:
        ValueError: the line is no outcome.
    """
    document = json.loads(line)
    try:
        found = Outcome(**document)
    except TypeError as error:
        raise ValueError("this is no outcome of a run") from error
    if found.outcome not in OUTCOMES or isinstance(found.seed, bool) or not isinstance(found.seed, int):
        raise ValueError("this is no outcome of a run")
    return found
