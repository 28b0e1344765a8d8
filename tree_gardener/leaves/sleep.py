from typing import TYPE_CHECKING

from tree_gardener.node import Leaf
from tree_gardener.status import IDLE, RUNNING, SUCCESS, Status

if TYPE_CHECKING:
    from tree_gardener.clock import Timer


class Sleep(Leaf):
    """Is RUNNING for `msec` milliseconds, then succeeds; 0 succeeds immediately."""

    __slots__ = ("is_over", "timer")

    def prepare(self) -> None:
        self.timer: Timer | None = None
        self.is_over = False

    def execute(self) -> Status:
        if self.status is RUNNING:
            return self.complete(SUCCESS) if self.is_over else RUNNING
        if self.status is not IDLE:
            return self.complete(self.status)  # kept: its parent may reset it in this tick
        delay_s = self.get("msec") / 1000.0
        if delay_s <= 0:
            return self.complete(SUCCESS)
        self.is_over = False
        self.timer = self.tree.timers.start(delay_s, self.fire)
        self.start()
        return RUNNING

    def fire(self) -> None:
        self.is_over = True
        self.tree.wake_up = True

    def halt(self) -> None:
        if self.timer is not None:
            self.timer.cancel()
            self.timer = None
        self.status = IDLE
