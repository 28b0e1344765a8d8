"""Inverter, ForceSuccess, ForceFailure and KeepRunningUntilFailure: they change their child's result."""

from tree_gardener.node import Decorator
from tree_gardener.status import FAILURE, RUNNING, SUCCESS, Status


class Inverter(Decorator):
    """Turns SUCCESS into FAILURE and FAILURE into SUCCESS; RUNNING and SKIPPED are returned unchanged."""

    __slots__ = ()

    def execute(self) -> Status:
        if self.status is not RUNNING:
            quick = self.quick
            if quick is not None:
                return quick()  # type: ignore[no-any-return]
            self.start()
        tick = self.tick_child
        return self.go_on(0, tick())

    def go_on(self, _index: int, status: Status) -> Status:
        if status is RUNNING:
            return RUNNING
        if status is SUCCESS:
            return self.finish(FAILURE)
        if status is FAILURE:
            return self.finish(SUCCESS)
        return self.skipped()


class ForceSuccess(Decorator):
    """Succeeds whether its child succeeds or fails; RUNNING and SKIPPED are returned unchanged."""

    __slots__ = ()

    def execute(self) -> Status:
        if self.status is not RUNNING:
            quick = self.quick
            if quick is not None:
                return quick()  # type: ignore[no-any-return]
            self.start()
        tick = self.tick_child
        return self.go_on(0, tick())

    def go_on(self, _index: int, status: Status) -> Status:
        if status is RUNNING:
            return RUNNING
        return self.finish(SUCCESS) if status is SUCCESS or status is FAILURE else self.skipped()


class ForceFailure(Decorator):
    """Fails whether its child succeeds or fails; RUNNING and SKIPPED are returned unchanged."""

    __slots__ = ()

    def execute(self) -> Status:
        if self.status is not RUNNING:
            quick = self.quick
            if quick is not None:
                return quick()  # type: ignore[no-any-return]
            self.start()
        tick = self.tick_child
        return self.go_on(0, tick())

    def go_on(self, _index: int, status: Status) -> Status:
        if status is RUNNING:
            return RUNNING
        return self.finish(FAILURE) if status is SUCCESS or status is FAILURE else self.skipped()


class KeepRunningUntilFailure(Decorator):
    """Returns RUNNING until its child fails, then fails.

    A child that succeeded starts again at the next tick.
    """

    __slots__ = ()

    def execute(self) -> Status:
        if self.status is not RUNNING:
            self.start()
        tick = self.tick_child
        status = tick()
        if status is FAILURE:
            return self.finish(FAILURE)
        if status is SUCCESS:
            self.reset()
        return RUNNING
