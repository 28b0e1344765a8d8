"""NonblockingSequence of Nav2."""

from tree_gardener import ControlNode, Status


class NonblockingSequence(ControlNode):
    """Ticks all its children at every tick, and succeeds when all succeed in one tick.

    A child that fails ends the node. A child that is skipped is an error, as in Nav2.
    """

    def update(self) -> Status:
        have_all_succeeded = True
        for index in range(self.child_count):
            status = self.tick_child(index)
            if status is Status.FAILURE:
                self.halt_children()
                return status
            if status is Status.SKIPPED:
                raise RuntimeError(f"child {index} was skipped, which NonblockingSequence does not allow")
            have_all_succeeded = have_all_succeeded and status is Status.SUCCESS
        if not have_all_succeeded:
            return Status.RUNNING
        self.halt_children()
        return Status.SUCCESS
