"""The bases of Nav2's leaves: errors, cancelling, timeouts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from nav2_msgs.action import ComputePathToPose, Wait

from tests.tree_gardener.nav2_servers import Actions, Services
from tree_gardener import Status
from tree_gardener.nav2.action_leaf import LEAST_TIMEOUT_S, Nav2Action, Nav2Service, put

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph

PATH = "<ComputePathToPose goal='1;2;0' error_code_id='{code}' error_msg='{why}'"


def test_a_missing_server_is_waited_for_and_then_a_timeout(ros: Graph) -> None:
    ros.load(f"{PATH}/>")
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.clock.advance(Nav2Action.WAIT_FOR_SERVER_TIMEOUT_MS / 1000 + 0.1)
    assert ros.tree.tick_exactly_once() is Status.FAILURE
    assert ros["code"] == ComputePathToPose.Result.TIMEOUT
    assert ros["why"].endswith("compute_path_to_pose: SERVER_UNREACHABLE")


def test_a_missing_service_is_waited_for_and_then_fails(ros: Graph) -> None:
    ros.load("<ClearEntireCostmap service_name='clear'/>")
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.clock.advance(Nav2Service.WAIT_FOR_SERVER_TIMEOUT_MS / 1000 + 0.1)
    assert ros.tree.tick_exactly_once() is Status.FAILURE


def test_a_service_that_answers_succeeds(ros: Graph) -> None:
    service = Services(ros, "ClearEntireCostmap", "clear")
    assert ros.run("<ClearEntireCostmap service_name='clear'/>") is Status.SUCCESS
    assert len(service.requests) == 1


def test_a_goal_that_someone_else_cancels_succeeds_as_in_nav2(ros: Graph) -> None:
    server = Actions(ros, "Wait", "wait", outcome="wait")
    ros.load("<Wait error_code_id='{code}'/>")
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and bool(server.goals))
    sent = ros.tree.nodes[0].behaviour._sent
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and sent.handle is not None)
    sent.cancel()
    assert ros.run() is Status.SUCCESS
    assert ros["code"] == 0


def test_the_short_timeouts_of_nav2s_trees_are_lengthened(ros: Graph) -> None:
    ros.load("<Wait server_timeout='10'/>")
    leaf = ros.tree.nodes[0].behaviour
    assert leaf.seconds("server_timeout", 1000) == LEAST_TIMEOUT_S
    assert leaf.seconds("wait_for_server_timeout", 5000) == 5.0
    assert leaf.seconds("wait_for_server_timeout", -1) < 0
    assert leaf.is_given("server_timeout")
    assert not leaf.is_given("server_name")


def test_fields_of_other_versions_are_left_out() -> None:
    goal = Wait.Goal()
    put(goal, of_the_future=5, time=goal.time)
    assert not hasattr(goal, "of_the_future")
