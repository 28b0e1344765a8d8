from tree_gardener.node import Decorator
from tree_gardener.status import FAILURE, RUNNING, SUCCESS, Status


class RunOnce(Decorator):
    """Ticks its child until it is done once, and never again.

    Afterwards, also after halts and in new activations, the node is SKIPPED; if `then_skip` is false, it
    returns the first result again. A `then_skip` that cannot be read is true. A child that was halted while
    RUNNING is not done.
    """

    __slots__ = ("result",)

    def prepare(self) -> None:
        super().prepare()
        self.result: Status | None = None

    def execute(self) -> Status:
        if self.result is not None:
            then_skip = self.get_or("then_skip", otherwise=True)
            return self.skipped() if then_skip else self.complete(self.result)
        if self.status is not RUNNING:
            self.start()
        tick = self.tick_child
        status = tick()
        if status is RUNNING:
            return RUNNING
        if status is not SUCCESS and status is not FAILURE:
            return self.skipped()
        self.result = status
        return self.finish(status)
