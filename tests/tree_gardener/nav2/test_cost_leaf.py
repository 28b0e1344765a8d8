"""Nodes that ask a costmap what poses cost, with real servers: Jazzy's for one pose, and later ones."""

from __future__ import annotations

import math
import sys
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest
from geometry_msgs.msg import PoseStamped
from nav2_msgs.srv import GetCost

from tree_gardener import Status, TickError
from tree_gardener.nav2 import cost_leaf
from tree_gardener.nav2.cost_leaf import UNKNOWN, Nav2Costs
from tree_gardener.ports import Port
from tree_gardener.ros_nodes.service import RosServiceNode

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def pose(x: float, yaw: float = 0.0, frame: str = "map") -> PoseStamped:
    made = PoseStamped()
    made.header.frame_id = frame
    made.pose.position.x = float(x)
    made.pose.orientation.z, made.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return made


class Costmap:
    """Answers with the cost of x, if it has one; -1 is outside of the map."""

    def __init__(self, ros: Graph, name: str = Nav2Costs.SERVICE_NAME, **costs: float) -> None:
        self.costs = {int(x[1:]): cost for x, cost in costs.items()}
        self.requests: list[Any] = []
        self.service = ros.other.create_service(GetCost, name, self._answer)

    def _answer(self, request: Any, response: Any) -> Any:
        self.requests.append(request)
        response.cost = float(self.costs.get(round(request.x), -1))
        return response


class Ask(Nav2Costs):
    """Notes the costs of its poses."""

    INPUT_PORTS = {  # noqa: RUF012 - as users write
        "use_footprint": Port(bool, default=True),
        "consider_unknown_as_obstacle": Port(bool, default=False),
        "cost_threshold": Port(float, default=254.0),
    }
    wanted: Any = ()
    seen: Any = "nothing"

    def poses(self) -> list[Any]:
        return list(self.wanted)

    def on_costs(self, costs: list[float] | None) -> Status:
        self.seen = costs
        return Status.SUCCESS


def asked(ros: Graph, *wanted: Any, ports: str = "") -> tuple[Status, Any]:
    ros.nodes = {"Ask": Ask}
    tree = ros.load(f"<Ask {ports}/>")
    tree.nodes[0].behaviour.wanted = wanted
    return ros.run(), tree.nodes[0].behaviour


def test_each_pose_is_asked_for_after_the_other(ros: Graph) -> None:
    costmap = Costmap(ros, x1=0, x2=253, x3=255)
    status, ask = asked(ros, pose(1, 0.5), pose(2), pose(3, frame=""), ports='use_footprint="false"')
    assert (status, ask.seen) == (Status.SUCCESS, [0.0, 253.0, 255.0])
    assert [round(request.x) for request in costmap.requests] == [1, 2, 3]
    assert costmap.requests[0].theta == pytest.approx(0.5)
    assert not costmap.requests[0].use_footprint


def test_a_pose_outside_of_the_map_ends_the_questions(ros: Graph) -> None:
    costmap = Costmap(ros, x1=0)
    _, ask = asked(ros, pose(1), pose(9), pose(1))
    assert ask.seen is None
    assert len(costmap.requests) == 2


def test_without_poses_there_is_nothing_to_ask(ros: Graph) -> None:
    costmap = Costmap(ros)
    assert asked(ros)[0] is Status.FAILURE
    assert costmap.requests == []


def test_another_frame_than_the_maps_is_an_error(ros: Graph) -> None:
    Costmap(ros, x1=0)
    with pytest.raises(TickError, match=r"in the frame 'odom'.*needs it in map"):
        asked(ros, pose(1, frame="odom"))


def test_later_versions_of_nav2_are_asked_for_all_poses_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    ask, request = Ask("ask"), SimpleNamespace(poses=[], use_footprint=False)
    ask.wanted = [pose(1), pose(2, frame="odom")]
    monkeypatch.setattr(Ask, "read", lambda self, name: True)
    monkeypatch.setattr(RosServiceNode, "initialise", lambda self: None)
    ask.initialise()
    assert ask.set_request(request).poses == ask.wanted
    assert ask.on_response(SimpleNamespace(costs=[1.0, 2.0], success=True)) is Status.SUCCESS
    assert ask.seen == [1.0, 2.0]
    ask.on_response(SimpleNamespace(costs=[], success=False))
    assert ask.seen is None


def test_the_service_is_that_of_the_installed_interfaces(monkeypatch: pytest.MonkeyPatch) -> None:
    assert cost_leaf._service() == "GetCost"
    monkeypatch.setitem(sys.modules, "nav2_msgs.srv", SimpleNamespace(GetCosts=object))
    assert cost_leaf._service() == "GetCosts"
    monkeypatch.setitem(sys.modules, "nav2_msgs.srv", None)
    assert cost_leaf._service() == "GetCost"


@pytest.mark.parametrize(
    ("cost", "ports", "free"),
    [
        (253.0, "", True),
        (254.0, "", False),
        (UNKNOWN, "", True),
        (UNKNOWN, 'consider_unknown_as_obstacle="true"', False),
        (100.0, 'cost_threshold="100"', False),
    ],
)
def test_costs_below_the_threshold_are_free(ros: Graph, cost: float, ports: str, *, free: bool) -> None:
    Costmap(ros, x1=0)
    _, ask = asked(ros, pose(1), ports=ports)
    assert ask.is_free(cost) is free
