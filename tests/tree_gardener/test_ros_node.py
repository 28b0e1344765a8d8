"""Callbacks of every kind that an action gives to rclpy: their exceptions are its own."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import py_trees
import pytest
import rclpy
from py_trees.common import Status as PyTreesStatus
from rcl_interfaces.srv import SetParameters
from rclpy.action import ActionClient, ActionServer
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import String
from std_srvs.srv import Trigger
from tf2_msgs.action import LookupTransform

from tests.deadline import DEADLINE_S
from tests.domains import own_domain_id
from tests.tree_gardener.trees import leaf, load
from tree_gardener import ManualClock, Status, TickError
from tree_gardener.ros_node import ActionNode, guard_rclpy
from tree_gardener.runner import Runner

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")


def no_arm(*_: Any) -> Any:
    raise ValueError("no arm")


class Giving(py_trees.behaviour.Behaviour):
    """Gives rclpy a callback that raises."""

    kind = ""
    client: Any = None

    def setup(self, node: Any) -> None:
        getattr(self, self.kind)(node)

    def subscription(self, node: Any) -> None:
        node.create_subscription(String, "words", no_arm, 10)

    def raw_subscription(self, node: Any) -> None:
        node.create_subscription(String, "words", no_arm, 10, raw=True)

    def subscription_with_info(self, node: Any) -> None:
        def take(message: String, info: Any) -> None:
            no_arm(message, info)

        node.create_subscription(String, "words", take, 10)

    def awaiting_subscription(self, node: Any) -> None:
        async def take(message: String) -> None:
            no_arm(message)

        node.create_subscription(String, "words", take, 10)

    def timer(self, node: Any) -> None:
        node.create_timer(0.01, no_arm)

    def guard_condition(self, node: Any) -> None:
        node.create_guard_condition(no_arm).trigger()

    def service(self, node: Any) -> None:
        node.create_service(Trigger, "own", no_arm)

    def parameter(self, node: Any) -> None:
        node.declare_parameter("gain", 1.0)
        node.add_on_set_parameters_callback(no_arm)

    def earlier_parameter(self, node: Any) -> None:
        node.declare_parameter("gain", 1.0)
        node.add_pre_set_parameters_callback(no_arm)

    def later_parameter(self, node: Any) -> None:
        node.declare_parameter("gain", 1.0)
        node.add_post_set_parameters_callback(no_arm)

    def response(self, node: Any) -> None:
        client = node.create_client(Trigger, "theirs")
        assert client.wait_for_service(DEADLINE_S)
        client.call_async(Trigger.Request()).add_done_callback(no_arm)

    def feedback(self, node: Any) -> None:
        self.client = ActionClient(node, LookupTransform, "look")
        assert self.client.wait_for_server(DEADLINE_S)
        self.client.send_goal_async(LookupTransform.Goal(), no_arm)

    def goal_answer(self, node: Any) -> None:
        self.client = ActionClient(node, LookupTransform, "look")
        assert self.client.wait_for_server(DEADLINE_S)
        self.client.send_goal_async(LookupTransform.Goal()).add_done_callback(no_arm)

    def update(self) -> PyTreesStatus:
        return PyTreesStatus.RUNNING

    def terminate(self, new_status: PyTreesStatus) -> None:
        self.ended = new_status.name

    def shutdown(self) -> None:
        if self.client is not None:
            self.client.destroy()


KINDS = [
    *("subscription", "raw_subscription", "subscription_with_info", "awaiting_subscription"),
    *("timer", "guard_condition", "service", "parameter", "earlier_parameter", "later_parameter"),
    *("response", "feedback", "goal_answer"),
]


class Graph:
    """The node of the actions, and another one that makes their callbacks run."""

    def __init__(self) -> None:
        self.context = Context()
        rclpy.init(context=self.context, domain_id=own_domain_id())
        self.other = Node("other", context=self.context)
        self.other.create_service(Trigger, "theirs", lambda _, response: response)
        self.server = ActionServer(self.other, LookupTransform, "look", self.look)
        self.words = self.other.create_publisher(String, "words", 10)
        self.own = self.other.create_client(Trigger, "own")
        self.set = self.other.create_client(SetParameters, "actions/set_parameters")
        self.answers: list[Any] = []
        self.others = SingleThreadedExecutor(context=self.context)
        self.others.add_node(self.other)

    def look(self, handle: Any) -> Any:
        handle.publish_feedback(LookupTransform.Feedback())
        handle.succeed()
        return LookupTransform.Result()

    def cause(self, kind: str) -> None:
        """Makes the callback of a kind run, if it does not run by itself."""
        if "subscription" in kind:
            self.until(self.words.get_subscription_count)
            self.words.publish(String(data="go"))
        elif kind == "service":
            self.until(self.own.service_is_ready)
            self.own.call_async(Trigger.Request()).add_done_callback(self.answers.append)
        elif "parameter" in kind:
            self.until(self.set.service_is_ready)
            wanted = [Parameter("gain", value=2.0).to_parameter_msg()]
            self.set.call_async(SetParameters.Request(parameters=wanted)).add_done_callback(
                lambda future: self.answers.append(future.result().results[0])
            )

    def until(self, happened: Callable[[], Any], *executors: Any) -> None:
        """Spins until something has happened."""
        end_s = time.monotonic() + DEADLINE_S
        while not happened():
            assert time.monotonic() < end_s, "it did not happen in time"
            for executor in (self.others, *executors):
                executor.spin_once(timeout_sec=0.01)


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    made = Graph()
    yield made
    made.server.destroy()
    made.others.shutdown()
    made.other.destroy_node()
    made.context.try_shutdown()


@pytest.fixture
def node(graph: Graph) -> Iterator[ActionNode]:
    made = ActionNode("actions", context=graph.context)
    restore = guard_rclpy()
    yield made
    restore()
    made.close()


def begun(node: ActionNode, kind: str, on_error: str, faults: list[TickError]) -> Runner:
    cls = type("Giving", (Giving,), {"kind": kind})
    body = "<Fallback><Giving name='a'/><Running/></Fallback>"
    tree = load(body, nodes={"Giving": cls}, clock=ManualClock())
    tree.setup(node=node)
    runner = Runner(tree, tick_hz=10.0, on_error=on_error, fault=faults.append)
    runner.tick_now()
    return runner


@pytest.mark.parametrize("kind", KINDS)
def test_the_running_action_fails_at_its_next_tick(graph: Graph, node: ActionNode, kind: str) -> None:
    faults: list[TickError] = []
    runner = begun(node, kind, "failure", faults)
    own = leaf(runner.tree, "a").tree_gardener_node
    mine = SingleThreadedExecutor(context=graph.context)
    mine.add_node(node)
    before = own.update
    graph.cause(kind)
    graph.until(lambda: own.update is not before, mine)
    if "parameter" in kind:
        graph.until(lambda: graph.answers, mine)
    mine.shutdown()

    assert runner.tick_now() is Status.RUNNING
    [fault] = faults
    assert (fault.path, fault.message) == ("a", "ValueError: no arm")
    assert (fault.file, fault.line) == (__file__, no_arm.__code__.co_firstlineno + 1)
    assert leaf(runner.tree, "a").ended == "FAILURE"
    runner.shutdown()
    answers, graph.answers = graph.answers, []
    if kind == "parameter":
        assert "no arm" in answers[0].reason
    if "parameter" in kind:
        assert answers[0].successful is (kind == "later_parameter")
    else:
        assert answers == [], "a service whose callback raised does not answer"


@pytest.mark.parametrize("kind", KINDS)
def test_or_the_exception_ends_the_run(graph: Graph, node: ActionNode, kind: str) -> None:
    faults: list[TickError] = []
    runner = begun(node, kind, "stop", faults)
    mine = SingleThreadedExecutor(context=graph.context)
    mine.add_node(node)
    graph.cause(kind)
    with pytest.raises(TickError, match=r"node 'a' \[Giving\]: ValueError: no arm at ") as raised:
        graph.until(lambda: False, mine)
    mine.shutdown()
    runner.fail(raised.value)
    runner.shutdown()
    assert leaf(runner.tree, "a").ended == "INVALID"


def test_callbacks_of_others_are_left_alone(node: ActionNode) -> None:
    def take(_: Any) -> None: ...

    assert node.create_subscription(String, "words", take, 10).callback is take
    assert node.create_timer(10.0, no_arm).callback is no_arm


def test_a_callback_can_be_removed_again(graph: Graph, node: ActionNode) -> None:
    begun(node, "parameter", "stop", [])
    node.remove_on_set_parameters_callback(no_arm)
    assert node.set_parameters([Parameter("gain", value=2.0)])[0].successful
