"""Pre- and post-conditions: the scripts that any node can have as attributes.

Before a tick, in this order and not in that of the attributes: ``_failureIf``, ``_successIf`` and ``_skipIf``
are tested while the node is IDLE, and a true one decides without ticking it; ``_while`` is tested at every
tick, and when it is false the node is SKIPPED, after it was halted if it was RUNNING.

After a result, also one that a pre-condition decided: ``_onSuccess`` or ``_onFailure``, then ``_post``.
``_onHalted`` runs whenever the node is halted.
"""

from collections.abc import Mapping
from typing import Final

from tree_gardener.errors import PortError, ScriptError, TickError
from tree_gardener.node import Node
from tree_gardener.script import Environment, Script, compile_script
from tree_gardener.status import FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, Status

PRE_CONDITIONS: Final = ("_failureIf", "_successIf", "_skipIf", "_while")
POST_CONDITIONS: Final = ("_onSuccess", "_onFailure", "_post", "_onHalted")
CONDITIONS: Final = frozenset(PRE_CONDITIONS + POST_CONDITIONS)


class Guard:
    """The compiled conditions of one node."""

    __slots__ = ("deciding", "environment", "on_failure", "on_halted", "on_success", "post", "while_true")

    def __init__(self, scripts: Mapping[str, Script], environment: Environment) -> None:
        self.environment = environment
        self.deciding = [
            (script, result)
            for attribute, result in (("_failureIf", FAILURE), ("_successIf", SUCCESS), ("_skipIf", SKIPPED))
            if (script := scripts.get(attribute)) is not None
        ]
        self.while_true = scripts.get("_while")
        self.on_success = scripts.get("_onSuccess")
        self.on_failure = scripts.get("_onFailure")
        self.post = scripts.get("_post")
        self.on_halted = scripts.get("_onHalted")

    def before(self, node: Node) -> Status | None:
        """Tests the pre-conditions; returns the result that they decide, or None to tick the node."""
        status = node.status
        if status is IDLE:
            for script, result in self.deciding:
                if self.test(node, script):
                    return result
            if self.while_true is not None and not self.test(node, self.while_true):
                return SKIPPED
        elif status is RUNNING and self.while_true is not None and not self.test(node, self.while_true):
            node.stop()
            return SKIPPED
        return None

    def after(self, node: Node, status: Status) -> None:
        """Runs the post-conditions of a result."""
        script = self.on_success if status is SUCCESS else self.on_failure
        if script is not None:
            self.run(node, script)
        if self.post is not None:
            self.run(node, self.post)

    def halted(self, node: Node) -> None:
        """Runs ``_onHalted``."""
        if self.on_halted is not None:
            self.run(node, self.on_halted)

    def test(self, node: Node, script: Script) -> bool:
        """Runs a script as a condition."""
        try:
            return script.test(self.environment)
        except (ScriptError, PortError) as error:
            raise TickError(node, f"in the script '{script.text}': {error}") from None

    def run(self, node: Node, script: Script) -> None:
        """Runs a script for its effects."""
        try:
            script.run(self.environment)
        except (ScriptError, PortError) as error:
            raise TickError(node, f"in the script '{script.text}': {error}") from None


def compile_conditions(attributes: Mapping[str, str]) -> dict[str, Script]:
    """Compiles the conditions among a node's attributes.

    Raises:
        ScriptError: one does not parse.
    """
    return {name: compile_script(text) for name, text in attributes.items() if name in CONDITIONS}
