"""Calls of an action that wait."""

from __future__ import annotations

import pytest

from translator.action_waits import WaitingCall, waiting_calls

SOURCE = """
import py_trees
{imports}


class Act(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        time.sleep(1)

    def {method}(self):
        {body}
"""


def waits(body: str, imports: str = "", method: str = "update") -> list[str]:
    source = SOURCE.format(imports=imports, method=method, body=body)
    return [call.name for call in waiting_calls(source, "Act")]


@pytest.mark.parametrize(
    ("imports", "body", "name"),
    [
        ("import time", "time.sleep(1)", "time.sleep"),
        ("import time as t", "t.sleep(1)", "time.sleep"),
        ("from time import sleep as rest", "rest(1)", "time.sleep"),
        ("import rclpy", "rclpy.spin_once(self.node)", "rclpy.spin_once"),
        ("import rclpy", "rclpy.spin_until_future_complete(n, f)", "rclpy.spin_until_future_complete"),
        (
            "from rclpy.wait_for_message import wait_for_message",
            "wait_for_message(Scan, n, '/scan')",
            "rclpy.wait_for_message.wait_for_message",
        ),
        ("", "self.client.wait_for_service()", "self.client.wait_for_service"),
        ("", "self.make().wait_for_server(1.0)", "?.wait_for_server"),
        ("import threading", "threading.Thread(target=f).start()", "threading.Thread"),
        ("import subprocess", "subprocess.run(['ls'])", "subprocess.run"),
        ("import socket", "socket.create_connection(('a', 1))", "socket.create_connection"),
        ("import urllib.request", "urllib.request.urlopen(u)", "urllib.request.urlopen"),
        ("from concurrent.futures import ThreadPoolExecutor", "ThreadPoolExecutor()", None),
    ],
)
@pytest.mark.parametrize("method", ["update", "initialise"])
def test_a_call_that_waits_is_found(imports: str, body: str, name: str | None, method: str) -> None:
    assert waits(body, imports, method)[:1] == [name or "concurrent.futures.ThreadPoolExecutor"]


@pytest.mark.parametrize(
    ("imports", "body"),
    [
        ("import time", "time.monotonic()"),
        ("", "self.clock.sleep"),
        ("import threading", "threading.Lock()"),
        ("from mine import sleep", "sleep(1)"),
        ("import subprocess_tools", "subprocess_tools.run()"),
        ("", "wait_for_service()"),
    ],
)
def test_another_call_is_not(imports: str, body: str) -> None:
    assert waits(body, imports) == []


def test_setup_may_wait() -> None:
    assert waits("pass", "import time", "setup_more") == []


def test_methods_and_functions_that_are_called_are_read_too() -> None:
    source = """
import time

def rest():
    time.sleep(1)

class Act:
    def update(self):
        self.look()
        self.update()

    def look(self):
        rest()

    def unused(self):
        time.sleep(2)
"""
    assert waiting_calls(source, "Act") == [WaitingCall("time.sleep", "update", 5)]


@pytest.mark.parametrize("source", ["def (", "x = 1", "class Other:\n    pass", "class Act:\n    x = 1"])
def test_a_source_without_the_class_has_none(source: str) -> None:
    assert waiting_calls(source, "Act") == []
