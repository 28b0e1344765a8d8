from typing import ClassVar

from tree_gardener.node import Decorator
from tree_gardener.ports import entry_key
from tree_gardener.status import FAILURE, RUNNING, SKIPPED, SUCCESS, Status


class _WhenUpdated(Decorator):
    """Ticks its child if an entry was written since the last test."""

    __slots__ = ("busy", "key", "seen")
    MARKS_RUNNING = ()
    NEEDS = READ_AT_LOAD = "entry"
    OTHERWISE: ClassVar[Status]

    def prepare(self) -> None:
        super().prepare()
        self.seen = 0
        self.busy = False
        self.key = entry_key(self.ports.get("entry", ""))

    def execute(self) -> Status:
        if not self.busy and not self.is_updated():
            if self.OTHERWISE is SKIPPED:
                return self.skipped()
            status = RUNNING
        else:
            tick = self.tick_child
            status = tick()
            self.busy = status is RUNNING
        if status is SUCCESS or status is FAILURE:
            return self.finish(status)
        if status is RUNNING:
            if self.status is not RUNNING:
                self.start()
            return RUNNING
        return self.skipped()

    def is_updated(self) -> bool:
        """Returns whether the entry was written since the last test."""
        entry = self.board.find(self.key)
        if entry is None:
            return False
        before, self.seen = self.seen, entry.sequence
        return before != entry.sequence

    def halt(self) -> None:
        self.busy = False
        super().halt()


class SkipUnlessUpdated(_WhenUpdated):
    """Is SKIPPED unless a blackboard entry was written since the last test.

    Any write counts, also of an equal value. A RUNNING child is ticked without another test.
    """

    __slots__ = ()
    OTHERWISE = SKIPPED


class WaitValueUpdate(_WhenUpdated):
    """Is RUNNING until a blackboard entry was written since the last test, then ticks its child.

    Any write counts, also of an equal value. A RUNNING child is ticked without another test.
    """

    __slots__ = ()
    OTHERWISE = RUNNING
