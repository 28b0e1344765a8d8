from tree_gardener.errors import PortError, ScriptError, TickError
from tree_gardener.node import Kind, SyncLeaf
from tree_gardener.script import Environment, compile_script
from tree_gardener.status import FAILURE, SUCCESS, Status


class Script(SyncLeaf):
    """Runs a script on the blackboard and succeeds.

    The text may come from an entry, ``code="{key}"``, which must have a value when the tree is built, such as
    a constant that the SubTree is given. An empty script does nothing.
    """

    __slots__ = ("environment",)
    NEEDS = CODE = "code"

    def prepare(self) -> None:
        self.environment = Environment(self.board, self.tree.enums, self.uid)

    def run(self) -> Status:
        text = self.get("code")
        if not text:
            return SUCCESS
        try:
            compile_script(text).run(self.environment)
        except (ScriptError, PortError) as error:
            raise TickError(self, f"in the script '{text}': {error}") from None
        return SUCCESS


class ScriptCondition(SyncLeaf):
    """Succeeds if a script is true, else fails; the value of the last statement counts.

    The value must be 0 or 1 if it is an integer, and not negative if it is a double; a string is an error.
    """

    __slots__ = ("environment",)
    KIND = Kind.CONDITION
    NEEDS = CODE = "code"

    def prepare(self) -> None:
        self.environment = Environment(self.board, self.tree.enums, self.uid)

    def run(self) -> Status:
        text = self.get("code")
        try:
            return SUCCESS if compile_script(text).test(self.environment) else FAILURE
        except (ScriptError, PortError) as error:
            raise TickError(self, f"in the script '{text}': {error}") from None
