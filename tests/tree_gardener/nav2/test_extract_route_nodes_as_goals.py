"""ExtractRouteNodesAsGoals of Nav2."""

from __future__ import annotations

from types import SimpleNamespace

from tests.tree_gardener.nav2_ros import Trial, pose, xs
from tree_gardener.nav2.extract_route_nodes_as_goals import ExtractRouteNodesAsGoals

PORTS = 'route="{route}" goals="{goals}"'


def test_each_node_is_a_goal_with_the_header_of_the_route() -> None:
    nodes = [SimpleNamespace(position=SimpleNamespace(x=float(x), y=-float(x))) for x in (1, 2)]
    route = SimpleNamespace(header=pose(0.0, sec=3).header, nodes=nodes)
    trial = Trial(ExtractRouteNodesAsGoals, PORTS, route=route)
    assert trial.tick() == "S"
    assert xs(trial["goals"]) == [1.0, 2.0]
    assert trial["goals"].goals[1].pose.position.y == -2.0
    assert trial["goals"].goals[1].header == trial["goals"].header == route.header


def test_no_nodes_fail() -> None:
    assert Trial(ExtractRouteNodesAsGoals, PORTS).tick() == "F"
    assert Trial(ExtractRouteNodesAsGoals, PORTS, route=SimpleNamespace(nodes=[])).tick() == "F"
