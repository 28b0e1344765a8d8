"""Clients of a service and of an action whose servers answer when a test requests it."""

from __future__ import annotations

from types import ModuleType, SimpleNamespace
from typing import Any

from rclpy.task import Future


def _module(name: str, **members: Any) -> ModuleType:
    module = ModuleType(name)
    module.__dict__.update(members)
    return module


class Goal:
    """A goal of Nav2's NavigateToPose, reduced to the fields used here."""

    def __init__(self) -> None:
        position, orientation = SimpleNamespace(x=0.0, y=0.0), SimpleNamespace(w=0.0)
        pose = SimpleNamespace(position=position, orientation=orientation)
        self.pose = SimpleNamespace(header=SimpleNamespace(frame_id=""), pose=pose)


NAV2 = {
    "nav2_msgs": _module("nav2_msgs"),
    "nav2_msgs.action": _module("nav2_msgs.action", NavigateToPose=SimpleNamespace(Goal=Goal)),
}


class Handle:
    """A goal that its server has answered."""

    def __init__(self, *, accepted: bool) -> None:
        self.accepted = accepted
        self.result: Future = Future()
        self.cancelled = 0

    def get_result_async(self) -> Future:
        return self.result

    def cancel_goal_async(self) -> None:
        self.cancelled += 1


class Client:
    """Both kinds of client: the sent requests, and the futures of their answers."""

    def __init__(self, *about: Any) -> None:
        self.about = about
        self.is_ready = False
        self.sent: list[Any] = []
        self.answers: list[Future] = []

    def service_is_ready(self) -> bool:
        return self.is_ready

    server_is_ready = service_is_ready

    def call_async(self, request: Any) -> Future:
        self.sent.append(request)
        self.answers.append(Future())
        return self.answers[-1]

    send_goal_async = call_async


class Node:
    """Creates clients, and stores them."""

    def __init__(self) -> None:
        self.clients: list[Client] = []

    def create_client(self, *about: Any) -> Client:
        self.clients.append(Client(*about))
        return self.clients[-1]

    def create_action_client(self, _node: Node, *about: Any) -> Client:
        return self.create_client(*about)
