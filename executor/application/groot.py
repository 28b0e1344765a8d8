"""Serves the tree of a session to Groot2, which only looks: the session itself holds and forces it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from executor import messages

if TYPE_CHECKING:
    from tree_gardener import Tree
    from tree_gardener.groot import Groot2Publisher

__all__ = ["PORT_VARIABLE", "ApplicationPublisher"]

PORT_VARIABLE: Final = "BT_STUDIO_GROOT2"


class ApplicationPublisher:
    """The publisher of the tree that runs, if the environment names a port.

    Args:
        port: the port; 0 for none.
    """

    def __init__(self, port: int) -> None:
        self._port = port
        self._publisher: Groot2Publisher | None = None

    @classmethod
    def of_environment(cls) -> ApplicationPublisher:
        """Returns the publisher that the manager wants; users' code does not see the variable."""
        return cls(int(os.environ.pop(PORT_VARIABLE, "0")))

    def serve(self, tree: Tree, port: int) -> messages.Error | None:
        """Serves the tree at a port, or no longer with 0; returns why that is not possible.

        A refusal leaves what was served before.
        """
        from tree_gardener.groot import Groot2Publisher, GrootError  # noqa: PLC0415 - needed only with a port

        if port == self._port and self._publisher is not None:
            return None
        try:
            made = Groot2Publisher(tree, port, looks_only=True) if port else None
        except GrootError as error:
            hint = "Is another program at this port or the next one? Choose another port."
            return messages.Error("port_taken", f"Groot2 cannot look at this run: {error}.", hint)
        self.close()
        self._port, self._publisher = port, made
        return None

    def follow(self, tree: Tree) -> None:
        """Serves a tree in place of the one before.

        Raises:
            GrootError: the ports cannot be used.
        """
        self.close()
        if self._port:
            from tree_gardener.groot import Groot2Publisher  # noqa: PLC0415 - needed only with a port

            self._publisher = Groot2Publisher(tree, self._port, looks_only=True)

    def close(self) -> None:
        """Ends the service."""
        if self._publisher is not None:
            self._publisher.close()
            self._publisher = None
