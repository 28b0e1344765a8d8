"""SingleTrigger of Nav2."""

from tree_gardener import DecoratorNode, Status


class SingleTrigger(DecoratorNode):
    """Ticks its child until the child succeeds or fails, once; from then on the node fails.

    It starts again when its parent resets it, or halts it. Rule: Nav2's
    plugins/decorator/single_trigger_node.cpp.
    """

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.is_first = True

    def update(self) -> Status:
        if self.status is Status.IDLE:
            self.is_first = True
        self.mark_running()
        if not self.is_first:
            return Status.FAILURE
        status = self.tick_child()
        if status in {Status.SUCCESS, Status.FAILURE}:
            self.is_first = False
        return status
