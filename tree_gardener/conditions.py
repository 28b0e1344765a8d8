"""Pre- and post-conditions: the scripts that any node can have as attributes.

Before a tick, in this order and not in that of the attributes: ``_failureIf``, ``_successIf`` and ``_skipIf``
are tested while the node is IDLE. If one is true, it decides the result, and the node is not ticked.
``_while`` is tested at every tick. If it is false, the node is SKIPPED; a RUNNING node is halted before.

After a result, also after one that a pre-condition decided, ``_onSuccess`` or ``_onFailure`` runs, and then
``_post``. ``_onHalted`` runs whenever the node is halted.
"""

from collections.abc import Callable, Mapping
from typing import Any, Final

from tree_gardener.errors import PortError, ScriptError, TickError, shown
from tree_gardener.node import Node
from tree_gardener.script import Environment, Script, bind_run, bind_test, compile_script
from tree_gardener.status import FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, Status

PRE_CONDITIONS: Final = ("_failureIf", "_successIf", "_skipIf", "_while")
POST_CONDITIONS: Final = ("_onSuccess", "_onFailure", "_post", "_onHalted")
CONDITIONS: Final = frozenset(PRE_CONDITIONS + POST_CONDITIONS)


class Condition:
    """One condition, bound to its node.

    Attributes:
        text: the script.
        call: runs the script; for a pre-condition it returns true or false.
    """

    __slots__ = ("call", "text")

    def __init__(self, text: str, call: Callable[[], Any]) -> None:
        self.text = text
        self.call = call


class Guard:
    """The compiled conditions of one node."""

    __slots__ = ("deciding", "on_failure", "on_halted", "on_success", "post", "while_true")

    def __init__(self, scripts: Mapping[str, Script], environment: Environment) -> None:
        bound = {
            name: Condition(
                script.text, (bind_test if name in PRE_CONDITIONS else bind_run)(script.text, environment)
            )
            for name, script in scripts.items()
        }
        self.deciding = [
            (condition, result)
            for attribute, result in (("_failureIf", FAILURE), ("_successIf", SUCCESS), ("_skipIf", SKIPPED))
            if (condition := bound.get(attribute)) is not None
        ]
        self.while_true = bound.get("_while")
        self.on_success = bound.get("_onSuccess")
        self.on_failure = bound.get("_onFailure")
        self.post = bound.get("_post")
        self.on_halted = bound.get("_onHalted")

    def before(self, node: Node) -> Status | None:
        """Tests the pre-conditions; returns the result that they decide, or None to tick the node."""
        status = node.status
        if status is IDLE:
            for condition, result in self.deciding:
                if self.run(node, condition):
                    return result
            if self.while_true is not None and not self.run(node, self.while_true):
                return SKIPPED
        elif status is RUNNING and self.while_true is not None and not self.run(node, self.while_true):
            node.stop()
            return SKIPPED
        return None

    def after(self, node: Node, status: Status) -> None:
        """Runs the post-conditions after a result."""
        condition = self.on_success if status is SUCCESS else self.on_failure
        if condition is not None:
            self.run(node, condition)
        if self.post is not None:
            self.run(node, self.post)

    def stop(self, node: Node) -> None:
        """Halts the node, and runs ``_onHalted`` afterwards."""
        node.halt()
        if self.on_halted is not None:
            self.run(node, self.on_halted)

    def run(self, node: Node, condition: Condition) -> Any:
        """Runs a condition and returns its value."""
        try:
            return condition.call()
        except (ScriptError, PortError) as error:
            raise TickError(node, f"in the script '{shown(condition.text)}': {error}") from None


def compile_conditions(attributes: Mapping[str, str]) -> dict[str, Script]:
    """Compiles the pre- and post-conditions among a node's attributes.

    Raises:
        ScriptError: a condition cannot be parsed.
    """
    return {name: compile_script(text) for name, text in attributes.items() if name in CONDITIONS}
