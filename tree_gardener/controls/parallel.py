from tree_gardener.errors import TickError
from tree_gardener.node import Control, Node
from tree_gardener.status import FAILURE, RUNNING, SKIPPED, SUCCESS, Status


class _Parallel(Control):
    """Ticks all children that are not done yet."""

    __slots__ = ("done", "failures", "successes")

    def prepare(self) -> None:
        super().prepare()
        self.forget()

    def forget(self) -> None:
        self.done: set[int] = set()
        self.successes = 0
        self.failures = 0

    def threshold(self, value: int) -> int:
        """Returns a count of children; a negative value counts from their number: -1 means all."""
        return value if value >= 0 else max(len(self.children) + value + 1, 0)

    def halt(self) -> None:
        self.forget()
        super().halt()


class Parallel(_Parallel):
    """Ticks all its children at every tick until enough of them succeeded or failed.

    After each child the node tests if `success_count` children have succeeded; then if that has become
    impossible, or exactly `failure_count` have failed. If so, it returns the result immediately: later
    children are not ticked, and all are reset. Negative counts are from the end: -1 means all. With a
    negative `success_count` children skipped in this tick count as successes. Children that are done are not
    ticked again. If all are skipped and the success threshold is not met, the node is SKIPPED. A threshold
    larger than the number of children is an error when the node is ticked.
    """

    __slots__ = ()

    def execute(self) -> Status:
        wanted, limit = self.get("success_count"), self.get("failure_count")
        needed, fatal = self.threshold(wanted), self.threshold(limit)
        count = len(self.ticks)
        if count < needed:
            raise TickError(self, f"success_count is {needed}, but there are only {count} children")
        if count < fatal:
            raise TickError(self, f"failure_count is {fatal}, but there are only {count} children")
        if self.status is not RUNNING:
            self.start()
        skips = 0
        undecided = False
        done = self.done
        for index, tick in enumerate(self.ticks):
            if index not in done:
                status = tick()
                if status is SUCCESS:
                    done.add(index)
                    self.successes += 1
                elif status is FAILURE:
                    done.add(index)
                    self.failures += 1
                elif status is SKIPPED:
                    skips += 1
                elif undecided:
                    continue
            elif undecided:
                continue
            if self.successes >= needed or (wanted < 0 and self.successes + skips >= needed):
                self.forget()
                return self.finish(SUCCESS)
            if count - self.failures < needed or self.failures == fatal:
                self.forget()
                return self.finish(FAILURE)
            undecided = True
        if skips == count:
            return self.skipped()
        return RUNNING


class ParallelAll(_Parallel):
    """Ticks all its children until every one is done, then decides.

    Every child that is not done is ticked at every tick. When each child is done or was skipped in this tick,
    the node fails if at least `max_failures` children failed, else it succeeds. If all were skipped in this
    tick, it is SKIPPED. A negative `max_failures` counts from the end, 0 always fails.
    """

    __slots__ = ("skips", "ticked")

    def execute(self) -> Status:
        fatal = self.threshold(self.get("max_failures"))
        count = len(self.ticks)
        if count < fatal:
            raise TickError(self, f"max_failures is {fatal}, but there are only {count} children")
        if self.status is not RUNNING:
            self.start()
        skips = 0
        done, quick = self.done, self.quick
        if quick is not None and not done:
            quick()
            skips = self.skips
        else:
            for index, tick in enumerate(self.ticks):
                if index in done:
                    continue
                status = tick()
                if status is SUCCESS:
                    done.add(index)
                elif status is FAILURE:
                    done.add(index)
                    self.failures += 1
                elif status is SKIPPED:
                    skips += 1
        if skips == count:
            return self.skipped()
        if skips + len(done) < count:
            return RUNNING
        failed = self.failures >= fatal
        self.forget()
        return self.finish(FAILURE if failed else SUCCESS)

    def begin(self) -> None:
        """Starts a tick in which generated code ticks the children."""
        self.skips = 0
        self.ticked = self.done  # a halt of the tree within the tick replaces `done`

    def end(self, _called: tuple[Node, ...]) -> None:
        """Ends the activation that generated code ticks."""

    def tally(self, index: int, status: Status) -> None:
        """Takes over the result of a child from generated code."""
        if status is SUCCESS:
            self.ticked.add(index)
        elif status is FAILURE:
            self.ticked.add(index)
            self.failures += 1
        elif status is SKIPPED:
            self.skips += 1
