"""Wait of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.wait import Wait

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


@pytest.mark.parametrize(("text", "seconds"), [("1.5", 1.5), ("-2", 2.0)])
def test_it_waits_by_the_clock_of_the_server(ros: Graph, text: str, seconds: float) -> None:
    server = Actions(ros, "Wait", Wait.ACTION_NAME)
    assert ros.run(f"<Wait wait_duration='{text}'/>") is Status.SUCCESS
    time = server.goals[0].time
    assert time.sec + time.nanosec * 1e-9 == seconds


def test_a_halted_wait_is_cancelled(ros: Graph) -> None:
    server = Actions(ros, "Wait", Wait.ACTION_NAME, outcome="wait")
    ros.load("<Wait wait_duration='9'/>")
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and bool(server.goals))
    ros.tree.halt()
    ros.spin(lambda: server.cancelled == 1)
    assert len(server.goals) == 1
