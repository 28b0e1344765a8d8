"""Scripts that nodes read from a port."""

import contextlib
from collections.abc import Callable
from typing import Any

from tree_gardener.errors import PortError, ScriptError, TickError, shown
from tree_gardener.node import Node
from tree_gardener.ports import pointer_key
from tree_gardener.script import Environment

Bind = Callable[[str, Environment], Callable[[], Any]]


class ScriptPort:
    """The script of a port.

    It is bound to the node when the tree is built, and again when an entry's text has changed.

    Attributes:
        fixed: runs the script, if the port holds the script itself and not the name of an entry.
        text: the script that was bound last.
    """

    __slots__ = ("bind", "environment", "fixed", "last", "node", "port", "text")

    def __init__(self, node: Node, port: str, bind: Bind) -> None:
        self.node = node
        self.port = port
        self.bind = bind
        self.environment = Environment(node.board, node.tree.enums, node.uid)
        self.last: Callable[[], Any] | None = None
        self.fixed: Callable[[], Any] | None = None
        self.text = ""
        given = node.ports.get(port)
        if given and pointer_key(given, port) is None:
            with contextlib.suppress(TickError):  # the loader reports the error, or the node when it runs
                self.fixed = self.current()

    def current(self) -> Callable[[], Any]:
        """Returns the function that runs the current script of the port.

        Raises:
            TickError: the port has no value, or the text cannot be parsed.
        """
        text = self.node.get(self.port)
        if text != self.text or self.last is None:
            self.text = text
            try:
                self.last = self.bind(text, self.environment)
            except ScriptError as error:
                self.last = None
                raise self.fault(error) from None
        return self.last

    def fault(self, error: ScriptError | PortError) -> TickError:
        """Returns the error of the node for an error of its script."""
        return TickError(self.node, f"in the script '{shown(self.text)}': {error}")
