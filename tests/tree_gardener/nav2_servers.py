"""Action servers and services of Nav2's types, which note what they are asked for."""

from __future__ import annotations

import time
from importlib import import_module
from typing import TYPE_CHECKING, Any

from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup

from tree_gardener import Status
from tree_gardener.nav2.cancel_leaf import GOALS_BEFORE_NS

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


class Actions:
    """An action server: it reaches each goal with a result, aborts it, or waits until it is cancelled."""

    def __init__(self, ros: Graph, kind: str, name: str, *, outcome: str = "succeed", **result: Any) -> None:
        self.goals: list[Any] = []
        self.cancelled = 0
        self.name = name
        self.kind = getattr(import_module("nav2_msgs.action"), kind)
        self._outcome = outcome
        self._result = result
        self.server = ActionServer(
            ros.other,
            self.kind,
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
        return self.kind.Result(**self._result)


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


def cancelled_by(ros: Graph, server: Actions, leaf: type) -> int:
    """Returns how many goals a leaf cancels, after another client has sent one."""
    client = ActionClient(ros.other, server.kind, server.name)
    try:
        ros.spin(client.server_is_ready)
        sent = client.send_goal_async(server.kind.Goal())
        ros.spin(lambda: sent.done() and len(server.goals) == 1)
        accepted_s = time.monotonic()
        ros.spin(lambda: time.monotonic() - accepted_s > GOALS_BEFORE_NS * 2e-9)
        assert ros.run(f"<{leaf.__name__}/>") is Status.SUCCESS
        ros.spin(lambda: server.cancelled > 0)
        result = sent.result().get_result_async()
        ros.spin(result.done)
    finally:
        client.destroy()
    return server.cancelled


class _Turn:
    """Gives the executor one turn."""

    def __await__(self) -> Any:
        yield
