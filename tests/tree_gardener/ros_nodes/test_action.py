"""Action clients as nodes, against real action servers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from example_interfaces.action import Fibonacci  # type: ignore[import-untyped]
from rclpy.action import ActionServer, CancelResponse, GoalResponse

from tests.tree_gardener.trees import document
from tree_gardener import Status, TickError, Tree
from tree_gardener.ros_nodes.action import RosActionNode

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph

pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

ACTION = "<RosAction action_name='fib' action_type='example_interfaces/action/Fibonacci' "


class Server:
    """Counts up to the goal's order; a goal of 0 is rejected, a goal below 0 aborted."""

    def __init__(self, ros: Graph, name: str = "fib", *, waits: bool = False) -> None:
        self.orders: list[int] = []
        self.cancelled = 0
        self.ended = 0
        self.waits = waits
        self.is_open = False
        self.server = ActionServer(
            ros.other,
            Fibonacci,
            name,
            self.reach,
            goal_callback=lambda goal: GoalResponse.REJECT if goal.order == 0 else GoalResponse.ACCEPT,
            cancel_callback=self.cancel,
        )

    def cancel(self, _goal: Any) -> CancelResponse:
        self.cancelled += 1
        return CancelResponse.ACCEPT

    async def reach(self, goal: Any) -> Any:
        order = goal.request.order
        self.orders.append(order)
        result = Fibonacci.Result(sequence=list(range(max(order, 0))))
        goal.publish_feedback(Fibonacci.Feedback(sequence=[7, 8]))
        if order < 0:
            goal.abort()
            return result
        while self.waits and not goal.is_cancel_requested:
            await Turn()
        if goal.is_cancel_requested:
            goal.canceled()
            self.ended += 1
            return result
        goal.succeed()
        return result


class Turn:
    """Gives the executor one turn."""

    def __await__(self) -> Any:
        yield


def test_the_fields_of_goal_and_result_are_ports(ros: Graph) -> None:
    server = Server(ros)
    assert ros.run(f"{ACTION} goal__order='{{n}}' result__sequence='{{found}}'/>", n=3) is Status.SUCCESS
    assert server.orders == [3]
    assert ros["found"] == [0, 1, 2]


def test_feedback_is_written_when_it_comes(ros: Graph) -> None:
    server = Server(ros, waits=True)
    ros.load(f"{ACTION} goal__order='3' feedback__sequence='{{sofar}}'/>", sofar=None)
    ros.tree.tick_exactly_once()
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and ros["sofar"] == [7, 8])
    server.waits = False
    assert ros.run() is Status.SUCCESS


@pytest.mark.parametrize(("order", "error"), [("0", "GOAL_REJECTED_BY_SERVER"), ("-1", "ACTION_ABORTED")])
def test_a_goal_that_the_server_does_not_reach_fails_and_says_why(ros: Graph, order: str, error: str) -> None:
    Server(ros)
    assert ros.run(f"{ACTION} goal__order='{order}' error='{{why}}'/>") is Status.FAILURE
    assert ros["why"] == error


def test_a_halted_node_cancels_its_goal_even_before_the_server_answered(ros: Graph) -> None:
    server = Server(ros, waits=True)
    ros.load(f"{ACTION} goal__order='3'/>")
    ros.spin(ros.tree.nodes[0].behaviour._client.server_is_ready)
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.tree.halt()
    ros.spin(lambda: server.ended == 1)
    assert server.cancelled


@pytest.mark.filterwarnings("ignore:failed to send response:RuntimeWarning")
def test_a_run_that_ends_before_the_server_answered_cancels_its_goal(ros: Graph) -> None:
    server = Server(ros, waits=True)
    ros.load(f"{ACTION} goal__order='3'/>")
    ros.spin(ros.tree.nodes[0].behaviour._client.server_is_ready)
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.tree.shutdown()  # nobody hears the answer any more
    ros.executor.remove_node(ros.tree_node)
    ros.spin(lambda: server.ended == 1)
    assert server.cancelled


def test_a_goal_that_someone_else_cancels_fails(ros: Graph) -> None:
    server = Server(ros, waits=True)
    ros.load(f"{ACTION} goal__order='3' error='{{why}}'/>")
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and bool(server.orders))
    sent = ros.tree.nodes[0].behaviour._sent
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and sent.handle is not None)
    sent.cancel()
    assert ros.run() is Status.FAILURE
    assert ros["why"] == "ACTION_CANCELLED"


def test_a_missing_server_is_waited_for_without_blocking_the_tick(ros: Graph) -> None:
    ros.load(f"{ACTION} goal__order='3' wait_for_server_timeout='2000' error='{{why}}'/>")
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.clock.advance(1.9)
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.clock.advance(0.2)
    assert ros.tree.tick_exactly_once() is Status.FAILURE
    assert ros["why"] == "SERVER_UNREACHABLE"


