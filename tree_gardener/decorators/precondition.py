from tree_gardener.errors import PortError, ScriptError, TickError
from tree_gardener.node import Decorator
from tree_gardener.script import bind_test
from tree_gardener.script_port import ScriptPort
from tree_gardener.status import FAILURE, RUNNING, SKIPPED, SUCCESS, Status


class Precondition(Decorator):
    """Ticks its child only if the script `if` is true, else returns `else`.

    Once true, the script is not evaluated again until the child succeeded or failed; a skipped or halted
    child does not change that.
    """

    __slots__ = ("open", "script")
    MARKS_RUNNING = ()
    NEEDS = CODE = READ_AT_LOAD = "if"

    def prepare(self) -> None:
        super().prepare()
        self.open = False
        self.script = ScriptPort(self, "if", bind_test)

    def execute(self) -> Status:
        otherwise = self.get("else")
        if not self.open and not self.test():
            return self.refuse(otherwise)
        self.open = True
        tick = self.tick_child
        status = tick()
        if status is RUNNING:
            if self.status is not RUNNING:
                self.start()
            return RUNNING
        if status is SKIPPED:
            return self.skipped()
        self.open = False
        return self.finish(status)

    def test(self) -> bool:
        test = self.script.fixed or self.script.current()
        try:
            return bool(test())
        except (ScriptError, PortError) as error:
            raise self.script.fault(error) from None

    def refuse(self, otherwise: Status) -> Status:
        """Returns the result for a script that is false."""
        if otherwise is SUCCESS or otherwise is FAILURE:
            return self.complete(otherwise)
        if otherwise is SKIPPED:
            return self.skipped()
        if otherwise is not RUNNING:
            raise TickError(self, "'else' is IDLE, which is no result")
        if self.status is not RUNNING:
            self.start()
        return RUNNING
