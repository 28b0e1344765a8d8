"""The runner on a real rclpy node."""

from __future__ import annotations

import os
import time
from typing import TYPE_CHECKING, Any

import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import leaf, load, recording
from tree_gardener import Status

if TYPE_CHECKING:
    from collections.abc import Iterator

os.environ.setdefault("ROS_DOMAIN_ID", "11")
os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")

# One of rclpy's own dependencies uses it.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

R, S = PyTreesStatus.RUNNING, PyTreesStatus.SUCCESS


@pytest.fixture
def node() -> Iterator[Any]:
    import rclpy

    rclpy.init()
    made = rclpy.create_node("tree_gardener_test")
    yield made
    made.destroy_node()
    rclpy.shutdown()


def test_a_tree_runs_on_an_rclpy_node(node: Any) -> None:
    import rclpy

    from tree_gardener.ros import RosClock, RosRunner

    tree = load(
        '<Sequence><A name="a"/><Delay delay_msec="30"><Succeeding/></Delay></Sequence>',
        nodes={"A": recording(R, S)},
        clock=RosClock(node),
    )
    ends: list[Status] = []
    runner = RosRunner(tree, node, tick_hz=50.0, finished=ends.append)
    deadline = time.monotonic() + 20.0
    while not ends and time.monotonic() < deadline:
        rclpy.spin_once(node, timeout_sec=0.05)
    runner.shutdown()
    assert ends == [Status.SUCCESS]
    calls = leaf(tree, "a").calls
    assert calls[0] == f"setup {node}"
    assert calls[-1] == "shutdown"


def test_the_clock_of_a_node_sleeps(node: Any) -> None:
    from tree_gardener.ros import RosClock

    clock = RosClock(node)
    start = clock.now()
    clock.sleep(0.01)
    assert clock.now() - start >= 0.01
