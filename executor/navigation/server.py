"""An action server whose goals are worked on in steps: nothing waits, and no task polls."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Final

from rclpy.action import ActionServer, CancelResponse

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

KEPT_S: Final = 10
"""The time for which a result is kept for clients that ask late, as with Nav2."""


class StepServer(ActionServer):  # type: ignore[misc]
    """Serves one action.

    Args:
        node: the node, whose executor handles the requests.
        kind: the class of the action.
        name: the name of the action.
        begin: is called with the handle of each accepted goal.
    """

    def __init__(self, node: Node, kind: Any, name: str, begin: Callable[[StepServer, Any], None]) -> None:
        self._begin = begin
        super().__init__(
            node,
            kind,
            name,
            lambda _handle: kind.Result(),
            cancel_callback=lambda _handle: CancelResponse.ACCEPT,
            result_timeout=KEPT_S,
        )
        self.name = name

    def notify_execute(self, goal_handle: Any, execute_callback: Any) -> None:
        """Takes over an accepted goal, where rclpy would begin a task for it."""
        self._begin(self, goal_handle)

    def end(self, handle: Any, result: Any, *, reached: bool) -> None:
        """Ends a goal and sends its result: cancelled if a client asked for that, else reached or aborted."""
        super().notify_execute(handle, partial(_close, result, reached))


def _close(result: Any, reached: bool, handle: Any) -> Any:  # noqa: FBT001 - bound by `end`
    if handle.is_cancel_requested:
        handle.canceled()
    elif reached:
        handle.succeed()
    else:
        handle.abort()
    return result
