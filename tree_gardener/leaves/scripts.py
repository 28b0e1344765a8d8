from collections.abc import Callable

from tree_gardener.errors import PortError, ScriptError
from tree_gardener.node import Kind, SyncLeaf
from tree_gardener.script import Environment, bind_run, bind_test
from tree_gardener.script_port import ScriptPort
from tree_gardener.status import FAILURE, SUCCESS, Status


class Script(SyncLeaf):
    """Runs a script on the blackboard and succeeds.

    The text may come from an entry, ``code="{key}"``, which must have a value when the tree is built, such as
    a constant that the SubTree receives. An empty script does nothing.
    """

    __slots__ = ("script",)
    NEEDS = CODE = READ_AT_LOAD = "code"

    def prepare(self) -> None:
        self.script = ScriptPort(self, "code", _bind_any)

    def run(self) -> Status:
        script = self.script
        run = script.fixed or script.current()
        try:
            run()
        except (ScriptError, PortError) as error:
            raise script.fault(error) from None
        return SUCCESS


class ScriptCondition(SyncLeaf):
    """Succeeds if a script is true, else fails; the value of the last statement counts.

    The value must be 0 or 1 if it is an integer, and not negative if it is a double; a string is an error.
    """

    __slots__ = ("script",)
    KIND = Kind.CONDITION
    NEEDS = CODE = READ_AT_LOAD = "code"

    def prepare(self) -> None:
        self.script = ScriptPort(self, "code", bind_test)

    def execute(self) -> Status:
        script = self.script
        test = script.fixed or script.current()
        try:
            status = SUCCESS if test() else FAILURE
        except (ScriptError, PortError) as error:
            raise script.fault(error) from None
        self.status = status
        if self.journal is not None:
            self.journal.results.append(self.marks[0] if status is SUCCESS else self.marks[1])
        return status


def _bind_any(text: str, environment: Environment) -> Callable[[], object]:
    """Binds a script that may be empty."""
    return bind_run(text, environment) if text else _nothing


def _nothing() -> None:
    """Does nothing; used for an empty script."""
