"""Where a step ends. Pure: it knows the shape of the tree and the events, and no node."""

import dataclasses
import enum
from collections.abc import Sequence
from typing import Final

from tree_gardener.node import Node


class Event(enum.Enum):
    """An event at a node; the tree can be held there."""

    BEFORE = "before"
    AFTER = "after"
    DECIDED = "decided"
    HALTED = "halted"


class Step(enum.Enum):
    """A way to continue after a stop."""

    CONTINUE = "continue"
    INTO = "into"
    OVER = "over"
    OUT = "out"
    TICK = "tick"
    TO = "to"
    HOLD = "hold"


@dataclasses.dataclass(frozen=True)
class Shape:
    """The shape of a tree, by uid, from 1 in pre-order.

    Attributes:
        last: the last uid in the subtree of each node; item 0 stands above the root.
        parents: the uid of the parent of each node; 0 for the root.
    """

    last: tuple[int, ...]
    parents: tuple[int, ...]

    @classmethod
    def of(cls, nodes: Sequence[Node]) -> "Shape":
        """Returns the shape of a tree, given its nodes in pre-order."""
        parents = [0, *(node.parent.uid if node.parent is not None else 0 for node in nodes)]
        last = list(range(len(parents)))
        for uid in range(len(nodes), 0, -1):
            last[parents[uid]] = max(last[parents[uid]], last[uid])
        return cls(tuple(last), tuple(parents))

    def is_below(self, uid: int, above: int) -> bool:
        """Returns whether a node is somewhere below another one."""
        return above < uid <= self.last[above]


class Stepper:
    """Decides at which event the step in progress ends.

    A step over or out of a node also ends where the node is left without a result, by an exception or a halt:
    at the first event that is not below it.

    Attributes:
        step: the step in progress; CONTINUE when there is none.
    """

    def __init__(self, shape: Shape) -> None:
        self.shape = shape
        self.step = Step.CONTINUE
        self._from = 0
        self._tick = 0

    @property
    def is_stepping(self) -> bool:
        """Whether a step is in progress."""
        return self.step is not Step.CONTINUE

    def hold(self) -> None:
        """Ends at the next event."""
        self.step = Step.HOLD

    def begin(self, step: Step, event: Event | None, uid: int, tick: int, target: int = 0) -> None:
        """Begins a step.

        Args:
            step: what to do.
            event: where the tree is held; None if it is held between two ticks.
            uid: the node there.
            tick: the number of the tick in progress, or of the last one.
            target: the node for TO.
        """
        self._tick = tick
        self.step = step
        if step is Step.TO:
            self._from = target
        elif event is None and step in (Step.OVER, Step.OUT):
            self.step = Step.TICK
        elif step is Step.OUT:
            self._from = self.shape.parents[uid]
        elif step is Step.OVER and event is not Event.BEFORE:
            self.step = Step.INTO  # the node is done: what is next is not below it
        else:
            self._from = uid

    def end(self) -> None:
        """Ends the step in progress."""
        self.step = Step.CONTINUE

    def reason(self, event: Event, uid: int, tick: int) -> str:
        """Returns why the step ends at an event; "" if it does not."""
        is_start = event is Event.BEFORE
        ends = {
            Step.CONTINUE: False,
            Step.HOLD: True,
            Step.INTO: True,
            Step.TICK: is_start and tick > self._tick,
            Step.TO: is_start and uid == self._from,
            Step.OVER: tick > self._tick or not self.shape.is_below(uid, self._from),
            Step.OUT: tick > self._tick or not self.shape.is_below(uid, self._from),
        }
        return _REASONS[self.step] if ends[self.step] else ""


_REASONS: Final = {
    Step.HOLD: "a hold was requested",
    Step.INTO: "step",
    Step.TICK: "one tick",
    Step.TO: "step to this node",
    Step.OVER: "step over",
    Step.OUT: "step out",
}
