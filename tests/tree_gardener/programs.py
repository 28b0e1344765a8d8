"""Programs of an exported package in processes of their own, and a node that talks to them."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tests.deadline import DEADLINE_S

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

ROOT = Path(__file__).resolve().parents[2]
PATIENCE_S = 2.0


class Peer:
    """A node of the test, in a domain that it shares with one program."""

    def __init__(self, domain_id: int) -> None:
        import rclpy
        from rclpy.context import Context
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node

        self.context = Context()
        rclpy.init(context=self.context, domain_id=domain_id)
        self.node = Node("peer", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)

    def until(self, happened: Callable[[], Any]) -> Any:
        """Handles messages until something has happened; returns it."""
        end = time.monotonic() + DEADLINE_S
        while not (value := happened()):
            assert time.monotonic() < end, "it did not happen in time"
            self.executor.spin_once(timeout_sec=0.05)
        return value

    def answer(self, future: Any) -> Any:
        """Waits for a future; returns its result."""
        self.until(future.done)
        return future.result()

    def insist(self, ask: Callable[[], Any]) -> Any:
        """Asks until there is an answer; returns it.

        A server that has not discovered the client yet drops its answer.
        """
        end = time.monotonic() + DEADLINE_S
        while True:
            future, patience = ask(), time.monotonic() + PATIENCE_S
            while time.monotonic() < patience:
                if future.done():
                    return future.result()
                self.executor.spin_once(timeout_sec=0.05)
            assert time.monotonic() < end, "there is no answer"

    def close(self) -> None:
        """Leaves the graph."""
        self.executor.shutdown()
        self.node.destroy_node()
        self.context.try_shutdown()


@contextlib.contextmanager
def program(folder: Path, domain_id: int, call: str) -> Iterator[subprocess.Popen[str]]:
    """Runs a call of `tree_gardener.ros_main` in a process; interrupts it at the end.

    What it says is in the file ``said`` of the folder.
    """
    script = f"import sys; from tree_gardener import ros_main; sys.exit(ros_main.{call})"
    with (folder / "said").open("w") as said:
        process = subprocess.Popen(
            [sys.executable, "-c", script],
            cwd=folder,
            env={
                **os.environ,
                "ROS_DOMAIN_ID": str(domain_id),
                "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
                "PYTHONPATH": str(ROOT),
            },
            stderr=said,
            text=True,
        )
        try:
            yield process
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(timeout=60)
