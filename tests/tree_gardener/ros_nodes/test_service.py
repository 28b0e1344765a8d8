"""Service calls as nodes, against real services."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from std_srvs.srv import SetBool

from tests.tree_gardener.trees import document
from tree_gardener import Status, TickError, Tree
from tree_gardener.ros_nodes.service import RosServiceNode

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph

pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

SERVICE = "<RosService service_name='light' service_type='std_srvs/srv/SetBool' "


def serve(ros: Graph, seen: list[bool] | None = None) -> None:
    def answer(request: Any, response: Any) -> Any:
        if seen is not None:
            seen.append(request.data)
        response.success, response.message = request.data, "on" if request.data else "broken"
        return response

    ros.other.create_service(SetBool, "light", answer)


@pytest.mark.parametrize(
    ("data", "status", "said"), [("true", Status.SUCCESS, "on"), ("false", Status.FAILURE, "broken")]
)
def test_request_and_response_are_ports_and_success_decides(
    ros: Graph, data: str, status: Status, said: str
) -> None:
    serve(ros)
    assert ros.run(f"{SERVICE} request__data='{data}' response__message='{{said}}'/>") is status
    assert ros["said"] == said


def test_a_missing_service_is_waited_for_without_blocking_the_tick(ros: Graph) -> None:
    ros.load(f"{SERVICE} error='{{why}}'/>")
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.clock.advance(0.6)
    assert ros.tree.tick_exactly_once() is Status.FAILURE
    assert ros["why"] == "SERVICE_UNREACHABLE"


def test_a_service_that_does_not_answer_is_given_up(ros: Graph) -> None:
    serve(ros)
    ros.load(f"{SERVICE} error='{{why}}'/>")
    ros.spin(ros.tree.nodes[0].behaviour._client.service_is_ready)
    assert ros.tree.tick_exactly_once() is Status.RUNNING  # nobody spins: no answer comes
    ros.clock.advance(1.1)
    assert ros.tree.tick_exactly_once() is Status.FAILURE
    assert ros["why"] == "SERVICE_TIMEOUT"


def test_a_halted_call_is_forgotten(ros: Graph) -> None:
    seen: list[bool] = []
    serve(ros, seen)
    ros.load(f"{SERVICE} request__data='true'/>")
    ros.spin(ros.tree.nodes[0].behaviour._client.service_is_ready)
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.tree.halt()
    assert ros.run() is Status.SUCCESS
    assert seen == [True, True]


def test_a_field_that_is_not_there_is_found_before_the_first_tick(ros: Graph) -> None:
    with pytest.raises(TickError, match="did you mean data"):
        ros.load(f"{SERVICE} request__dat='true'/>")


class Light(RosServiceNode):
    SERVICE_TYPE = "std_srvs/srv/SetBool"
    SERVICE_NAME = "light"

    def set_request(self, request: Any) -> Any:
        request.data = True

    def on_response(self, response: Any) -> Status:
        return Status.SUCCESS if response.message == "on" else Status.FAILURE


def test_a_derived_class_sets_the_request_and_reads_the_response(ros: Graph) -> None:
    serve(ros)
    ros.tree = Tree.from_xml(document("<Light/>"), {"Light": Light}, ros.clock)
    ros.tree.setup(node=ros.tree_node)
    assert ros.run() is Status.SUCCESS
