"""PipelineSequence of Nav2."""

from tree_gardener import ControlNode, Status


class PipelineSequence(ControlNode):
    """A Sequence that ticks all children again up to the one that runs.

    Earlier children may run again while a later one runs; only the furthest child that has run makes the node
    RUNNING. A child that fails ends the node; it succeeds when the last child is done.
    """

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.furthest = 0

    def update(self) -> Status:
        skipped = 0
        for index in range(self.child_count):
            status = self.tick_child(index)
            if status is Status.FAILURE:
                return self.end(status)
            if status is Status.SKIPPED:
                skipped += 1
            elif status is Status.RUNNING and index >= self.furthest:
                self.furthest = index
                return Status.RUNNING
        return self.end(Status.SKIPPED if skipped == self.child_count else Status.SUCCESS)

    def end(self, status: Status) -> Status:
        """Resets the children and the state, and returns the status."""
        self.halt_children()
        self.furthest = 0
        return status

    def halt(self) -> None:
        self.furthest = 0
