"""The five statuses of a node, and their relation to the four of py_trees."""

import enum

from py_trees.common import Status as PyTreesStatus


class Status(enum.Enum):
    """The status of a node, or the result of its tick.

    A node *is* IDLE, RUNNING, SUCCESS or FAILURE; SKIPPED is only ever returned.
    """

    IDLE = "IDLE"
    RUNNING = "RUNNING"
    SUCCESS = "SUCCESS"
    FAILURE = "FAILURE"
    SKIPPED = "SKIPPED"

    # Enum's own hash runs Python code on the name, which is ten times slower than identity.
    __hash__ = object.__hash__

    @property
    def letter(self) -> str:
        """One letter: I, R, S, F, or K for SKIPPED, as in the traces of the conformance cases."""
        return _LETTERS[self]

    @property
    def number(self) -> int:
        """The number of the status in BehaviorTree.CPP, by which scripts know it."""
        return _NUMBERS[self]

    @property
    def is_completed(self) -> bool:
        """Whether the status is SUCCESS or FAILURE."""
        return self is Status.SUCCESS or self is Status.FAILURE


IDLE = Status.IDLE
RUNNING = Status.RUNNING
SUCCESS = Status.SUCCESS
FAILURE = Status.FAILURE
SKIPPED = Status.SKIPPED

_LETTERS = {IDLE: "I", RUNNING: "R", SUCCESS: "S", FAILURE: "F", SKIPPED: "K"}

_NUMBERS = {status: number for number, status in enumerate(Status)}

_TO_PY_TREES = {
    IDLE: PyTreesStatus.INVALID,
    RUNNING: PyTreesStatus.RUNNING,
    SUCCESS: PyTreesStatus.SUCCESS,
    FAILURE: PyTreesStatus.FAILURE,
    SKIPPED: PyTreesStatus.INVALID,
}


def to_py_trees(status: Status) -> PyTreesStatus:
    """Returns the nearest status of py_trees; it has neither IDLE nor SKIPPED, so both are INVALID."""
    return _TO_PY_TREES[status]