def test_a_tree_may_continue_without_the_server(ros: Graph) -> None:
    missing = f"{ACTION} wait_for_server_timeout='0' if_missing='SKIPPED'/>"
    assert ros.run(f"<Sequence>{missing}<AlwaysSuccess/></Sequence>") is Status.SUCCESS


def test_a_server_that_appears_late_is_used(ros: Graph) -> None:
    ros.load(f"{ACTION} goal__order='2' wait_for_server_timeout='-1'/>")
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.clock.advance(1000.0)
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    server = Server(ros)
    assert ros.run() is Status.SUCCESS
    assert server.orders == [2]


def test_a_server_that_does_not_answer_is_given_up(ros: Graph) -> None:
    Server(ros)
    ros.load(f"{ACTION} goal__order='2' server_timeout='300' error='{{why}}'/>")
    ros.spin(ros.tree.nodes[0].behaviour._client.server_is_ready)
    assert ros.tree.tick_exactly_once() is Status.RUNNING  # nobody spins: no answer comes
    ros.clock.advance(0.4)
    assert ros.tree.tick_exactly_once() is Status.FAILURE
    assert ros["why"] == "SEND_GOAL_TIMEOUT"


def test_a_server_that_goes_away_while_it_works_is_noticed(ros: Graph) -> None:
    server = Server(ros, waits=True)
    ros.load(f"{ACTION} goal__order='2' error='{{why}}'/>")
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and bool(server.orders))
    sent = ros.tree.nodes[0].behaviour._sent
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and sent.handle is not None)
    server.server.destroy()
    ros.spin(lambda: not ros.tree.nodes[0].behaviour._client.server_is_ready())
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.clock.advance(1.1)
    assert ros.tree.tick_exactly_once() is Status.FAILURE
    assert ros["why"] == "SERVER_UNREACHABLE"


def test_the_name_may_come_from_the_blackboard_and_change(ros: Graph) -> None:
    first, second = Server(ros, "one"), Server(ros, "two")
    body = ACTION.replace("'fib'", "'{name}'") + " goal__order='1'/>"
    assert ros.run(body, name="one") is Status.SUCCESS
    ros.tree.blackboard["name"] = "two"
    assert ros.run() is Status.SUCCESS
    assert (len(first.orders), len(second.orders)) == (1, 1)


@pytest.mark.parametrize(
    ("ports", "message"),
    [
        ("goal__ordr='1'", "did you mean order"),
        ("goal__order='many'", "is a number"),
        ("goal__order='1.5'", "whole number"),
        ("result__sum='{s}'", "has no field 'sum'"),
    ],
)
def test_a_mistake_in_a_field_is_found_before_the_first_tick(ros: Graph, ports: str, message: str) -> None:
    with pytest.raises(TickError, match=message):
        ros.load(f"{ACTION} {ports}/>")


@pytest.mark.parametrize(
    ("type_", "message"),
    [
        ("example_interfaces/action/Fibonaci", "did you mean example_interfaces/action/Fibonacci"),
        ("no_such_package/action/X", "is not installed"),
        ("example_interfaces/srv/AddTwoInts", "is no type of this kind"),
        ("Fibonacci", "write it as"),
    ],
)
def test_a_type_that_is_not_there_is_explained(ros: Graph, type_: str, message: str) -> None:
    with pytest.raises(TickError, match=message):
        ros.load(f"<RosAction action_name='/a' action_type='{type_}'/>")


def test_a_name_that_ros_does_not_take_is_explained(ros: Graph) -> None:
    with pytest.raises(TickError, match="port 'action_name': '/a b' is no name in ROS") as raised:
        ros.load(ACTION.replace("'fib'", "'/a b'") + "/>")
    assert "rclpy" not in str(raised.value)


def test_a_tree_without_ros_says_so() -> None:
    tree = Tree.from_xml(document(f"{ACTION}/>"))
    tree.setup()
    with pytest.raises(TickError, match="there is no ROS node"):
        tree.tick_once()


class Count(RosActionNode):
    """A node of a library that rests on the base class."""

    ACTION_TYPE = "example_interfaces/action/Fibonacci"
    ACTION_NAME = "fib"

    def set_goal(self, goal: Any) -> Any:
        goal.order = 4
        return goal

    def on_feedback(self, feedback: Any) -> Status:
        return Status.SUCCESS if list(feedback.sequence) == [7, 8] else Status.RUNNING


def test_a_derived_class_sets_the_goal_and_may_end_at_a_feedback(ros: Graph) -> None:
    server = Server(ros, waits=True)
    ros.tree = Tree.from_xml(document("<Count/>"), {"Count": Count}, ros.clock)
    ros.tree.setup(node=ros.tree_node)
    assert ros.run() is Status.SUCCESS
    ros.spin(lambda: server.cancelled == 1)
    assert server.orders == [4]
