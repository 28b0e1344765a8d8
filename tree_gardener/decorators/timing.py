from typing import TYPE_CHECKING

from tree_gardener.node import Decorator
from tree_gardener.status import FAILURE, RUNNING, SKIPPED, Status

if TYPE_CHECKING:
    from tree_gardener.clock import Timer


class Delay(Decorator):
    """Waits for `delay_msec` milliseconds, then ticks its child.

    It is RUNNING until the time is over, which wakes the tree up. A new delay begins after the child
    succeeded or failed, or after a halt, but not after the child was skipped.
    """

    __slots__ = ("is_over", "timer")

    def prepare(self) -> None:
        super().prepare()
        self.timer: Timer | None = None
        self.is_over = False

    def execute(self) -> Status:
        if self.timer is None:
            delay_s = self.get("delay_msec") / 1000.0
            self.is_over = False
            if self.status is not RUNNING:
                self.start()
            self.timer = self.tree.timers.start(delay_s, self.fire)
        elif self.status is not RUNNING:
            self.start()
        if not self.is_over:
            return RUNNING
        tick = self.tick_child
        status = tick()
        if status is RUNNING:
            return RUNNING
        if status is SKIPPED:
            return self.skipped()
        self.timer = None
        return self.finish(status)

    def fire(self) -> None:
        self.is_over = True
        self.tree.wake_up = True

    def halt(self) -> None:
        if self.timer is not None:
            self.timer.cancel()
            self.timer = None
        super().halt()


class Timeout(Decorator):
    """Halts its child and fails when it is RUNNING for longer than `msec` milliseconds; 0 means no limit.

    When the time is over a RUNNING child is halted immediately, the tree is woken up, and the next tick
    returns FAILURE. The time is measured from the first tick; a skipped child does not stop it.
    """

    __slots__ = ("expired", "started", "timer")

    def prepare(self) -> None:
        super().prepare()
        self.timer: Timer | None = None
        self.started = False
        self.expired = False

    def execute(self) -> Status:
        limit_s = self.get("msec") / 1000.0
        if not self.started:
            self.started = True
            self.expired = False
            if limit_s > 0:
                self.timer = self.tree.timers.start(limit_s, self.fire)
        if self.status is not RUNNING:
            self.start()
        if self.expired:
            self.started = False
            return self.finish(FAILURE)
        tick = self.tick_child
        status = tick()
        if status is RUNNING:
            return RUNNING
        if status is SKIPPED:
            return self.skipped()
        self.cancel()
        return self.finish(status)

    def fire(self) -> None:
        if self.child.status is RUNNING:
            self.expired = True
            self.reset()
            self.tree.wake_up = True

    def cancel(self) -> None:
        self.started = False
        if self.timer is not None:
            self.timer.cancel()
            self.timer = None

    def halt(self) -> None:
        self.cancel()
        super().halt()
