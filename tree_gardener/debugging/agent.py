"""The interface of a debugger to the engine."""

from typing import TYPE_CHECKING, Protocol

from tree_gardener.node import Node
from tree_gardener.status import Status

if TYPE_CHECKING:
    from tree_gardener.debugging.wiring import Wiring


class DebuggingEnded(BaseException):
    """Raised by a debugger at a node to end the run within a tick.

    It is not an `Exception`, so that ``except Exception`` in users' code does not stop it.
    """


class Agent(Protocol):
    """A debugger. All methods are called on the ticking thread, and may take as long as they like."""

    def attach(self, wiring: "Wiring") -> None:
        """Receives the wiring, which chooses the nodes that ask."""

    def before(self, node: Node) -> None:
        """Is asked before the tick of a node, and before its pre-conditions."""

    def after(self, node: Node, status: Status, decided: str) -> Status:
        """Is asked after the tick of a node; returns the result to use.

        Args:
            node: the node.
            status: its result.
            decided: the name of the pre-condition that decided the result without a tick, or "".
        """

    def forced(self, node: Node) -> Status | None:
        """Returns the result that the node shall have without a tick; asked after its pre-conditions."""

    def may_halt(self, node: Node) -> bool:
        """Is asked before a halt; False makes the node IDLE without calling it."""

    def halted(self, node: Node) -> None:
        """Is called when a node was halted, after its ``_onHalted``."""
