"""Action servers and services of Nav2's types, which note what they are asked for."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from rclpy.action import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


class Actions:
    """An action server: it reaches each goal with a result, aborts it, or waits until it is cancelled."""

    def __init__(self, ros: Graph, kind: str, name: str, *, outcome: str = "succeed", **result: Any) -> None:
        self.goals: list[Any] = []
        self.cancelled = 0
        self._kind = getattr(import_module("nav2_msgs.action"), kind)
        self._outcome = outcome
        self._result = result
        self.server = ActionServer(
            ros.other,
            self._kind,
            name,
            self._reach,
            cancel_callback=self._cancel,
            callback_group=ReentrantCallbackGroup(),
        )

    def _cancel(self, _goal: Any) -> CancelResponse:
        self.cancelled += 1
        return CancelResponse.ACCEPT

    async def _reach(self, goal: Any) -> Any:
        self.goals.append(goal.request)
        while self._outcome == "wait" and not goal.is_cancel_requested:
            await _Turn()
        if goal.is_cancel_requested:
            goal.canceled()
        elif self._outcome == "abort":
            goal.abort()
        else:
            goal.succeed()
        return self._kind.Result(**self._result)


class Services:
    """A service that gives the same answer to each request."""

    def __init__(self, ros: Graph, kind: str, name: str, **answer: Any) -> None:
        self.requests: list[Any] = []
        self._answer = answer
        self.service = ros.other.create_service(
            getattr(import_module("nav2_msgs.srv"), kind), name, self._respond
        )

    def _respond(self, request: Any, response: Any) -> Any:
        self.requests.append(request)
        for name, value in self._answer.items():
            setattr(response, name, value)
        return response


class _Turn:
    """Gives the executor one turn."""

    def __await__(self) -> Any:
        yield
