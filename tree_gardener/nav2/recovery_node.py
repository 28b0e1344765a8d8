"""RecoveryNode of Nav2."""

from tree_gardener import ControlNode, Port, PortError, Status


class RecoveryNode(ControlNode):
    """Ticks its first child; when that fails, the second one as a recovery, and then the first again.

    It succeeds with the first child. It fails when the first one failed after `number_of_retries` recoveries,
    or a recovery failed or was skipped.
    """

    MARKS_RUNNING = True
    MIN_CHILDREN = 2
    MAX_CHILDREN = 2
    INPUT_PORTS = {"number_of_retries": Port(int, default=1, description="The number of recoveries.")}

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.limit = 1
        self.forget()

    def forget(self) -> None:
        """Resets the state, so that the node starts again."""
        self.index = 0
        self.retries = 0

    def update(self) -> Status:
        self.read_limit()
        while self.retries <= self.limit:
            status = self.tick_child(self.index)
            if status is Status.RUNNING:
                return Status.RUNNING
            result = self.after_main(status) if self.index == 0 else self.after_recovery(status)
            if result is not None:
                return result
        return self.end(Status.FAILURE)

    def read_limit(self) -> None:
        """Reads the port; after an unreadable or negative number the last value stays, as in Nav2."""
        try:
            limit = self.get_input("number_of_retries")
        except PortError:
            return
        if limit >= 0:
            self.limit = limit

    def after_main(self, status: Status) -> Status | None:
        """Returns the result after the first child, or None to recover."""
        if status is not Status.FAILURE or self.retries == self.limit:
            return self.end(status)
        self.halt_child(0)
        self.index = 1
        return None

    def after_recovery(self, status: Status) -> Status | None:
        """Returns the result after the second child, or None to try the first one again."""
        if status is Status.FAILURE:
            return self.end(status)
        self.halt_child(1)
        self.index = 0
        if status is Status.SKIPPED:
            return Status.FAILURE
        self.retries += 1
        return None

    def end(self, status: Status) -> Status:
        """Resets the children and the state, and returns the status."""
        self.halt()
        return status

    def halt(self) -> None:
        super().halt()
        self.forget()
