"""PersistentSequence of Nav2."""

import contextlib

from tree_gardener import ControlNode, Port, PortError, Status


class PersistentSequence(ControlNode):
    """A Sequence that keeps its position on the blackboard, also when it is halted.

    The entry of `current_child_idx` must have a value, as ``<Script code="current_child_idx := 0"/>`` gives.
    A child that is skipped counts as done. After a failure, and at the end, it starts again at the first.
    """

    INOUT_PORTS = {"current_child_idx": Port(int, description="The index of the current child.")}

    def update(self) -> Status:
        index = self.get_input("current_child_idx")
        self.mark_running()
        while index < self.child_count:
            status = self.tick_child(index)
            if status is Status.RUNNING:
                return Status.RUNNING
            if status is Status.FAILURE:
                return self.end(status)
            index += 1
            self.store(index)
        return self.end(Status.SUCCESS)

    def end(self, status: Status) -> Status:
        """Resets the children and the position, and returns the status."""
        self.reset_children()
        self.store(0)
        return status

    def store(self, index: int) -> None:
        """Writes the position; if the port is a literal, nothing is written, as in Nav2."""
        with contextlib.suppress(PortError):
            self.set_output("current_child_idx", index)
