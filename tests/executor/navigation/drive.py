"""A world with its navigation and a client, in one process without any other."""

from __future__ import annotations

import contextlib
import time
from typing import TYPE_CHECKING, Any

from tests.deadline import DEADLINE_S
from tests.domains import own_domain_id

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

DOMAIN_ID = own_domain_id()


class Drive:
    """The world, its navigation, and a node that is a client of it."""

    def __init__(self, context: Any, universe: str) -> None:
        from rclpy.node import Node

        from executor.navigation.start import make_navigation
        from executor.ros.spin import DrainingExecutor
        from executor.world.simulation.launch import make_world

        self.world = make_world(universe)
        made = make_navigation(self.world, context)
        assert made is not None
        self.navigation = made
        self.clients: list[Any] = []
        self.node = Node("client", context=context)
        self.executor = DrainingExecutor(context=context)
        self.executor.add_node(self.node)

    def turn(self) -> None:
        """Simulates one period of the world."""
        self.world.step(4)
        self.navigation.poll()
        self.executor.drain()

    def until(self, happened: Callable[[], Any]) -> None:
        """Simulates until something has happened."""
        deadline = time.monotonic() + DEADLINE_S
        while not happened():
            assert time.monotonic() < deadline, "it did not happen in time"
            self.turn()

    def client(self, kind: Any, name: str) -> Any:
        """Returns a client of an action that is served."""
        from rclpy.action import ActionClient

        client = ActionClient(self.node, kind, name)
        self.clients.append(client)
        self.until(client.server_is_ready)
        return client

    def send(self, client: Any, goal: Any, feedback: list[Any] | None = None) -> Any:
        """Sends a goal; returns its handle once it is accepted."""
        sending = client.send_goal_async(
            goal, feedback_callback=lambda each: None if feedback is None else feedback.append(each.feedback)
        )
        self.until(sending.done)
        assert sending.result().accepted
        return sending.result()

    def result(self, handle: Any) -> Any:
        """Returns status and result of a goal."""
        answer = handle.get_result_async()
        self.until(answer.done)
        return answer.result()

    def call(self, kind: Any, name: str, request: Any) -> Any:
        """Calls a service."""
        client = self.node.create_client(kind, name)
        self.until(client.service_is_ready)
        answer = client.call_async(request)
        self.until(answer.done)
        return answer.result()


@contextlib.contextmanager
def driven(universe: str = "house") -> Iterator[Drive]:
    """Yields a world with its navigation."""
    import rclpy
    from rclpy.context import Context

    context = Context()
    rclpy.init(context=context, domain_id=DOMAIN_ID)
    made = Drive(context, universe)
    try:
        yield made
    finally:
        made.executor.shutdown()
        for client in made.clients:
            client.destroy()
        made.navigation.close()
        made.node.destroy_node()
        made.world.close()
        context.try_shutdown()
