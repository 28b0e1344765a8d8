"""The base of the leaves that cancel."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.cancel_leaf import Nav2Cancel

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_the_server_may_have_another_name_and_nothing_to_cancel(ros: Graph) -> None:
    server = Actions(ros, "Wait", "elsewhere")
    assert ros.run("<CancelWait server_name='elsewhere'/>") is Status.SUCCESS
    assert ros.run("<CancelWait server_name='{where}'/>", where="elsewhere") is Status.SUCCESS
    assert server.cancelled == 0


def test_a_missing_server_is_a_failure_after_a_while(ros: Graph) -> None:
    ros.load("<CancelWait/>")
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.clock.advance(Nav2Cancel.WAIT_FOR_SERVER_TIMEOUT_MS / 1000 + 0.1)
    assert ros.tree.tick_exactly_once() is Status.FAILURE
