from tree_gardener.node import Decorator
from tree_gardener.status import FAILURE, IDLE, RUNNING, SUCCESS, Status


class _Counting(Decorator):
    """Ticks its child again after one of its results, up to a number of times."""

    __slots__ = ("count",)

    def prepare(self) -> None:
        super().prepare()
        self.count = 0

    def halt(self) -> None:
        self.count = 0
        super().halt()

    def end(self, status: Status) -> Status:
        """Handles the child's result that is counted."""
        self.count = 0
        return self.finish(status)

    def exhausted(self, status: Status) -> Status:
        """Ends without resetting the child.

        It was reset already, or keeps its status as in BehaviorTree.CPP.
        """
        self.count = 0
        return self.complete(status)

    def child_skipped(self) -> Status:
        """Resets a skipped child and keeps the count."""
        self.reset()
        return self.skipped()


class Repeat(_Counting):
    """Ticks its child again each time it succeeds, `num_cycles` times.

    -1 repeats endlessly, 0 succeeds immediately. Between two cycles the node wakes the tree up and returns
    RUNNING if the child succeeded within one tick; a child that was RUNNING before starts its next cycle in
    the same tick. A failure of the child ends the node. A skipped child makes the node SKIPPED and keeps the
    count. The port is read at every tick.
    """

    __slots__ = ()

    def execute(self) -> Status:
        cycles = self.get("num_cycles")
        if self.status is not RUNNING:
            self.start()
        while self.count < cycles or cycles == -1:
            before = self.child.status
            tick = self.tick_child
            status = tick()
            if status is RUNNING:
                return RUNNING
            if status is FAILURE:
                return self.end(FAILURE)
            if status is not SUCCESS:
                return self.child_skipped()
            self.count += 1
            self.reset()
            if before is IDLE and (self.count < cycles or cycles == -1):
                self.tree.wake_up = True
                return RUNNING
        return self.exhausted(SUCCESS)


class RetryUntilSuccessful(_Counting):
    """Ticks its child again each time it fails, `num_attempts` times.

    -1 retries endlessly, 0 fails immediately. Between two attempts the node wakes the tree up and returns
    RUNNING if the child failed within one tick; a child that was RUNNING before starts its next attempt in
    the same tick. A success of the child ends the node. A skipped child makes the node SKIPPED and keeps the
    count. The port is read at every tick and after every failure.
    """

    __slots__ = ()

    def execute(self) -> Status:
        attempts = self.get("num_attempts")
        if self.status is not RUNNING:
            self.start()
        while self.count < attempts or attempts == -1:
            before = self.child.status
            tick = self.tick_child
            status = tick()
            if status is RUNNING:
                return RUNNING
            if status is SUCCESS:
                return self.end(SUCCESS)
            if status is not FAILURE:
                return self.child_skipped()
            self.count += 1
            attempts = self.get_or("num_attempts", attempts)
            self.reset()
            if before is IDLE and (self.count < attempts or attempts == -1):
                self.tree.wake_up = True
                return RUNNING
        return self.exhausted(FAILURE)
