import collections
from typing import Any

from tree_gardener.blackboard import EMPTY
from tree_gardener.errors import TickError
from tree_gardener.node import Decorator
from tree_gardener.ports import pointer_key
from tree_gardener.status import FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, Status
from tree_gardener.type_words import type_words
from tree_gardener.values import ConversionError


class Loop(Decorator):
    """Ticks its child once for each element of a queue.

    When the child is not RUNNING, one element is taken from `queue` and written to `value`; then the child is
    ticked. A FAILURE of the child ends the loop; after all other results the loop returns RUNNING. When the
    queue is empty, at the tick after the last element, the loop returns `if_empty`. A constant queue is
    copied when the loop starts, and so are lists and texts on the blackboard; a ``collections.deque`` on the
    blackboard is consumed in place.
    """

    __slots__ = ("busy", "queue", "ticked")
    NEEDS = "queue"

    def prepare(self) -> None:
        super().prepare()
        self.busy = False
        self.ticked = False
        self.queue: collections.deque[Any] = collections.deque()

    def execute(self) -> Status:
        starts = self.status is IDLE
        self.ticked = False
        if starts:
            self.busy = False
        if not self.busy:
            self.refill(starts)
            if not self.queue:
                return self.empty()
            element = self.queue.popleft()
            if "value" in self.ports:
                self.put("value", element)
        if self.status is not RUNNING:
            self.start()
        self.ticked = True
        tick = self.tick_child
        status = tick()
        self.busy = status is RUNNING
        if status is FAILURE:
            return self.finish(FAILURE)
        if status is SUCCESS:
            self.reset()
        return RUNNING

    def status_within(self, before: Status) -> Status:
        return RUNNING if self.ticked else before

    def refill(self, starts: bool) -> None:  # noqa: FBT001 - private to this rule
        """Sets the queue from which the next element is taken."""
        text = self.ports.get("queue", "")
        key = pointer_key(text, "queue")
        if key is None:
            if starts:
                self.queue = collections.deque(self.get("queue"))
            return
        entry = self.board.find(key)
        if entry is None or entry.value is EMPTY:
            raise TickError(self, f"port 'queue': the entry '{key}' has no value")
        assert self.manifest is not None
        kind = self.manifest["queue"].type
        if entry.is_strong and entry.type_name != kind.name and not isinstance(entry.value, str):
            held, wanted = type_words(entry.type_name), type_words(kind.name)
            message = f"port 'queue': the entry '{key}' holds {held}, not {wanted}"
            raise TickError(self, message)
        if isinstance(entry.value, collections.deque):
            self.queue = entry.value
            if self.queue and self.board.journal is not None:
                self.board.journal(entry, self.uid)
        elif starts:
            try:
                self.queue = collections.deque(kind.convert(entry.value))
            except ConversionError as error:
                raise TickError(self, f"port 'queue': the entry '{key}': {error}") from None

    def empty(self) -> Status:
        """Ends the loop, since no element is left."""
        result: Status = self.get("if_empty")
        if result is SUCCESS or result is FAILURE:
            # A child that was skipped in the middle of its work is not halted here, as in BehaviorTree.CPP.
            return self.complete(result)
        if result is SKIPPED:
            return self.skipped()
        if result is IDLE:
            raise TickError(self, "'if_empty' is IDLE, which is no result")
        if self.status is not RUNNING:
            self.start()
        return RUNNING
