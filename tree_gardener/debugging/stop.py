"""A place at which a tree is held within a tick."""

import dataclasses

from tree_gardener.debugging.stepper import Event
from tree_gardener.status import Status


@dataclasses.dataclass(frozen=True)
class Stop:
    """Where and why a tree is held.

    Attributes:
        event: what happens at the node.
        uid: the node's uid.
        path: the node's path.
        tick: the number of the tick.
        status: the node's result, after its tick or a decision; else None.
        decided: the pre-condition that decided the result, such as ``_skipIf``, or "".
        why: the breakpoint, the step or the request that led to the stop, in words.
        lead: the uids of the nodes from the root to this one.
        ahead: the uids of the nodes that may still be ticked in this tick, in pre-order.
    """

    event: Event
    uid: int
    path: str
    tick: int
    status: Status | None
    decided: str
    why: str
    lead: tuple[int, ...]
    ahead: tuple[int, ...]

    @property
    def what(self) -> str:
        """The event, in words."""
        if self.event is Event.BEFORE:
            return "before its tick"
        if self.event is Event.HALTED:
            return "it was halted"
        result = self.status.name if self.status is not None else ""
        if self.event is Event.DECIDED:
            return f"{self.decided} decided {result}"
        return f"it returned {result}"
